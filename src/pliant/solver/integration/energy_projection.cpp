#include "pliant/solver/integration/energy_projection.h"

#include <cmath>

#include "pliant/solver/constraint_rows.h"
#include "pliant/solver/divergence.h"

namespace pliant {

void EnergyProjection::set_system(const System& system) {
  balance_.set_components(system.components(), system.free_components(), system.is_pinned());
}

void EnergyProjection::begin(const StepContext& step, const WorkingState& work) {
  outside_.setZero(work.positions.rows(), 3);
  for (Positions* x : {&elastic_forces_, &direction_}) x->resize(work.positions.rows(), 3);
  evaluate_elastic(step, work.begin.positions);
  balance_.begin({work.begin.positions, work.begin.velocities, elastic_, elastic_forces_}, work.begin.masses,
                 work.begin.energy_surplus, step.threads);
}

void EnergyProjection::project(const StepContext& step, WorkingState& work) {
  const StepEnd end{work.positions, work.velocities, elastic_, elastic_forces_};
  evaluate_end(step, work);
  Positions& forces = work.residual;
  balance_.balance(end, outside_, step.time_step, step.settings.energy_projection, forces);
  step.system.solve(forces, direction_, step.threads);
  balance_.move(end, forces, direction_, step.system.inertia_weights(), work.positions);
  evaluate_end(step, work);
  balance_.finish(end, outside_, work.velocities);
  check_finite(step, work);

  const Real left = std::exp(-2 * step.settings.damping * step.time_step);  // by damping, of a vibration's energy
  work.energy_surplus.resize(at(step.system.vertex_count()));
  balance_.write_surplus(work.energy_surplus);
  for (Real& energy : work.energy_surplus) energy *= left;
}

/// Conservative forces are the mean of both ends of the step, at one time: they may change from step to step. The
/// others are as they were at the beginning.
void EnergyProjection::evaluate_end(const StepContext& step, const WorkingState& work) {
  step.forces.evaluate_conservative(step.state, work.positions, work.velocities, step.time_step, step.system.order(),
                                    conservative_);
  outside_ = (work.forces - work.not_conservative + conservative_) / 2 + work.not_conservative;
  step.system.freeze_shapes(work.positions, step.state, step.time_step);
  evaluate_elastic(step, work.positions);
}

void EnergyProjection::evaluate_elastic(const StepContext& step, const Positions& q) {
  elastic_.resize(step.system.components().count());
  step.system.elastic_step(q, elastic_forces_, elastic_, step.threads);
  add_external_groups(step.system, q);
}

/// What external groups do counts as from outside: their V is left out, so their forces are too.
void EnergyProjection::add_external_groups(const System& system, const Positions& q) {
  for (ConstraintGroup* group : system.groups()) {
    if (!group->works_from_outside()) continue;
    const auto rows = static_cast<std::size_t>(group->shape().rows);
    slots_.resize(3 * rows);
    for (Index i = 0; i < group->shape().count; ++i) {
      group->project(q, slots_, i, i + 1);
      const std::span<const Index> stencil = stencil_of(*group, at(i));
      for (std::size_t r = 0; r < rows; ++r) {
        const Eigen::Map<const Vec3> slot(slots_.data() + 3 * r);
        const std::span<const Real> row = reduction_row(*group, at(i), r);
        for (std::size_t a = 0; a < row.size(); ++a) {
          const Vec3 force = row[a] * slot;
          outside_.row(stencil[a]) += force.transpose();
          elastic_forces_.row(stencil[a]) -= force.transpose();
        }
      }
    }
  }
}

}  // namespace pliant
