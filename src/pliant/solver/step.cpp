// Projective Dynamics, one step (thesis Algorithm 1; Bouaziz et al. 2014, Algorithm 1), in residual form: with
// r(q) = M/h² (s − q) + Σ wᵢ SᵢᵀAᵢᵀ (pᵢ − zᵢ), minus the gradient of the objective, the global solve Y q' = b is
// q' = q + Y⁻¹ r. The margin has the line numbers of Algorithm 1; in take_substep() a, b and η are those of
// integration/integrator.h, which for implicit Euler are qₙ, vₙ and h.
#include <cmath>
#include <string>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"
#include "pliant/solver/component_loops.h"
#include "pliant/solver/divergence.h"
#include "pliant/solver/integration/rigid_damping.h"
#include "pliant/solver/solver.h"

namespace pliant {
StepReport Solver::step(State& state) {
  const Stopwatch total;
  StepReport report;
  report.reached_tolerance = true;
  contact_.begin_step(state, settings_.time_step);
  if (settings_.substeps == 1) {
    take_substep(state, report);
  } else {
    take_substeps(state, report);
  }
  contact_.commit_step(state);
  state.advance_time(settings_.time_step);
  report.seconds_total = total.seconds();
  return report;
}

void Solver::take_substep(State& state, StepReport& report) {
  prepare(state, report);                                         //     refactorizes where something has changed
  predict(state);                                                 // 1-2 s = a + η b + η² M⁻¹ f
  if (projects_energy()) energy_.begin(context(state), work_);    //
  initial_guess();                                                // 3   q = s, q⁰ or qₙ, pins at their targets
  if (contact_.is_active()) begin_contact(state);                 //     and nothing inside a collider
  descent_.begin(context(state));                                 //
  bool reached_tolerance = false;                                 //
  for (Index i = 0; i < iterations(state); ++i) {                 // 4
    const LocalResult local = local_step(state, i, report);       // 5   r = M/η² (s − q) + Σ w SᵀAᵀ (p − z)
    reached_tolerance = local.residual <= settings_.tolerance;    //
    if (reached_tolerance && i > 0) break;                        //     at least one iteration a step
    global_step(state, local, report);                            // 6   q ← q + Y⁻¹ r, or q + H r
  }                                                               //
  if (!reached_tolerance && descent_.is_needed())                 //
    descent_.check_last_move(context(state), work_, report);      //     which must not have raised E either
  report.reached_tolerance &= reached_tolerance;                  //
  check_finite(context(state), work_);                            //
  find_velocities();                                              // 8   v = (q − a)/η
  if (contact_.is_active()) add_momentum_lost(report.contact);    //     M v falls short by η r
  if (contact_.has_pairs()) limit_energy(state, report.contact);  //     contact gives no energy
  if (projects_energy()) energy_.project(context(state), work_);  //     onto the energy that q and v should have
  commit(state, report);                                          //     qₙ = q, vₙ = v
}

/// A step that fails in a later substep is not taken at all.
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

void Solver::predict(const State& state) {
  work_.predicted_step = 0;  // until commit: s is of a step that may yet be refused
  const IntegratorCoefficients form(work_.begin, settings_.integrator, substep());
  const Real h = form.inertia_step();
  system_.set_inertia(work_.begin.masses, h);
  if (projects_energy()) {
    forces_.evaluate_apart(state, substep(), system_.order(), work_);
  } else {
    forces_.evaluate(state, substep(), system_.order(), work_);
  }
  for_each_vertex(system_.vertex_count(), &threads_.pool(), [&](Index i) {
    const Real mass = work_.begin.masses[at(i)];
    work_.prediction.row(i) = form.position(i) + h * form.velocity(i) + h * h / mass * work_.forces.row(i);
  });
}

void Solver::initial_guess() {
  if (settings_.start == Start::positions) {
    work_.positions = work_.begin.positions;
  } else {
    work_.positions = work_.prediction;
    for (const ConstraintGroup* group : system_.groups()) group->move_guess(work_.positions, system_.inertia_weights());
  }
  if (settings_.start == Start::adaptive && has_history(work_.begin, substep())) {
    const IntegratorCoefficients form(work_.begin, settings_.integrator, substep());
    balanced_guess_.move(work_, form, substep(), system_.components_of_vertices(), system_.components().count(),
                         system_.is_pinned(), work_.positions);
  }
  apply_pins();
}

void Solver::apply_pins() {
  for (ConstraintGroup* group : system_.groups()) {
    const std::span<const Index> pinned = group->pinned_vertices();
    const std::span<const Real> targets = group->targets();
    for (std::size_t i = 0; i < pinned.size(); ++i) {
      const Eigen::Map<const Vec3> target(targets.data() + 3 * i);
      if (substep_fraction_ == 1) {
        work_.positions.row(pinned[i]) = target.transpose();
      } else {
        const Vec3 begin = row(work_.step_begin, pinned[i]);
        work_.positions.row(pinned[i]) = (begin + substep_fraction_ * (target - begin)).transpose();
      }
    }
  }
}

void Solver::begin_contact(const State& state) {
  const Real share = 1 / static_cast<Real>(settings_.substeps);
  contact_.begin_substep(state, substep_fraction_ - share, substep_fraction_, substep(), system_, work_,
                         threads_.pool());
}

/// Takes back moves that have raised E, and refreshes friction when it is time. Throws when a residual is not finite,
/// and when the step is to be given up.
LocalResult Solver::local_step(const State& state, Index iteration, StepReport& report) {
  if (stop_ && stop_()) {
    throw Error(ErrorKind::interrupted,
                "step " + std::to_string(state.step + 1) + ": given up in the middle; take it again to go on");
  }
  threads_.begin_iteration();
  const Stopwatch watch;
  LocalResult local = descent_.local_step(context(state), work_, report);
  if (contact_.stiffen(system_, work_, local, threads_.pool())) descent_.forget();
  if (contact_.is_refresh_due(iteration, iterations(state), local.residual <= settings_.tolerance)) {
    descent_.settle(context(state), work_, local);
    const bool touches = local.contact > 0;
    contact_.refresh(work_, local, threads_.pool());
    if (touches || local.contact > 0) descent_.forget();
  }
  if (!std::isfinite(local.residual)) report_divergence(context(state), work_);
  if (history_.size() < history_.capacity()) history_.push_back(local.objective());
  local.seconds = watch.seconds();
  report.residual = local.residual;
  report.seconds_local += local.seconds;
  report.seconds_projections += local.seconds_projections;
  return local;
}

void Solver::global_step(const State& state, const LocalResult& local, StepReport& report) {
  const Stopwatch watch;
  double seconds_local = 0;
  if (descent_.is_needed()) {
    descent_.move(local, context(state), work_, report);
    seconds_local = descent_.seconds_judging();
  } else {
    report.solves += system_.global_step(work_.residual, local.residual, work_.positions, threads_.pool());
  }
  ++report.iterations;
  const double seconds = watch.seconds();
  report.seconds_local += seconds_local;
  report.seconds_global += seconds - seconds_local;
  threads_.end_iteration(local.seconds + seconds);
}

void Solver::find_velocities() {
  const IntegratorCoefficients form(work_.begin, settings_.integrator, substep());
  for_each_vertex(system_.vertex_count(), &threads_.pool(), [&](Index i) {
    work_.velocities.row(i) = (work_.positions.row(i) - form.position(i)) / form.inertia_step();
  });
}

/// r is that of the last iterate: with contact the last move is judged too.
void Solver::add_momentum_lost(ContactReport& report) const {
  const Real step = IntegratorCoefficients(work_.begin, settings_.integrator, substep()).inertia_step();
  for (Index i = 0; i < system_.vertex_count(); ++i) {
    if (system_.is_pinned()[at(i)] == 0) report.momentum_lost += step * row(work_.residual, i);
  }
}

void Solver::limit_energy(const State& state, ContactReport& report) {
  report.energy_taken += contact_energy_.limit(context(state), work_);
}

/// Velocities that are damped as e^(-2ch) a step make the amplitude of an oscillation decay as e^(-ct), besides what
/// the integrator takes. Those before, from which BDF2 and an adaptive start go on, are then a step further away.
void Solver::commit(State& state, StepReport& report) {
  if (!projects_energy()) work_.energy_surplus.clear();
  work_.predicted_step = IntegratorCoefficients(work_.begin, settings_.integrator, substep()).inertia_step();
  const Real factor = std::exp(-2 * settings_.damping * substep());
  const auto damp = [&](const Positions& positions, Positions& velocities) {
    damp_vibrations(system_.components(), system_.is_pinned(), positions, work_.begin.masses, factor, velocities,
                    threads_.pool());
  };
  if (settings_.damping > 0) damp(work_.positions, work_.velocities);
  if (settings_.damping > 0 && keeps_history(settings_)) {
    damp(work_.begin.positions, work_.begin.velocities);
  }
  if (!contact_.has_pairs()) state.contact.energies.clear();
  if (contact_.is_active()) contact_.commit_substep(system_, work_, threads_.pool(), state, report.contact);
  work_.scatter(system_.order(), keeps_history(settings_), substep(), state);
}

}  // namespace pliant
