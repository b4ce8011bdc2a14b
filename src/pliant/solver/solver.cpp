#include "pliant/solver/solver.h"

#include <algorithm>
#include <utility>

#include "pliant/core/stopwatch.h"

namespace pliant {

Solver::Solver(const SolverSettings& settings) {
  set_settings(settings);
}

void Solver::set_settings(const SolverSettings& settings) {
  check_options("settings", settings);
  std::unique_ptr<Factorization> other;
  if (!system_.has_factorization() || settings.backend != settings_.backend ||
      settings.ordering != settings_.ordering) {
    other = make_factorization(settings.backend, settings.ordering);
  }
  threads_.fit(settings.threads, system_.slot_count());  // may fail; nothing has changed until here
  if (other) system_.set_factorization(std::move(other));
  if (settings.precision != settings_.precision) system_.forget_factor();
  settings_ = settings;
  const bool is_automatic = settings_.iterations == automatic_iterations;
  const Index most = is_automatic ? settings_.most_iterations : settings_.iterations;
  history_.reserve(std::min(history_limit, static_cast<std::size_t>(most)));
}

void Solver::set_groups(Index vertex_count, std::vector<ConstraintGroup*> groups) {
  if (vertex_count != system_.vertex_count()) work_.resize(vertex_count);
  const Components free_before = system_.free_components();
  const std::vector<char> pinned_before(system_.is_pinned().begin(), system_.is_pinned().end());
  system_.set_groups(vertex_count, std::move(groups));
  if (system_.needs_layout()) return;
  if (system_.free_components() != free_before || !std::ranges::equal(system_.is_pinned(), pinned_before)) {
    energy_.set_system(system_);
  }
}

StepContext Solver::context(const State& state) {
  return {settings_, substep(), system_, forces_, contact_, threads_.pool(), state};
}

void Solver::prepare(const State& state, StepReport& report) {
  const Stopwatch total;
  SetUpTimes times;
  system_.begin_step(state, settings_.integrator, substep());
  const Stopwatch watch;
  if (system_.needs_layout()) {
    lay_out();
    times.layout = watch.seconds();
  } else {
    system_.sync_parameters();
  }
  work_.gather(state, system_.order());
  if (substep_fraction_ < 1) system_.order().gather(step_start_.positions, work_.step_begin);
  const Real step = inertia_step(settings_.integrator, substep());
  contact_.gather(state, system_, work_);
  if (system_.needs_factor(step, work_.in_factor)) {
    system_.factorize(work_.begin.masses, work_.in_factor, step, settings_.precision, threads_.pool(), times);
  } else if (system_.is_factor_corrected()) {
    system_.set_inertia(work_.begin.masses, step);  // that of the factor, whatever the last step was
    system_.correct_factor();
  }
  history_.clear();
  if (times.numeric > 0 || report.seconds_factor == 0) report.set_up = times;
  report.seconds_factor += total.seconds();
}

/// The prediction goes with the vertices into their new order: evaluate() asks for it after an edit.
void Solver::lay_out() {
  const Real predicted_step = std::exchange(work_.predicted_step, 0);
  Positions prediction;
  system_.order().scatter(work_.prediction, prediction);
  system_.lay_out();
  contact_.forget_order();
  system_.order().gather(prediction, work_.prediction);
  work_.predicted_step = predicted_step;
  threads_.fit(settings_.threads, system_.slot_count());
  energy_.set_system(system_);
}

Evaluation Solver::evaluate(const State& state) {
  const bool is_new = system_.needs_layout();
  const bool is_predicted = work_.predicted_step > 0;
  if (!is_predicted || is_new || system_.needs_begin_step()) system_.begin_step(state, settings_.integrator, substep());
  if (is_new) {
    lay_out();
  } else {
    system_.sync_parameters();
  }
  work_.gather(state, system_.order());
  if (!is_predicted) work_.prediction = work_.begin.positions;
  system_.set_inertia(work_.begin.masses, is_predicted ? work_.predicted_step : substep());
  work_.positions = work_.begin.positions;
  LocalResult found = system_.local_step(work_.positions, work_.prediction, work_.residual, threads_.pool());
  if (is_predicted && !is_new && contact_.has_begun()) {
    contact_.find_forces(work_.positions, threads_.pool());
    contact_.add(work_, found, threads_.pool());
  }
  Evaluation evaluation{found.residual, found.inertia, found.elastic};
  evaluation.contact = found.contact;
  return evaluation;
}

SystemInfo Solver::system_info(const State& state) {
  StepReport unused;
  prepare(state, unused);
  return system_.describe(work_.begin.masses);
}

}  // namespace pliant
