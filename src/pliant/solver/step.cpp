// Projective Dynamics, one step (thesis Algorithm 1; Bouaziz et al. 2014, Algorithm 1), in residual form: with
// r(q) = M/h² (s − q) + Σ wᵢ SᵢᵀAᵢᵀ (pᵢ − zᵢ), minus the gradient of the objective, the global solve Y q' = b is
// q' = q + Y⁻¹ r. The margin has the line numbers of Algorithm 1.
#include <algorithm>
#include <cmath>
#include <string>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"
#include "pliant/solver/integration/integrator.h"
#include "pliant/solver/solver.h"

namespace pliant {

StepReport Solver::step(State& state) {
  const Stopwatch total;
  StepReport report;
  report.reached_tolerance = true;
  if (settings_.substeps == 1) {
    take_substep(state, report);
  } else {
    take_substeps(state, report);
  }
  advance_time(state);
  report.seconds_total = total.seconds();
  return report;
}

void Solver::take_substep(State& state, StepReport& report) {
  prepare(state, report);                             //     factorizes if h, a stiffness or a stencil has changed
  predict(state);                                     // 1-2 s = a + η b + η² M⁻¹ f
  if (projects_energy()) begin_energy(state);         //
  initial_guess(state);                               // 3   q = s (moved by the wind) or qₙ, pins at their targets
  bool reached_tolerance = false;                     //
  for (Index i = 0; i < settings_.iterations; ++i) {  // 4
    const LocalResult local = local_step(state, report);  // 5   r = M/η² (s − q) + Σ w SᵀAᵀ (p − z)
    reached_tolerance = local.residual <= settings_.tolerance;
    if (reached_tolerance && i > 0) break;  //                   never before the first: s knows no constraint
    global_step(local, report);             //             6   q ← q + Y⁻¹ r
  }
  report.reached_tolerance = report.reached_tolerance && reached_tolerance;
  check_finite(state);
  if (projects_energy()) project_energy(state);
  commit(state);  //                                       8   v = (q − a)/η, qₙ = q
}

/// Throws when a residual is not finite, and when the step is to be given up.
LocalResult Solver::local_step(const State& state, StepReport& report) {
  if (stop_ && stop_()) give_up(state);
  threads_->set_active(thread_choice_.threads());
  const Stopwatch watch;
  LocalResult local = local_step_.run(q_, s_, inertia_weights_, is_pinned_, residual_, *threads_);
  if (!std::isfinite(local.residual)) report_divergence(state);
  if (history_.size() < history_.capacity()) history_.push_back(local.inertia + local.elastic);
  local.seconds = watch.seconds();
  report.residual = local.residual;
  report.seconds_local += local.seconds;
  report.seconds_projections += local.seconds_projections;
  return local;
}

void Solver::global_step(const LocalResult& local, StepReport& report) {
  const Stopwatch watch;
  report.solves += global_step_.move(residual_, local.residual, q_, *threads_);
  ++report.iterations;
  const double seconds = watch.seconds();
  report.seconds_global += seconds;
  thread_choice_.took(local.seconds + seconds);
}

void Solver::take_substeps(State& state, StepReport& report) {
  step_start_ = state;
  try {
    for (Index i = 0; i < settings_.substeps; ++i) {
      substep_fraction_ = static_cast<Real>(i + 1) / static_cast<Real>(settings_.substeps);
      state.time = step_start_.time + static_cast<Real>(i) * substep();
      take_substep(state, report);
    }
  } catch (...) {
    state = step_start_;
    forget_prediction();
    substep_fraction_ = 1;
    throw;
  }
  state.time = step_start_.time;
}

void Solver::give_up(const State& state) const {
  throw Error(ErrorKind::interrupted,
              "step " + std::to_string(state.step + 1) + ": given up in the middle; take it again to go on");
}

void Solver::predict(const State& state) {
  predicted_step_ = 0;  // until commit: s is of a step that may yet be refused
  const IntegratorCoefficients form(state, settings_.integrator, substep());
  const Real h = form.inertia_step();
  weigh_inertia(state, h);
  add_forces(state);
  for (Index i = 0; i < vertex_count_; ++i) {
    const Index v = local_groups_.vertex(i);
    const Real mass = masses_[static_cast<std::size_t>(i)];
    s_.row(i) = form.position(v) + h * form.velocity(v) + h * h / mass * force_.row(v);
  }
}

void Solver::initial_guess(const State& state) {
  if (settings_.start == Start::prediction) {
    q_ = s_;
    for (const ConstraintGroup* group : local_groups_.in_use()) group->move_guess(q_, inertia_weights_);
  } else {
    start_from_positions(state);
  }
  apply_pins(q_);
}

void Solver::start_from_positions(const State& state) {
  for (Index i = 0; i < vertex_count_; ++i) q_.row(i) = state.positions.row(local_groups_.vertex(i));
}

void Solver::apply_pins(Positions& q) const {
  for (ConstraintGroup* group : local_groups_.in_use()) {
    const std::span<const Index> pinned = group->pinned_vertices();
    const std::span<const Real> targets = group->targets();
    for (std::size_t i = 0; i < pinned.size(); ++i) {
      const Eigen::Map<const Vec3> target(targets.data() + 3 * i);
      if (substep_fraction_ == 1) {
        q.row(pinned[i]) = target.transpose();
      } else {
        const Vec3 begin = row(step_start_.positions, local_groups_.vertex(pinned[i]));
        q.row(pinned[i]) = (begin + substep_fraction_ * (target - begin)).transpose();
      }
    }
  }
}

void Solver::commit(State& state) {
  const bool is_bdf2 = settings_.integrator == Integrator::bdf2;
  const IntegratorCoefficients form(state, settings_.integrator, substep());
  predicted_step_ = form.inertia_step();
  if (is_bdf2) make_room_for_history(state);
  for (Index i = 0; i < vertex_count_; ++i) {
    const Index v = local_groups_.vertex(i);
    const Vec3 from = form.position(v);
    if (is_bdf2) {
      state.previous_positions.row(v) = state.positions.row(v);
      state.previous_velocities.row(v) = state.velocities.row(v);
    }
    state.velocities.row(v) = (q_.row(i) - from.transpose()) / predicted_step_;
    state.positions.row(v) = q_.row(i);
  }
  if (projects_energy()) {
    commit_energy(state);
  } else {
    state.energy_surplus.clear();
  }
  state.previous_time_step = is_bdf2 ? substep() : 0;
  if (settings_.damping > 0) damp(state);
}

/// Velocities that are damped as e^(-2ch) a step make the amplitude of an oscillation decay as e^(-ct), besides what
/// the integrator takes. Those before, from which BDF2 goes on, are then a step further away.
void Solver::damp(State& state) const {
  const Real factor = std::exp(-2 * settings_.damping * substep());
  damping_.apply(state.positions, state.masses, factor, state.velocities);
  if (state.previous_time_step > 0) {
    damping_.apply(state.previous_positions, state.masses, factor, state.previous_velocities);
  }
}

/// Kahan's sum: after n steps of h the time is n h to the last digit.
void Solver::advance_time(State& state) const {
  ++state.step;
  const Real step = settings_.time_step - state.time_excess;
  const Real time = state.time + step;
  state.time_excess = (time - state.time) - step;
  state.time = time;
}

Evaluation Solver::evaluate(const State& state) {
  const bool is_new = !groups_laid_out_ || groups_changed();
  const bool is_predicted = predicted_step_ > 0;
  if (!is_predicted || is_new) begin_groups(state);
  if (is_new) {
    build_layout();
  } else {
    local_groups_.sync_parameters();
  }
  start_from_positions(state);
  if (!is_predicted) s_ = q_;
  weigh_inertia(state, is_predicted ? predicted_step_ : substep());
  const LocalResult found = local_step_.run(q_, s_, inertia_weights_, is_pinned_, residual_, *threads_);
  return {found.residual, found.inertia, found.elastic};
}

}  // namespace pliant
