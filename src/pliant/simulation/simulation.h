#pragma once
// The facade: bodies, constraint groups, forces and settings, to be changed at any time between steps.
//
//     Simulation simulation;
//     const BodyId cloth = simulation.add_body(grid({.columns = 32, .rows = 32}), Mass::area_density(0.2));
//     simulation.add(cloth, EdgeSpring{.stiffness = 1e3});
//     simulation.add(cloth, Position{.on = {0, 31}});
//     simulation.add_force(std::make_unique<Gravity>());
//     for (int i = 0; i < 60; ++i) simulation.step();
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "pliant/constraints/constraint_set.h"
#include "pliant/forces/wind.h"
#include "pliant/mesh/mass.h"
#include "pliant/solver/settings.h"
#include "pliant/solver/state.h"
#include "pliant/solver/system_info.h"

namespace pliant {

class Solver;

enum class BodyId : Index {};
enum class GroupId : Index {};
enum class ForceId : Index {};

/// One body. Its vertices are [first_vertex, first_vertex + mesh.vertex_count()) of the simulation.
struct Body {
  std::string name;
  Mesh mesh;  ///< its vertices are the rest positions
  Index first_vertex = 0;
};

struct BodyOptions {
  std::string name{};      ///< in messages; default "body 0", "body 1", ...
  Positions start{};       ///< m × 3 [m]; default: the rest positions
  Positions velocities{};  ///< m × 3 [m/s]; default: zero
};

/// Constraints of one type on one body, as a user sees them.
struct Group {
  std::string name;
  std::string type;
  BodyId body{};
  ConstraintSet set;
};

class Simulation {
 public:
  /// Throws Error(input) on settings out of their range, as do all members on what they refuse.
  explicit Simulation(const SolverSettings& settings = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Checks the mesh (check_mesh) and the masses (vertex_masses).
  BodyId add_body(Mesh mesh, const Mass& mass, BodyOptions options = {});
  const std::vector<Body>& bodies() const { return bodies_; }
  const Body& body(BodyId id) const;

  /// Adds a built-in constraint type, or any other with `info`, `visit` and a `build(BodyView, options)`.
  template <class Constraint>
  GroupId add(BodyId id, const Constraint& options, std::string name = {}) {
    check_options(Constraint::info.name, options);
    return add_set(id, build(view(id), options), std::string(Constraint::info.name), std::move(name));
  }
  /// Adds constraints made elsewhere; their stencils have the indices of the simulation (check_group).
  GroupId add_set(BodyId id, ConstraintSet set, std::string type, std::string name = {});
  void remove(GroupId id);
  const std::map<GroupId, Group>& groups() const { return groups_; }

  /// New common factor of a group's weights: costs one numeric factorization at the next step.
  void set_stiffness(GroupId id, Real stiffness);
  /// Movable points of a group (positions, drags), in the order of its constraints.
  Index target_count(GroupId id) const;
  Vec3 target(GroupId id, Index i) const;
  /// Moves point i from the next step on; costs nothing.
  void set_target(GroupId id, Index i, const Vec3& target);

  /// Refuses a force on a vertex that there is not: add the bodies first.
  ForceId add_force(std::unique_ptr<Force> force);
  /// Wind on all triangles of one body, or of every body there is.
  ForceId add_wind(const WindOptions& options);
  ForceId add_wind(BodyId id, const WindOptions& options);
  void remove(ForceId id);
  const std::map<ForceId, std::unique_ptr<Force>>& forces() const { return forces_; }
  /// The global index of a body's vertex. Throws Error(input) when it is out of range.
  Index vertex(BodyId id, Index vertex_of_body) const;

  const SolverSettings& settings() const { return settings_; }
  void set_settings(const SolverSettings& settings);

  /// Takes one step (Algorithm 1). Throws Error(diverged), with the state as it was before, when a position would not
  /// be finite.
  StepReport step();
  /// One more local step at the positions the last step ended with; at the start, and after set_state(), without the
  /// inertia term.
  Evaluation evaluate();
  /// Elastic energy of a group at the last evaluate() [J]; 0 for a group added since.
  Real elastic_energy(GroupId id) const;
  /// The objective E(q) before each global solve of the last step [J], of its first 4096 solves. evaluate() has the
  /// objective after the last one.
  std::span<const Real> objective_history() const;

  const State& state() const { return state_; }
  /// Replaces positions and velocities (m × 3 each).
  void set_state(const Positions& positions, const Positions& velocities);

  /// Describes the system of equations as the next step has it; factorizes when something has changed.
  SystemInfo system_info();

  /// The name of the back end in use.
  std::string_view backend() const;
  int thread_count() const;
  /// What a user may want to know: skipped constraints, forces past their stability limit. It only grows.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  BodyView view(BodyId id) const;
  const Group& group(GroupId id) const;
  std::span<Real> target_numbers(GroupId id, Index i) const;
  /// A vertex can be held at one place only.
  void check_held(const ConstraintGroup& added, const std::string& place) const;
  static void append_triangles(const Body& owner, std::vector<Triangle>& triangles, std::vector<Real>& areas);
  void update_problem();
  void check_forces();

  SolverSettings settings_;
  State state_;
  std::vector<Body> bodies_;
  std::map<GroupId, Group> groups_;
  std::map<ForceId, std::unique_ptr<Force>> forces_;
  std::unique_ptr<Solver> solver_;
  std::vector<std::string> warnings_;
  std::set<ForceId> warned_forces_;  // whose warning stands in warnings_ and still holds
  Index next_group_ = 0;
  Index next_force_ = 0;
  bool groups_changed_ = true;
  bool forces_changed_ = true;
};

}  // namespace pliant
