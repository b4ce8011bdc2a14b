#include "pliant/solver/integration/contact_energy.h"

#include <algorithm>
#include <cmath>

#include "pliant/solver/integration/rigid_motion.h"

namespace pliant {
namespace {

/// Of the energies of a group: a difference of them that is no larger is rounding.
constexpr Real least_excess = 1e-12;
/// Of what is owed, from substep to substep. Sheets of which few iterations leave some stretched for good would stand
/// still otherwise.
constexpr Real kept_debt = 0.9;

/// Vertices, and the motion that is not to be scaled.
struct Beside {
  std::span<const Index> vertices;
  RigidMotion rigid;
  std::span<const char> is_pinned;
};

/// Σ m/2 ‖v − v_rigid‖² [J]
Real kinetic_energy(const Beside& moving, const WorkingState& work) {
  Real energy = 0;
  for (const Index v : moving.vertices) {
    if (moving.is_pinned[at(v)] != 0) continue;
    const Vec3 rest = row(work.velocities, v) - moving.rigid.velocity_at(row(work.positions, v));
    energy += work.begin.masses[at(v)] / 2 * rest.squaredNorm();
  }
  return energy;
}

/// Velocities from which BDF2 goes on change by as much as those of now: else it would go on braking.
void scale(const Beside& moving, Real factor, WorkingState& work) {
  for (const Index v : moving.vertices) {
    if (moving.is_pinned[at(v)] != 0) continue;
    const Vec3 rest = row(work.velocities, v) - moving.rigid.velocity_at(row(work.positions, v));
    work.velocities.row(v) -= ((1 - factor) * rest).transpose();
    work.begin.velocities.row(v) -= ((1 - factor) * rest).transpose();
  }
}

/// By what velocities of that kinetic energy are scaled to lose some of it, or all.
Real factor_that_takes(Real energy, Real kinetic) {
  return energy < kinetic ? std::sqrt(1 - energy / kinetic) : 0;
}

}  // namespace

Real ContactEnergy::limit(const StepContext& context, WorkingState& work) {
  const std::size_t count = context.system.components().count();
  stored_.assign(count, 0);
  owed_.assign(count, 0);
  context.contact.add_stored_energies(context.system.components_of_vertices(), stored_);
  find_groups(context, work);
  Real taken = 0;
  if (std::ranges::any_of(touches_, [](char each) { return each != 0; })) {
    find_excess(context, work);
    for (std::size_t group = 0; group < count; ++group) {
      if (excess_[group] > least_excess * sizes_[group]) taken += take(context, group, work);
    }
  }
  write_energies(context.system, work);
  return taken;
}

void ContactEnergy::find_groups(const StepContext& context, const WorkingState& work) {
  const System& system = context.system;
  const std::size_t count = system.components().count();
  const std::span<const Index> component_of_vertex = system.components_of_vertices();
  group_of_.resize(count);
  touches_.assign(count, 0);
  is_driven_.assign(count, 0);
  context.contact.find_touching(component_of_vertex, group_of_, touches_, is_driven_);
  mark_driven(system, work);
  for (std::size_t v = 0; v < work.contact_energies.size(); ++v) {
    if (work.contact_energies[v] < 0) touches_[at(component_of_vertex[v])] = 1;
  }
  for (std::size_t c = 0; c < count; ++c) {
    touches_[group_of_[c]] |= touches_[c];
    is_driven_[group_of_[c]] |= is_driven_[c];
  }
  for (std::size_t c = 0; c < count; ++c) {
    if (group_of_[c] != c || is_driven_[c] != 0) touches_[c] = 0;
  }
  is_held_.assign(count, 1);
  const Components& free = system.free_components();
  for (std::size_t i = 0; i < free.count(); ++i) is_held_[at(component_of_vertex[at(free.component(i).front())])] = 0;
}

void ContactEnergy::mark_driven(const System& system, const WorkingState& work) {
  const std::span<const Index> component_of_vertex = system.components_of_vertices();
  for (Index v = 0; v < system.vertex_count(); ++v) {
    if (system.is_pinned()[at(v)] == 0) continue;
    const bool moves = (work.positions.row(v).array() != work.begin.positions.row(v).array()).any();
    if (moves) is_driven_[at(component_of_vertex[at(v)])] = 1;
  }
  for (ConstraintGroup* group : system.groups()) {
    if (!group->works_from_outside()) continue;
    for (const Index v : group->stencil()) is_driven_[at(component_of_vertex[at(v)])] = 1;
  }
}

void ContactEnergy::find_excess(const StepContext& context, const WorkingState& work) {
  System& system = context.system;
  const std::size_t count = group_of_.size();
  elastic_.resize(count);
  elastic_before_.resize(count);
  forces_.resize(system.vertex_count(), 3);
  system.elastic_energies(work.positions, elastic_);
  system.elastic_step(work.begin.positions, forces_, elastic_before_, context.threads);
  excess_.assign(count, 0);
  sizes_.assign(count, 0);
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t group = group_of_[c];
    if (touches_[group] != 0) excess_[group] += excess_of_component(c, system, work, sizes_[group]);
  }
  const bool is_bdf2 = context.settings.integrator == Integrator::bdf2 && has_history(work.begin, context.time_step);
  if (is_bdf2) allow_by_residual(context, work);
}

/// By how much its H is more than it should be [J]; adds the sum of all that to `size`.
Real ContactEnergy::excess_of_component(std::size_t component, const System& system, const WorkingState& work,
                                        Real& size) const {
  Real now = elastic_[component] + stored_[component];
  Real before = elastic_before_[component];
  Real done = 0;
  size += now + before;
  for (const Index v : system.components().component(component)) {
    if (!work.contact_energies.empty()) before += work.contact_energies[at(v)];
    if (system.is_pinned()[at(v)] != 0) continue;
    const Real half = work.begin.masses[at(v)] / 2;
    const Real kinetic = half * row(work.velocities, v).squaredNorm();
    const Real work_of_forces = row(work.forces, v).dot(row(work.positions, v) - row(work.begin.positions, v));
    now += kinetic;
    before += half * row(work.begin.velocities, v).squaredNorm();
    done += work_of_forces;
    size += kinetic + std::abs(work_of_forces);
  }
  return now - before - done;
}

void ContactEnergy::allow_by_residual(const StepContext& context, const WorkingState& work) {
  const System& system = context.system;
  allowed_.assign(group_of_.size(), 0);
  for (Index v = 0; v < system.vertex_count(); ++v) {
    if (system.is_pinned()[at(v)] != 0) continue;
    const std::size_t group = group_of_[at(system.components_of_vertices()[at(v)])];
    allowed_[group] -= context.time_step * row(work.residual, v).dot(row(work.velocities, v));
  }
  for (std::size_t g = 0; g < excess_.size(); ++g) {
    excess_[g] = std::min(excess_[g], std::max(Real(0), allowed_[g]));
  }
}

Real ContactEnergy::take(const StepContext& context, std::size_t group, WorkingState& work) {
  const Components& components = context.system.components();
  const auto beside_rigid = [&](std::span<const Index> vertices, bool is_held) {
    const RigidMotion none;
    return Beside{vertices,
                  is_held ? none : fit_rigid_motion(vertices, work.positions, work.begin.masses, work.velocities),
                  context.system.is_pinned()};
  };
  const auto vibration = [&](std::size_t c) { return beside_rigid(components.component(c), is_held_[c] != 0); };
  members_.clear();
  vertices_.clear();
  bool is_any_held = false;
  Real vibrating = 0;
  for (std::size_t c = group; c < components.count(); ++c) {
    if (group_of_[c] != group) continue;
    const std::span<const Index> of_component = components.component(c);
    members_.push_back(c);
    vertices_.insert(vertices_.end(), of_component.begin(), of_component.end());
    is_any_held |= is_held_[c] != 0;
    vibrating += kinetic_energy(vibration(c), work);
  }
  const Real excess = excess_[group];
  if (!std::isfinite(excess) || !std::isfinite(vibrating)) return 0;
  const Real factor = factor_that_takes(excess, vibrating);
  for (const std::size_t c : members_) scale(vibration(c), factor, work);
  Real left = excess - std::min(excess, vibrating);
  if (left > least_excess * sizes_[group]) {
    const Beside motion = beside_rigid(vertices_, is_any_held);
    const Real moving = kinetic_energy(motion, work);
    scale(motion, factor_that_takes(left, moving), work);
    left -= std::min(left, moving);
  }
  owe(left);
  return excess - left;
}

/// No more than there is elastic energy: that alone can become motion.
void ContactEnergy::owe(Real energy) {
  Real elastic = 0;
  for (const std::size_t c : members_) elastic += elastic_[c];
  if (!(energy > 0) || !(elastic > 0)) return;
  for (const std::size_t c : members_) owed_[c] = std::min(energy / elastic, Real(1)) * kept_debt * elastic_[c];
}

void ContactEnergy::write_energies(const System& system, WorkingState& work) const {
  const auto count = stored_.size();
  bool is_any = false;
  work.contact_energies.assign(at(system.vertex_count()), 0);
  for (std::size_t c = 0; c < count; ++c) {
    const Real energy = stored_[c] - owed_[c];
    work.contact_energies[at(system.components().component(c).front())] = energy;
    is_any |= energy != 0;
  }
  if (!is_any) work.contact_energies.clear();
}

}  // namespace pliant
