#pragma once
// The facade: bodies, constraint groups, forces and settings, to be changed at any time between steps.
//
//     Simulation simulation;
//     const BodyId cloth = simulation.add_body(grid({.columns = 32, .rows = 32}), Mass::area_density(0.2));
//     simulation.add(cloth, EdgeSpring{.stiffness = 1e3});
//     simulation.add(cloth, Position{.on = {0, 31}});
//     simulation.add(Gravity{});
//     for (int i = 0; i < 60; ++i) simulation.step();
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pliant/collision/contact/contact.h"
#include "pliant/collision/contact/vertex_touch.h"
#include "pliant/mesh/mass.h"
#include "pliant/simulation/colliders.h"
#include "pliant/simulation/group_index.h"
#include "pliant/solver/system_info.h"

namespace pliant {

class Solver;

class Simulation : public Colliders {
 public:
  /// Throws Error(input) on settings out of their range, as do all members on what they refuse.
  explicit Simulation(const SolverSettings& settings = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  /// The same at the same moment, with all ids and the bits of its next steps; set_stop() is not taken over. Refuses
  /// groups and forces of a user's own that have no copy().
  Simulation copy() const;

  /// Checks the mesh (check_mesh) and the masses (vertex_masses).
  BodyId add_body(Mesh mesh, const Mass& mass, BodyOptions options = {});
  /// Adds a built-in constraint type, or any other with `info`, `visit` and a `build(BodyView, options)`; or an
  /// Attachment, which ties the body to another, `options.to`, and has a `build(BodyView, BodyView, options)`.
  template <class Constraint>
  requires(!describes_force<Constraint>) GroupId add(BodyId id, const Constraint& options, std::string name = {}) {
    return add_group(make_group(id, options, std::move(name)));
  }
  /// Adds constraints made elsewhere; their stencils have the indices of the simulation (check_group).
  GroupId add_set(BodyId id, ConstraintSet set, std::string type, std::string name = {});
  void remove(GroupId id);
  const std::map<GroupId, Group>& groups() const { return groups_; }
  std::vector<std::string> group_names() const;
  std::optional<GroupId> find_group(std::string_view name) const;  ///< of several, the one that was added first

  /// Makes a group anew from other options, of its type or another one, under its id and name. Targets and origins
  /// that the options leave open stay, where a constraint has the vertices of an old one; else they begin where the
  /// vertices are now. Costs what adding does: a numeric factorization, and an ordering where other vertices connect.
  template <class Constraint>
  void replace(GroupId id, const Constraint& options) {
    replace(id, options, gives_anchors(options) ? Anchors::given : Anchors::kept);
  }
  template <class Constraint>
  void replace(GroupId id, const Constraint& options, Anchors anchors) {
    replace_group(id, make_group(group(id).body, options, group(id).name), anchors);
  }
  void replace_set(GroupId id, ConstraintSet set, std::string type, Anchors anchors);
  /// What a group was made of, with its stiffness of now; none for another type, and of constraints made elsewhere.
  template <class Constraint>
  std::optional<Constraint> options(GroupId id) const {
    return options_of<Constraint>(group(id), stiffness(id));
  }
  /// Lets vertices of a group of positions go; the others stay as they are. Vertices have the indices of their body.
  void release(GroupId id, std::span<const Index> vertices);
  /// New common factor of a group's weights: costs one numeric factorization at the next step.
  void set_stiffness(GroupId id, Real stiffness);
  std::optional<Real> stiffness(GroupId id) const;  ///< that factor; none for hard pins
  /// Multiplies the stiffness of each constraint of a group on one body by the mean of these, > 0, over its vertices:
  /// one for each vertex of the body, or none. They stay when the group is replaced, whether it has a stiffness or not.
  void set_stiffness_factors(GroupId id, std::vector<Real> factors);
  /// Movable points of a group (positions, drags), in the order of its constraints.
  Index target_count(GroupId id) const;
  Vec3 target(GroupId id, Index i) const;
  /// Moves point i from the next step on; costs nothing.
  void set_target(GroupId id, Index i, const Vec3& target);
  /// Adds a built-in force, or any other with `info`, `visit` and a `build(ForceScope, options)`: on one body, or as
  /// its ForceReach says. Default name: the type, with the first free number from 2 behind where that is taken.
  template <describes_force Options>
  ForceId add(std::optional<BodyId> body, const Options& options, std::string name = {}) {
    return add_force({std::move(name), body, source_of(options)}, build(scope(body), options));
  }
  template <describes_force Options>
  ForceId add(const Options& options, std::string name = {}) {
    return add(std::nullopt, options, std::move(name));
  }
  /// Adds a force of a user's own. Refuses one on a vertex that there is not: add the bodies first.
  ForceId add_force(std::unique_ptr<Force> force, std::string name = {});
  /// Makes a force anew from other options under its id and name: on its body, or on another one. Costs nothing.
  template <describes_force Options>
  void replace(ForceId id, const Options& options) {
    replace(id, record(id).body, options);
  }
  template <describes_force Options>
  void replace(ForceId id, std::optional<BodyId> body, const Options& options) {
    exchange_force(id, {name(id), body, source_of(options)}, build(scope(body), options));
  }
  void replace(ForceId id, std::unique_ptr<Force> force);
  /// What a force was made of, and the body it is on; null for a force of another type.
  template <describes_force Options>
  const Options* options(ForceId id) const {
    return options_in<Options>(record(id));
  }
  /// What a force acts on: its body, or all that there are now.
  ForceScope scope(ForceId id) const { return scope(record(id).body); }
  ForceScope scope(std::optional<BodyId> id) const;
  void remove(ForceId id);
  const std::map<ForceId, std::unique_ptr<Force>>& forces() const { return forces_; }
  const ForceRecord& record(ForceId id) const;
  const std::string& name(ForceId id) const { return record(id).name; }
  std::optional<ForceId> find_force(std::string_view name) const;  ///< of several, the one that was added first
  Index vertex(BodyId id, Index vertex_of_body) const;             ///< its index among all; refuses one out of range

  using Colliders::add, Colliders::name, Colliders::options, Colliders::remove, Colliders::replace;
  using Colliders::set_target, Colliders::target;

  /// What touched at the end of the last step, by vertex, then collider; valid until the next one.
  std::span<const ContactPoint> contacts() const;
  /// Of each vertex, what it touched then, surfaces as well; forgotten where constraints have come or gone since.
  std::vector<VertexTouch> touches() const;
  Wrench wrench(ColliderId id) const;  ///< what a collider felt then

  const SolverSettings& settings() const { return settings_; }
  void set_settings(const SolverSettings& settings);  ///< refuses BDF2 with a force that is an explicit spring

  /// Asked before each iteration, on the thread of step(), whether the step is to be given up. None: never.
  void set_stop(std::function<bool()> stop);

  /// Takes one step (Algorithm 1). Throws Error(diverged), with the state as it was before, when a position would not
  /// be finite; Error(interrupted), likewise, when the step is given up.
  StepReport step();
  /// One more local step at the positions the last step ended with; without inertia at the start and after set_state().
  Evaluation evaluate();
  /// Elastic energy of a group at the last evaluate() [J]; 0 for a group added since.
  Real elastic_energy(GroupId id) const;
  /// E(q) before each global solve of the last step [J], of its first 4096; evaluate() has that after the last one.
  std::span<const Real> objective_history() const;

  const State& state() const { return state_; }
  void set_state(const Positions& positions, const Positions& velocities);  ///< m × 3 each
  /// Goes on from a state of this simulation, or of one with the same bodies. Refuses other masses.
  void restore(const State& state);

  /// Describes the system of equations as the next step has it; factorizes when something has changed.
  SystemInfo system_info();
  std::string_view backend() const;  ///< the name of the one in use
  Precision precision() const;       ///< of the factor in use; `double_` before the first step
  Real contraction() const;          ///< of an error, by a solve in single precision; 0 where that was not asked for
  int thread_count() const;
  /// What a user may want to know: skipped constraints, forces past their stability limit. It only grows.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  friend class Transaction;

  BodyView view(BodyId id) const;
  const Group& group(GroupId id) const;
  std::span<Real> target_numbers(GroupId id, Index i) const;
  void add_warnings(const StepReport& report);
  void check_group_of(const Group& added, std::optional<GroupId> replaced) const;
  void warn_of(const Group& added);
  template <class Constraint>
  Group make_group(BodyId id, const Constraint& options, std::string name) {
    return group_of(id, options, std::move(name), [this](BodyId body) { return view(body); });
  }
  GroupId add_group(Group added);
  void replace_group(GroupId id, Group renewed, Anchors anchors, bool warns = true);
  void exchange_group(GroupId id, Group renewed);
  ForceId add_force(ForceRecord record, std::unique_ptr<Force> force);
  void exchange_force(ForceId id, ForceRecord record, std::unique_ptr<Force> force);
  void forces_have_changed(const Force& force);
  void check_force(const Force* force) const;
  static void check_under_bdf2(const Force& force);
  void check_forces();
  void update_problem();
  void update_colliders();
  void update_surfaces();

  std::map<GroupId, Group> groups_;
  GroupIndex group_index_;
  std::map<ForceId, std::unique_ptr<Force>> forces_;
  std::map<ForceId, ForceRecord> force_records_;
  std::unique_ptr<Solver> solver_;
  std::vector<std::string> warnings_;
  std::set<ForceId> warned_forces_;  // whose warning stands in warnings_ and still holds
  Index next_group_ = 0;
  Index next_force_ = 0;
  bool groups_changed_ = true, forces_changed_ = true;
};

}  // namespace pliant
