#include "pliant/solver/integration/contact_energy.h"

#include <algorithm>
#include <cmath>

#include "pliant/solver/constraint_rows.h"
#include "pliant/solver/integration/rigid_motion.h"

namespace pliant {
namespace {

/// Of the energies of a group: differences of them that are no larger are rounding.
constexpr Real least_excess = 1e-12;

/// Σ m/2 ‖v − v_rigid‖² [J] of vertices that are not pinned.
Real energy_beside(const RigidMotion& rigid, std::span<const Index> vertices, std::span<const char> is_pinned,
                   const WorkingState& work) {
  Real energy = 0;
  for (const Index v : vertices) {
    if (is_pinned[at(v)] != 0) continue;
    const Vec3 rest = row(work.velocities, v) - rigid.velocity_at(row(work.positions, v));
    energy += work.begin.masses[at(v)] / 2 * rest.squaredNorm();
  }
  return energy;
}

void scale_beside(const RigidMotion& rigid, Real factor, std::span<const Index> vertices,
                  std::span<const char> is_pinned, WorkingState& work) {
  for (const Index v : vertices) {
    if (is_pinned[at(v)] != 0) continue;
    const Vec3 of_rigid = rigid.velocity_at(row(work.positions, v));
    work.velocities.row(v) = (of_rigid + factor * (row(work.velocities, v) - of_rigid)).transpose();
  }
}

/// By what velocities of that kinetic energy are scaled to take some of it, or all.
Real factor_that_takes(Real energy, Real kinetic) {
  return energy < kinetic ? std::sqrt(1 - energy / kinetic) : 0;
}

}  // namespace

Real ContactEnergy::limit(const StepContext& context, WorkingState& work) {
  const System& system = context.system;
  const std::size_t count = system.components().count();
  stored_.assign(count, 0);
  owed_.assign(count, 0);
  context.contact.add_stored_energies(system.components_of_vertices(), stored_);
  find_groups(context, work);
  Real taken = 0;
  Real residual_work[8] = {};
  static const bool bdf = getenv("BDFR");
  if (std::ranges::any_of(touches_, [](char each) { return each != 0; })) {
    find_excess(context, work);
    for (std::size_t group = 0; group < count; ++group) {
      if (bdf && context.settings.integrator == Integrator::bdf2) {
        Real sum = 0;
        for (Index v = 0; v < system.vertex_count(); ++v) if (group_of_[at(system.components_of_vertices()[at(v)])] == group && !system.is_pinned()[at(v)]) sum -= context.time_step * row(work.residual, v).dot(row(work.velocities, v));
        excess_[group] = std::min(excess_[group], std::max<Real>(sum, 0));
      }
      (void)residual_work;
      if (getenv("DBG") && touches_[group]) { Real sv=0; for (auto s: elastic_) sv+=s; Real st=0; for (auto s: stored_) st+=s; printf("  group %zu excess %.3e size %.3e elastic %.3e stored %.3e\n", group, excess_[group], size_[group], sv, st); }
      if (excess_[group] > least_excess * size_[group]) taken += take(context, group, work);
    }
  }
  write_energies(system, work);
  return taken;
}

/// touches_ is then of each group.
void ContactEnergy::find_groups(const StepContext& context, const WorkingState& work) {
  const System& system = context.system;
  const std::size_t count = system.components().count();
  const std::span<const Index> component_of_vertex = system.components_of_vertices();
  group_of_.resize(count);
  touches_.assign(count, 0);
  is_driven_.assign(count, 0);
  context.contact.find_touching(component_of_vertex, group_of_, touches_, is_driven_);
  for (std::size_t v = 0; v < work.contact_energies.size(); ++v) {
    if (work.contact_energies[v] != 0) touches_[at(component_of_vertex[v])] = 1;
  }
  for (std::size_t c = 0; c < count; ++c) {
    if (stored_[c] > 0) touches_[c] = 1;
  }
  mark_driven(system, work);
  for (std::size_t c = 0; c < count; ++c) {
    touches_[group_of_[c]] |= touches_[c];
    is_driven_[group_of_[c]] |= is_driven_[c];
  }
  for (std::size_t c = 0; c < count; ++c) {
    if (is_driven_[c] != 0) touches_[c] = 0;
  }
  is_held_.assign(count, 1);
  for (std::size_t i = 0; i < system.free_components().count(); ++i) {
    is_held_[at(component_of_vertex[at(system.free_components().component(i).front())])] = 0;
  }
}

void ContactEnergy::mark_driven(const System& system, const WorkingState& work) {
  const std::span<const Index> component_of_vertex = system.components_of_vertices();
  for (Index v = 0; v < system.vertex_count(); ++v) {
    if (system.is_pinned()[at(v)] == 0) continue;
    const bool moves = (row(work.positions, v).array() != row(work.begin.positions, v).array()).any();
    if (moves) is_driven_[at(component_of_vertex[at(v)])] = 1;
  }
  for (ConstraintGroup* group : system.groups()) {
    if (!group->is_external()) continue;
    for (const Index v : group->stencil()) is_driven_[at(component_of_vertex[at(v)])] = 1;
  }
}

void ContactEnergy::find_excess(const StepContext& context, const WorkingState& work) {
  System& system = context.system;
  const std::size_t count = system.components().count();
  elastic_.resize(count);
  elastic_before_.resize(count);
  forces_.resize(system.vertex_count(), 3);
  system.elastic_energies(work.positions, elastic_);
  system.elastic_step(work.begin.positions, forces_, elastic_before_, context.threads);
  excess_.assign(count, 0);
  size_.assign(count, 0);
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t group = group_of_[c];
    if (touches_[group] == 0) continue;
    Real excess = elastic_[c] + stored_[c] - elastic_before_[c];
    Real size = elastic_[c] + stored_[c] + elastic_before_[c];
    for (const Index v : system.components().component(c)) {
      if (!work.contact_energies.empty()) excess -= work.contact_energies[at(v)];
      if (system.is_pinned()[at(v)] != 0) continue;
      const Real half = work.begin.masses[at(v)] / 2;
      const Real now = half * row(work.velocities, v).squaredNorm();
      const Real before = half * row(work.begin.velocities, v).squaredNorm();
      const Real done = row(work.forces, v).dot(row(work.positions, v) - row(work.begin.positions, v));
      excess += now - before - done;
      size += now + before + std::abs(done);
    }
    excess_[group] += excess;
    size_[group] += size;
  }
}

/// What the group has too much is taken from vibrations, then from what its components do against each other.
Real ContactEnergy::take(const StepContext& context, std::size_t group, WorkingState& work) {
  const Components& components = context.system.components();
  members_.clear();
  vertices_.clear();
  bool is_held = false;
  for (std::size_t c = group; c < components.count(); ++c) {
    if (group_of_[c] != group) continue;
    const std::span<const Index> of_component = components.component(c);
    members_.push_back(c);
    vertices_.insert(vertices_.end(), of_component.begin(), of_component.end());
    is_held = is_held || is_held_[c] != 0;
  }
  const std::vector<Real>& masses = work.begin.masses;
  const auto rigid_motion = [&](std::span<const Index> vertices, bool is_held_there) {
    return is_held_there ? RigidMotion{} : fit_rigid_motion(vertices, work.positions, masses, work.velocities);
  };
  const std::span<const char> is_pinned = context.system.is_pinned();
  Real vibrating = 0;
  for (const std::size_t c : members_) {
    vibrating += energy_beside(rigid_motion(components.component(c), is_held_[c] != 0), components.component(c), is_pinned, work);
  }
  Real left = excess_[group];
  const Real factor = factor_that_takes(left, vibrating);
  for (const std::size_t c : members_) {
    scale_beside(rigid_motion(components.component(c), is_held_[c] != 0), factor, components.component(c), is_pinned, work);
  }
  Real taken = std::min(left, vibrating);
  left -= taken;
  if (left > least_excess * size_[group] && !getenv("NOST2")) {
    const RigidMotion rigid = rigid_motion(vertices_, is_held);
    const Real moving = energy_beside(rigid, vertices_, is_pinned, work);
    scale_beside(rigid, factor_that_takes(left, moving), vertices_, is_pinned, work);
    taken += std::min(left, moving);
    left -= std::min(left, moving);
  }
  owe(left);
  return taken;
}

/// What is left must be elastic energy, or will become it no more.
void ContactEnergy::owe(Real energy) {
  Real elastic = 0;
  for (const std::size_t c : members_) elastic += elastic_[c];
  if (!(energy > 0) || !(elastic > 0)) return;
  for (const std::size_t c : members_) owed_[c] = std::min(energy / elastic, Real(1)) * elastic_[c];
}

void ContactEnergy::write_energies(const System& system, WorkingState& work) const {
  work.contact_energies.assign(at(system.vertex_count()), 0);
  bool is_any = false;
  for (std::size_t c = 0; c < stored_.size(); ++c) {
    const Real energy = stored_[c] - owed_[c];
    work.contact_energies[at(system.components().component(c).front())] = energy;
    is_any |= energy != 0;
  }
  if (!is_any) work.contact_energies.clear();
}

}  // namespace pliant
