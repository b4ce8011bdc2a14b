#include "pliant/solver/descent.h"

#include <utility>

namespace pliant {
namespace {

/// Contact goes into the factor when a plain move would be shorter than this, and out of it again after so many steps
/// in which it would have been longer than that.
constexpr Real shortest_length = 0.25;
constexpr Real good_length = 0.5;
constexpr Index light_steps_needed = 10;

Real scalar_product(const Positions& a, const Positions& b) {
  return a.cwiseProduct(b).sum();
}

}  // namespace

void Descent::begin(const StepContext& context) {
  checks_plain_moves_ = context.contact.is_active();
  const Acceleration chosen = context.settings.acceleration;
  is_accelerated_ = chosen == Acceleration::lbfgs || (chosen == Acceleration::automatic && checks_plain_moves_);
  has_moved_ = false;
  is_first_ = true;
  is_contact_in_factor_ = false;
  if (is_needed()) lbfgs_.begin(context.system.vertex_count());
}

LocalResult Descent::evaluate(const StepContext& context, WorkingState& work) const {
  LocalResult local = context.system.local_step(work.positions, work.prediction, work.residual, context.threads);
  if (context.contact.is_active()) context.contact.add(work, local, context.threads);
  return local;
}

/// A plain move without contact is known to be good.
bool Descent::must_go_back(const LocalResult& local) const {
  if (!has_moved_ || (lbfgs_.is_plain() && !checks_plain_moves_)) return false;
  return lbfgs_.has_risen(local);
}

LocalResult Descent::local_step(const StepContext& context, WorkingState& work, StepReport& report) {
  LocalResult local = evaluate(context, work);
  for (Index cuts = 0; cuts <= most_cuts && must_go_back(local); ++cuts) {
    go_back(cuts, context, work);
    ++report.backtracks;
    const double seconds = local.seconds_projections;
    local = evaluate(context, work);
    local.seconds_projections += seconds;
  }
  return local;
}

void Descent::go_back(Index cuts, const StepContext& context, WorkingState& work) {
  if (!lbfgs_.is_plain()) {
    lbfgs_.move_plainly(work.solution, work.positions);
    has_moved_ = checks_plain_moves_;
  } else {
    lbfgs_.shorten(cuts < most_cuts ? cut : 0, work.solution, work.positions);
  }
  if (cuts == most_cuts) forget();
  hold_back(context, work);
}

/// Where a move is cut it makes no pair, and where it meets another potential it cannot be judged.
void Descent::hold_back(const StepContext& context, WorkingState& work) {
  if (!context.contact.is_active()) return;
  const HeldBack held = context.contact.hold_back(work.positions, context.threads);
  if (held.has_moved || held.has_new_potential) lbfgs_.forget();
  if (held.has_new_potential) has_moved_ = false;
}

void Descent::move(const LocalResult& local, const StepContext& context, WorkingState& work, StepReport& report) {
  const Real curvature = solve(local, context, work, report);
  if (!is_accelerated_) lbfgs_.forget();
  lbfgs_.move(local, work.residual, work.solution, curvature, work.positions, context.threads);
  has_moved_ = true;
  hold_back(context, work);
}

/// x = B⁻¹ r, with contact in B where that dominates. Returns xᵀ (C − D) x, by which a plain move is shorter.
Real Descent::solve(const LocalResult& local, const StepContext& context, WorkingState& work, StepReport& report) {
  const auto solve_system = [&] {
    report.solves += context.system.solve(work.residual, local.residual, work.solution, context.threads);
  };
  const bool is_first = std::exchange(is_first_, false);
  is_contact_in_factor_ |= is_first && context.contact.is_active() && work.contact_in_factor;
  if (is_first && is_contact_in_factor_) factorize(context, work, report);
  solve_system();
  if (!context.contact.is_active()) return 0;
  if (is_first && judge_contact(context, work)) {
    factorize(context, work, report);
    solve_system();
  }
  return context.contact.contact().curvature(work.solution) - in_factor(work);
}

/// Whether contact is to go into the factor now, or for how many steps more it stays there: by how short a plain move
/// on Y would be for the contacts alone that are far stiffer than they were at first.
bool Descent::judge_contact(const StepContext& context, WorkingState& work) {
  const Real resistance = scalar_product(work.solution, work.residual) - in_factor(work);
  const Real stiffened = context.contact.contact().stiffened_curvature(work.solution);
  const Real length = resistance / (resistance + stiffened);
  if (is_contact_in_factor_) {
    work.light_steps = length > good_length ? work.light_steps + 1 : 0;
    work.contact_in_factor = work.light_steps < light_steps_needed;
    return false;
  }
  work.light_steps = 0;
  work.contact_in_factor = is_contact_in_factor_ = length < shortest_length;
  return is_contact_in_factor_;
}

/// xᵀ D x
Real Descent::in_factor(const WorkingState& work) const {
  if (!is_contact_in_factor_) return 0;
  Real sum = 0;
  for (std::size_t i = 0; i < diagonal_.size(); ++i) {
    sum += diagonal_[i] * work.solution.row(static_cast<Index>(i)).squaredNorm();
  }
  return sum;
}

void Descent::factorize(const StepContext& context, WorkingState& work, StepReport& report) {
  diagonal_.assign(at(context.system.vertex_count()), 0);
  context.contact.contact().add_diagonal(diagonal_);
  SetUpTimes times;
  context.system.factorize_with(diagonal_, work.begin.masses,
                                inertia_step(context.settings.integrator, context.time_step),
                                context.settings.precision, context.threads, times);
  ++report.contact.refactorizations;
}

void Descent::check_last_move(const StepContext& context, WorkingState& work, StepReport& report) {
  if (!has_moved_ || (lbfgs_.is_plain() && !checks_plain_moves_)) return;
  local_step(context, work, report);
}

}  // namespace pliant
