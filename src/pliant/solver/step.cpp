// Projective Dynamics, one step (thesis Algorithm 1; Bouaziz et al. 2014, Algorithm 1), in residual form: with
// r(q) = M/h² (s − q) + Σ wᵢ SᵢᵀAᵢᵀ (pᵢ − zᵢ), minus the gradient of the objective, the global solve Y q' = b is
// q' = q + Y⁻¹ r. The margin has the line numbers of Algorithm 1.
#include <algorithm>
#include <cmath>
#include <string>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"
#include "pliant/solver/solver.h"

namespace pliant {

StepReport Solver::step(State& state) {
  const Stopwatch total;
  StepReport report;
  report.set_up = prepare(state);
  report.seconds_factor = total.seconds();

  /* 1-2 */ predict(state);  // s = q + h v + h² M⁻¹ f
  /* 3   */ settings_.start == Start::prediction ? void(q_ = s_) : start_from_positions(state);
  place_held_vertices(q_);
  /* 4   */ while (report.iterations < settings_.iterations) {
    if (stop_ && stop_()) give_up(state);
    const Stopwatch local;
    /* 5 */ const LocalResult found = local_step_.run(q_, s_, inertia_weights_, is_held_, residual_, *threads_);
    if (!std::isfinite(found.residual)) report_divergence(state);
    record(found);
    report.residual = found.residual;
    report.seconds_local += local.seconds();
    report.seconds_projections += found.seconds_projections;
    report.reached_tolerance = found.residual <= settings_.tolerance;
    if (report.reached_tolerance) break;

    const Stopwatch global;
    /* 6 */ report.solves += global_step_.move(residual_, found.residual, q_, *threads_);
    ++report.iterations;
    report.seconds_global += global.seconds();
  }
  check_finite(state);
  /* 8   */ commit(state);  // v = (q − qₙ)/h, qₙ = q
  report.seconds_total = total.seconds();
  return report;
}

void Solver::give_up(const State& state) const {
  throw Error(ErrorKind::interrupted,
              "step " + std::to_string(state.step + 1) + ": given up in the middle; take it again to go on");
}

void Solver::predict(const State& state) {
  predicted_time_step_ = 0;  // until commit: s is of a step that may yet be refused
  weigh_inertia(state, settings_.time_step);
  force_.setZero();
  for (Force* force : forces_) force->add_to(force_, state.view(), settings_.time_step);
  const Real h = settings_.time_step;
  for (Index i = 0; i < vertex_count_; ++i) {
    const Index v = local_groups_.vertex(i);
    const Real mass = masses_[static_cast<std::size_t>(i)];
    s_.row(i) = state.positions.row(v) + h * state.velocities.row(v) + h * h / mass * force_.row(v);
  }
}

void Solver::start_from_positions(const State& state) {
  for (Index i = 0; i < vertex_count_; ++i) q_.row(i) = state.positions.row(local_groups_.vertex(i));
}

void Solver::place_held_vertices(Positions& q) const {
  for (ConstraintGroup* group : local_groups_.in_use()) {
    const std::span<const Index> held = group->held_vertices();
    const std::span<const Real> targets = group->targets();
    for (std::size_t i = 0; i < held.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        q(held[i], static_cast<Index>(axis)) = targets[3 * i + axis];
      }
    }
  }
}

void Solver::record(const LocalResult& result) {
  if (history_.size() < history_.capacity()) history_.push_back(result.inertia + result.elastic);
}

void Solver::commit(State& state) {
  for (Index i = 0; i < vertex_count_; ++i) {
    const Index v = local_groups_.vertex(i);
    state.velocities.row(v) = (q_.row(i) - state.positions.row(v)) / settings_.time_step;
    state.positions.row(v) = q_.row(i);
  }
  predicted_time_step_ = settings_.time_step;
  ++state.step;
  // Kahan's sum: after n steps of h the time is n h to the last digit.
  const Real step = settings_.time_step - state.time_excess;
  const Real time = state.time + step;
  state.time_excess = (time - state.time) - step;
  state.time = time;
}

Evaluation Solver::evaluate(const State& state) {
  const bool is_new = !groups_laid_out_ || groups_changed();
  const bool is_predicted = predicted_time_step_ > 0;
  if (!is_predicted || is_new) begin_groups(state);
  is_new ? lay_out_groups() : local_groups_.take_numbers();
  start_from_positions(state);
  if (!is_predicted) s_ = q_;
  weigh_inertia(state, is_predicted ? predicted_time_step_ : settings_.time_step);
  const LocalResult found = local_step_.run(q_, s_, inertia_weights_, is_held_, residual_, *threads_);
  return {found.residual, found.inertia, found.elastic};
}

}  // namespace pliant
