#pragma once
// What bodies meet: the part of Simulation that has bodies and colliders, with the state that says where they are.
//
//     const ColliderId ball = simulation.add(SphereCollider{.center = {0, 0, 1}, .radius = 0.3, .friction = 0.4});
//     simulation.add(PlaneCollider{});
//     simulation.set_target(ball, {{0, 0, 0.99}});  // where the next step takes it
#include <map>
#include <optional>
#include <string>

#include "pliant/collision/contact/contact_settings.h"
#include "pliant/mesh/mass.h"
#include "pliant/simulation/records.h"
#include "pliant/solver/settings.h"
#include "pliant/solver/state.h"

namespace pliant {

class Transaction;

class Colliders {
 public:
  /// Adds a built-in collider, or any other with a ColliderInfo `info`, `visit` and a `build(options)`: bodies meet it
  /// from the next step on. Default name: the type, with the first free number from 2 behind where that is taken.
  /// Throws Error(input) on what it refuses, as all of these do, and while energy is projected.
  template <describes_collider Options>
  ColliderId add(const Options& options, const std::string& name = {}) {  // by value, clang 14 lets a force's hide it
    PlacedShape placed = build(options);
    return add_collider({name, source_of(options), std::move(placed.shape), placed.pose, motion_of(options)});
  }
  /// Adds a collider of a user's own.
  ColliderId add_collider(std::shared_ptr<const ColliderShape> shape, const Pose& pose,
                          const ColliderMotion& motion = {}, std::string name = {});
  /// Makes a collider anew from other options under its id and name. It stays where it is, unless the options put it
  /// elsewhere than before: then the next step takes it there.
  template <describes_collider Options>
  void replace(ColliderId id, const Options& options) {
    PlacedShape placed = build(options);
    exchange_collider(id, {name(id), source_of(options), std::move(placed.shape), placed.pose, motion_of(options)});
  }
  /// What a collider was made of; null for one of another type.
  template <describes_collider Options>
  const Options* options(ColliderId id) const {
    return options_in<Options>(collider(id));
  }
  void remove(ColliderId id);
  const std::map<ColliderId, ColliderRecord>& colliders() const { return colliders_; }
  const ColliderRecord& collider(ColliderId id) const;
  const std::string& name(ColliderId id) const { return collider(id).name; }
  /// The collider of that name; of several, the one that was added first.
  std::optional<ColliderId> find_collider(std::string_view name) const;

  /// Where a collider is now.
  const Pose& pose(ColliderId id) const;
  /// Where the next step takes it, whatever its velocities; it goes on with these afterwards.
  void set_target(ColliderId id, const Pose& target);
  void clear_target(ColliderId id);  ///< the next step takes it on with its velocities
  const std::optional<Pose>& target(ColliderId id) const;

  /// What holds now: before the first set_contact() the defaults, with `surfaces` false.
  const ContactSettings& contact() const { return contact_; }
  /// From the next step on. Lets bodies touch each other and themselves, unless `surfaces` is false.
  void set_contact(const ContactSettings& settings);

  /// Says that what holds or drives bodies changes before the next step, so that automatic iterations are found anew
  /// (State::changed_step). Edits say so themselves, but for set_settings, set_state and set_target.
  void note_change() { state_.note_change(); }

  const std::vector<Body>& bodies() const { return bodies_; }
  const Body& body(BodyId id) const;
  /// Other masses of a body, from the next step on: costs a numeric factorization. Where it is, how fast, and the
  /// forces on it stay. Throws as vertex_masses does.
  void set_mass(BodyId id, const Mass& mass);
  /// How a body touches, from the next step on. Refuses to ignore itself, or a body that there is not.
  void set_contact(BodyId id, const BodyContact& contact);
  const BodyContact& contact(BodyId id) const { return body(id).contact; }
  Real contact_distance(BodyId id) const;  ///< r of its vertices [m]

 protected:
  /// What is left out of contact has changed: which surfaces cross is found out anew.
  void join_anew();
  static void check_projection(const SolverSettings& settings, bool has_colliders);
  /// Refuses a state of contact that is not of these colliders and so many vertices.
  void check_contact(const ContactState& contact) const;
  void check_let_go(const LetGoState& let_go) const;

  SolverSettings settings_;
  State state_;
  std::vector<Body> bodies_;
  std::vector<std::vector<Triangle>> surface_triangles_;  // of the bodies, where they touch each other
  std::map<ColliderId, ColliderRecord> colliders_;
  ContactSettings contact_{.surfaces = false};
  Index next_collider_ = 0;
  std::vector<Real> edge_distances_;  // contact distances of the first bodies, by their edges
  bool colliders_changed_ = true;
  bool surfaces_changed_ = true;  // bodies, or how they touch
  bool masses_changed_ = false;
  Transaction* transaction_ = nullptr;  // the innermost one under way

 private:
  friend class Transaction;

  ColliderId add_collider(ColliderRecord record);
  void exchange_collider(ColliderId id, ColliderRecord record);
  std::size_t place_in_state(ColliderId id) const;
};

}  // namespace pliant
