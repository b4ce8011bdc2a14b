#include "pliant/simulation/simulation.h"

#include <algorithm>

#include "pliant/core/error.h"
#include "pliant/mesh/geometry.h"
#include "pliant/solver/solver.h"

namespace pliant {
namespace {

/// Refuses a wrong number of rows and what is not finite.
void check_rows(const Positions& given, Index vertex_count, const std::string& where) {
  if (given.rows() != vertex_count) {
    fail_input(where + ": " + std::to_string(given.rows()) + " rows for " + std::to_string(vertex_count) +
               " vertices; give one row a vertex");
  }
  for (Index i = 0; i < given.rows(); ++i) {
    if (!given.row(i).allFinite()) {
      fail_input(where + "[" + std::to_string(i) + "] is not finite; give three finite numbers");
    }
  }
}

/// `given`, or `fallback` when empty.
Positions given_or(Positions given, const Positions& fallback, std::string_view what, std::string_view name) {
  if (given.size() == 0) return fallback;
  check_rows(given, static_cast<Index>(fallback.rows()), "body '" + std::string(name) + "': " + std::string(what));
  return given;
}

void append(Positions& x, const Positions& more) {
  const Index old_rows = static_cast<Index>(x.rows());
  x.conservativeResize(old_rows + more.rows(), 3);
  x.bottomRows(more.rows()) = more;
}

}  // namespace

Simulation::Simulation(const SolverSettings& settings)
    : settings_(settings), solver_(std::make_unique<Solver>(settings)) {
  state_.positions.resize(0, 3);
  state_.velocities.resize(0, 3);
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

BodyId Simulation::add_body(Mesh mesh, const Mass& mass, BodyOptions options) {
  if (options.name.empty()) options.name = "body " + std::to_string(bodies_.size());
  check_mesh(mesh, options.name);
  const std::vector<Real> masses = vertex_masses(mesh, mass, options.name);
  const Positions start = given_or(std::move(options.start), mesh.vertices, "start positions", options.name);
  const Positions still = Positions::Zero(mesh.vertex_count(), 3);
  const Positions velocities = given_or(std::move(options.velocities), still, "velocities", options.name);

  const Index first_vertex = state_.vertex_count();
  append(state_.positions, start);
  append(state_.velocities, velocities);
  state_.masses.insert(state_.masses.end(), masses.begin(), masses.end());
  bodies_.push_back({std::move(options.name), std::move(mesh), first_vertex});
  groups_changed_ = true;
  return BodyId(static_cast<Index>(bodies_.size()) - 1);
}

const Body& Simulation::body(BodyId id) const {
  const auto i = static_cast<std::size_t>(id);
  if (i >= bodies_.size()) {
    fail_input("body " + std::to_string(i) + " does not exist; there are " + std::to_string(bodies_.size()));
  }
  return bodies_[i];
}

Index Simulation::vertex(BodyId id, Index vertex_of_body) const {
  const Body& owner = body(id);
  if (vertex_of_body < 0 || vertex_of_body >= owner.mesh.vertex_count()) {
    fail_input("body '" + owner.name + "': vertex " + std::to_string(vertex_of_body) +
               " is out of range; it has vertices 0 to " + std::to_string(owner.mesh.vertex_count() - 1));
  }
  return owner.first_vertex + vertex_of_body;
}

GroupId Simulation::add_set(BodyId id, ConstraintSet set, std::string type, std::string name) {
  if (name.empty()) name = type;
  const std::string place = name + " on body '" + body(id).name + "'";
  for (const auto& part : set.parts) {
    if (!part) fail_input(place + ": a part of its constraints is null; leave it out");
    check_group(*part, state_.vertex_count(), place);
    check_held(*part, place);
  }
  if (set.count == 0 && set.skipped == 0) {
    warnings_.push_back(place + ": makes no constraint; does the selection hold whole elements?");
  }
  if (set.skipped > 0) {
    warnings_.push_back(place + ": left out at " + std::to_string(set.skipped) + " " + set.skipped_reason);
  }
  const GroupId group{next_group_++};
  groups_.emplace(group, Group{std::move(name), std::move(type), id, std::move(set)});
  groups_changed_ = true;
  return group;
}

void Simulation::check_held(const ConstraintGroup& added, const std::string& place) const {
  std::vector<Index> held(added.held_vertices().begin(), added.held_vertices().end());
  std::ranges::sort(held);
  const auto twice = std::ranges::adjacent_find(held);
  if (twice != held.end()) fail_input(place + ": vertex " + std::to_string(*twice) + " is held twice; leave one out");
  for (const auto& [id, other] : groups_) {
    for (const auto& part : other.set.parts) {
      for (const Index vertex : part->held_vertices()) {
        if (!std::ranges::binary_search(held, vertex)) continue;
        fail_input(place + ": vertex " + std::to_string(vertex) + " is already held by '" + other.name +
                   "'; leave it out of one of the two");
      }
    }
  }
}

void Simulation::remove(GroupId id) {
  if (groups_.erase(id) == 0) fail_input("group " + std::to_string(static_cast<Index>(id)) + " does not exist");
  groups_changed_ = true;
}

const Group& Simulation::group(GroupId id) const {
  const auto found = groups_.find(id);
  if (found == groups_.end()) fail_input("group " + std::to_string(static_cast<Index>(id)) + " does not exist");
  return found->second;
}

void Simulation::set_stiffness(GroupId id, Real stiffness) {
  bool has_stiffness = false;
  for (const auto& part : group(id).set.parts) {
    if (part->shape().count == 0) continue;
    part->set_stiffness(stiffness);
    has_stiffness = true;
  }
  if (!has_stiffness) fail_input("group '" + group(id).name + "' has no stiffness; hard pins have none");
}

std::span<Real> Simulation::target_numbers(GroupId id, Index i) const {
  const Group& owner = group(id);
  auto place = static_cast<std::size_t>(i);
  for (const auto& part : owner.set.parts) {
    const std::span<Real> targets = part->targets();
    if (i >= 0 && 3 * place < targets.size()) return targets.subspan(3 * place, 3);
    place -= targets.size() / 3;
  }
  fail_input("group '" + owner.name + "' has no target " + std::to_string(i) +
             "; positions and drags have one for each constraint");
}

Index Simulation::target_count(GroupId id) const {
  std::size_t numbers = 0;
  for (const auto& part : group(id).set.parts) numbers += part->targets().size();
  return static_cast<Index>(numbers / 3);
}

Vec3 Simulation::target(GroupId id, Index i) const {
  return Eigen::Map<const Vec3>(target_numbers(id, i).data());
}

void Simulation::set_target(GroupId id, Index i, const Vec3& target) {
  if (!target.allFinite()) fail_input("group '" + group(id).name + "': the target is not finite");
  std::ranges::copy(target, target_numbers(id, i).begin());
}

ForceId Simulation::add_force(std::unique_ptr<Force> force) {
  if (!force) fail_input("force: there is none; give one");
  if (const std::optional<Index> vertex = force->vertex_out_of_range(state_.vertex_count())) {
    fail_input(std::string(force->type()) + ": vertex " + std::to_string(*vertex) +
               " is out of range; the simulation has " + std::to_string(state_.vertex_count()) + " vertices");
  }
  const ForceId id{next_force_++};
  forces_.emplace(id, std::move(force));
  forces_changed_ = true;
  return id;
}

ForceId Simulation::add_wind(const WindOptions& options) {
  std::vector<Triangle> triangles;
  std::vector<Real> areas;
  for (const Body& owner : bodies_) append_triangles(owner, triangles, areas);
  return add_force(std::make_unique<Wind>(std::move(triangles), std::move(areas), options));
}

ForceId Simulation::add_wind(BodyId id, const WindOptions& options) {
  std::vector<Triangle> triangles;
  std::vector<Real> areas;
  append_triangles(body(id), triangles, areas);
  return add_force(std::make_unique<Wind>(std::move(triangles), std::move(areas), options));
}

void Simulation::append_triangles(const Body& owner, std::vector<Triangle>& triangles, std::vector<Real>& areas) {
  for (const Triangle& t : owner.mesh.triangles) {
    triangles.push_back({owner.first_vertex + t[0], owner.first_vertex + t[1], owner.first_vertex + t[2]});
  }
  const std::vector<Real> more = triangle_areas(owner.mesh.vertices, owner.mesh.triangles);
  areas.insert(areas.end(), more.begin(), more.end());
}

void Simulation::remove(ForceId id) {
  warned_forces_.erase(id);
  if (forces_.erase(id) == 0) fail_input("force " + std::to_string(static_cast<Index>(id)) + " does not exist");
  forces_changed_ = true;
}

void Simulation::set_settings(const SolverSettings& settings) {
  solver_->set_settings(settings);
  const bool new_limits = settings.time_step != settings_.time_step;
  settings_ = settings;
  if (new_limits) check_forces();
}

void Simulation::check_forces() {
  for (const auto& [id, force] : forces_) {
    std::optional<std::string> warning = force->warning(state_.view(), settings_.time_step);
    if (!warning) {
      warned_forces_.erase(id);  // to be warned of again
    } else if (warned_forces_.insert(id).second && std::ranges::find(warnings_, *warning) == warnings_.end()) {
      warnings_.push_back(*std::move(warning));
    }
  }
}

void Simulation::update_problem() {
  if (bodies_.empty()) fail_input("the simulation has no body; add one before the first step");
  if (groups_changed_) {
    std::vector<ConstraintGroup*> groups;
    for (const auto& [id, owner] : groups_) {
      for (const auto& part : owner.set.parts) groups.push_back(part.get());
    }
    solver_->set_groups(state_.vertex_count(), std::move(groups));
    groups_changed_ = false;
  }
  if (forces_changed_) {
    std::vector<Force*> forces;
    for (const auto& [id, force] : forces_) forces.push_back(force.get());
    solver_->set_forces(std::move(forces));
    check_forces();
    forces_changed_ = false;
  }
}

StepReport Simulation::step() {
  update_problem();
  return solver_->step(state_);
}

Evaluation Simulation::evaluate() {
  update_problem();
  return solver_->evaluate(state_);
}

SystemInfo Simulation::system_info() {
  update_problem();
  return solver_->system_info(state_);
}

Real Simulation::elastic_energy(GroupId id) const {
  Real energy = 0;
  for (const auto& part : group(id).set.parts) energy += solver_->elastic_energy(*part);
  return energy;
}

std::span<const Real> Simulation::objective_history() const {
  return solver_->objective_history();
}

void Simulation::set_state(const Positions& positions, const Positions& velocities) {
  check_rows(positions, state_.vertex_count(), "set_state: positions");
  check_rows(velocities, state_.vertex_count(), "set_state: velocities");
  state_.positions = positions;
  state_.velocities = velocities;
  solver_->forget_prediction();
}

std::string_view Simulation::backend() const {
  return solver_->backend();
}

int Simulation::thread_count() const {
  return solver_->thread_count();
}

BodyView Simulation::view(BodyId id) const {
  const Body& owner = body(id);
  return {owner.mesh, state_.positions.middleRows(owner.first_vertex, owner.mesh.vertex_count()), owner.first_vertex,
          owner.name};
}

}  // namespace pliant
