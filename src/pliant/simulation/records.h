#pragma once
// What a simulation is made of: bodies, and groups of constraints on them.
#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pliant/collision/contact/body_contact.h"
#include "pliant/simulation/any_options.h"

namespace pliant {

/// One body. Its vertices are [first_vertex, first_vertex + mesh.vertex_count()) of the simulation.
struct Body {
  std::string name;
  Mesh mesh;  ///< its vertices are the rest positions
  Index first_vertex = 0;
  BodyContact contact{};  ///< see Simulation::set_contact
};

struct BodyOptions {
  std::string name{};      ///< in messages; default "body 0", "body 1", ...
  Positions start{};       ///< m × 3 [m]; default: the rest positions
  Positions velocities{};  ///< m × 3 [m/s]; default: zero
};

/// Constraints of one type on one body, or between two, as a user sees them.
struct Group {
  std::string name;
  std::string type;
  BodyId body{};
  /// None of constraints that were made elsewhere. Stiffness and targets may have changed since (Simulation::options).
  std::shared_ptr<const AnyOptions> source;
  ConstraintSet set;
  std::vector<Index> points{};  ///< of each target a number, which it keeps when others come and go; at first 0, 1, ...
  Index next_point = 0;         ///< the number of the next new target
  std::optional<BodyId> other{};  ///< that it ties `body` to, which may be the same; none: it is on `body` alone
  std::vector<Real> factors{};    ///< of the stiffness, by vertex of the body; empty: none (set_stiffness_factors)
};

/// Constraints that tie a body to another one.
template <class Constraint>
concept between_bodies = requires(const Constraint& options) {
  { options.to } -> std::same_as<const BodyId&>;
};

/// A group on a body, or between that and another one, given how to see a body.
template <class Constraint, class View>
Group group_of(BodyId id, const Constraint& options, std::string name, View&& view) {
  check_options(Constraint::info.name, options);
  Group group{std::move(name), std::string(Constraint::info.name), id, source_of(options), {}};
  if constexpr (between_bodies<Constraint>) {
    group.set = build(view(id), view(options.to), options);
    group.other = options.to;
  } else {
    group.set = build(view(id), options);
  }
  return group;
}

template <class Options>
std::optional<Group> OptionsOf<Options>::make_group(BodyId id, std::string name, const SeeBody& see) const {
  if constexpr (describes_force<Options> || describes_collider<Options>) {
    return std::nullopt;
  } else {
    return group_of(id, options, std::move(name), see);
  }
}

template <class Constraint>
bool gives_anchors(const Constraint& options) {
  const Points* anchors = anchors_in(options);
  return anchors != nullptr && !anchors->empty();
}

/// Stiffnesses of constraints whose group has this common factor by now: the factor, or that times each one's own.
Values with_factor(const Values& given, Real factor);

/// What a group was made of, with its common factor of now, if it has one; none where it was made of another type.
template <class Constraint>
std::optional<Constraint> options_of(const Group& group, std::optional<Real> factor) {
  const Constraint* given = options_in<Constraint>(group);
  if (given == nullptr) return std::nullopt;
  Constraint now = *given;
  if constexpr (requires { now.stiffness.each(); }) {
    if (factor) now.stiffness = with_factor(now.stiffness, *factor);
  }
  return now;
}

/// What a simulation knows of a force besides the force itself.
struct ForceRecord {
  std::string name;
  std::optional<BodyId> body{};                   ///< that it is on; none: all there were, or it is a user's own
  std::shared_ptr<const AnyOptions> source = {};  ///< none: it is a user's own
};

/// A collider as a user sees it. Where it is, Simulation::pose() says.
struct ColliderRecord {
  std::string name;
  std::shared_ptr<const AnyOptions> source;  ///< none: it is a user's own
  std::shared_ptr<const ColliderShape> shape;
  Pose pose{};  ///< where it began, or was put last
  ColliderMotion motion{};
};

/// Refuses factors of a stiffness that are not finite or not above 0, naming the place and the vertex.
void check_stiffness_factors(std::span<const Real> factors, const std::string& place);

}  // namespace pliant
