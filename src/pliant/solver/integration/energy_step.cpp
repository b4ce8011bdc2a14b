// Energy projection as a part of the step: what it needs of the local step, the global step and the forces.
#include <cmath>

#include "pliant/solver/integration/integrator.h"
#include "pliant/solver/solver.h"

namespace pliant {

/// Forces of the step; where the energy is kept, those that are not conservative by themselves as well.
void Solver::add_forces(const State& state) {
  const auto add = [&](bool is_conservative) {
    for (Force* force : forces_) {
      if (force->is_conservative() == is_conservative) force->add_to(force_, state.view(), substep());
    }
  };
  force_.setZero();
  if (!projects_energy()) {
    for (Force* force : forces_) force->add_to(force_, state.view(), substep());
    return;
  }
  add(false);
  energy_work_.applied = force_;
  add(true);
}

/// V of each component at q_, and −∇V.
void Solver::evaluate_elastic() {
  EnergyWork& work = energy_work_;
  local_step_.run(q_, q_, work.no_weights, work.none_pinned, work.elastic_forces, *threads_);
  local_step_.elastic_energies(q_, work.elastic);
}

void Solver::begin_energy(const State& state) {
  EnergyWork& work = energy_work_;
  work.elastic.resize(energy_.component_count());
  work.no_weights.assign(inertia_weights_.size(), 0);
  work.none_pinned.assign(inertia_weights_.size(), 0);
  for (Positions* x : {&work.velocities, &work.elastic_forces, &work.outside, &work.not_conservative, &work.direction,
                       &work.end_positions, &work.end_velocities, &work.end_force}) {
    x->resize(vertex_count_, 3);
  }
  start_from_positions(state);
  work.surplus.resize(state.energy_surplus.size());
  for (Index i = 0; i < vertex_count_; ++i) {
    const Index v = local_groups_.vertex(i);
    work.velocities.row(i) = state.velocities.row(v);
    if (!work.surplus.empty())
      work.surplus[static_cast<std::size_t>(i)] = state.energy_surplus[static_cast<std::size_t>(v)];
  }
  evaluate_elastic();
  work.outside.setZero();
  count_external_groups();
  energy_.begin({q_, work.velocities, work.elastic, work.elastic_forces}, masses_, work.surplus);
}

/// Conservative ones are the mean of both ends of the step, at one time: they may change from step to step. The others
/// are as they were at the beginning.
void Solver::find_outside_forces(const State& state) {
  EnergyWork& work = energy_work_;
  for (Index i = 0; i < vertex_count_; ++i) {
    work.end_positions.row(local_groups_.vertex(i)) = q_.row(i);
    work.end_velocities.row(local_groups_.vertex(i)) = work.velocities.row(i);
  }
  const StateView end{work.end_positions, work.end_velocities, state.masses, state.step, state.time};
  work.end_force.setZero();
  for (Force* force : forces_) {
    if (force->is_conservative()) force->add_to(work.end_force, end, substep());
  }
  for (Index i = 0; i < vertex_count_; ++i) {
    const Index v = local_groups_.vertex(i);
    work.not_conservative.row(i) = work.applied.row(v);
    work.outside.row(i) = (force_.row(v) - work.applied.row(v) + work.end_force.row(v)) / 2 + work.applied.row(v);
  }
}

/// What external groups do counts as from outside: their V is left out, so their forces are too.
void Solver::count_external_groups() {
  EnergyWork& work = energy_work_;
  for (ConstraintGroup* group : local_groups_.in_use()) {
    const GroupShape shape = group->shape();
    if (!group->is_external() || shape.count == 0) continue;
    const auto n = static_cast<std::size_t>(shape.vertices);
    const auto k = static_cast<std::size_t>(shape.rows);
    work.slot.resize(3 * k);
    for (std::size_t i = 0; i < static_cast<std::size_t>(shape.count); ++i) {
      group->project(q_, work.slot, static_cast<Index>(i), static_cast<Index>(i) + 1);
      for (std::size_t entry = 0; entry < k * n; ++entry) {
        const Eigen::Map<const Vec3> slot(work.slot.data() + 3 * (entry / n));
        const Vec3 force = group->reduction()[i * k * n + entry] * slot;
        const Index vertex = group->stencil()[i * n + entry % n];
        work.outside.row(vertex) += force.transpose();
        if (group->targets().empty()) work.not_conservative.row(vertex) += force.transpose();
        work.elastic_forces.row(vertex) -= force.transpose();
      }
    }
  }
}

void Solver::evaluate_end(const State& state) {
  find_outside_forces(state);
  evaluate_elastic();
  count_external_groups();
}

void Solver::project_energy(const State& state) {
  EnergyWork& work = energy_work_;
  const IntegratorCoefficients form(state, settings_.integrator, substep());
  for (Index i = 0; i < vertex_count_; ++i) {
    work.velocities.row(i) = (q_.row(i) - form.position(local_groups_.vertex(i))) / form.inertia_step();
  }
  const StepEnd end{q_, work.velocities, work.elastic, work.elastic_forces};
  const OutsideForces outside{work.outside, work.not_conservative};
  evaluate_end(state);
  Positions& forces = residual_;
  energy_.balance(end, outside, substep(), settings_.energy_projection, forces);
  global_step_.solve(forces, forces.cwiseAbs().maxCoeff(), work.direction, *threads_);
  energy_.move(end, forces, work.direction, inertia_weights_, q_);
  evaluate_end(state);
  energy_.finish(end, outside, work.velocities);
  check_finite(state);
}

void Solver::commit_energy(State& state) {
  EnergyWork& work = energy_work_;
  work.surplus.resize(static_cast<std::size_t>(vertex_count_));
  energy_.write_surplus(work.surplus);
  state.energy_surplus.resize(work.surplus.size());
  const Real left = std::exp(-2 * settings_.damping * substep());  // by damping, of the energy of a vibration
  for (Index i = 0; i < vertex_count_; ++i) {
    const Index v = local_groups_.vertex(i);
    state.velocities.row(v) = work.velocities.row(i);
    state.energy_surplus[static_cast<std::size_t>(v)] = left * work.surplus[static_cast<std::size_t>(i)];
  }
}

}  // namespace pliant
