#include "pliant/solver/descent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pliant/core/stopwatch.h"

namespace pliant {
namespace {

/// Contact goes into the factor when a plain move would be shorter than this; in light steps it would have been longer
/// than that.
constexpr Real shortest_length = 0.25;
constexpr Real good_length = 0.5;
/// The contact that is in the factor is taken anew when it makes a plain move so short, or so long.
constexpr Real shortest_of_factor = 0.25;
constexpr Real longest_of_factor = 8;

/// Of a move that has raised the objective: what must be left of it to be worth a trial.
constexpr Real least_share = 0.05;

/// Of the objective: below which a move must bring it to be forgotten, if more than the other share of it was in pairs
/// that are pressed into the logarithm of their potential.
constexpr Real steep_fall = 0.8;
constexpr Real mostly = 0.5;

/// Of the longest way of a global solve: how far a move with memory may lead where surfaces touch; and of a plain move
/// where it is also longer than this share of the longest way that the substep is to take.
constexpr Real longest_of_memory = 5;
constexpr Real longest_of_step = 0.5;

/// Of the parabola's share of a move: below, it is none.
constexpr Real least_of_parabola = 0.01;
constexpr Real smallest_cut = 1e-15;
/// Of the inertia of the last positions: above it the objective is too high to begin there.
constexpr Real far_above = 10;

Real scalar_product(const Positions& a, const Positions& b) {
  return a.cwiseProduct(b).sum();
}

}  // namespace

const Accelerator& Descent::accelerator() const {
  if (chosen_ == Acceleration::anderson) return anderson_;
  if (chosen_ == Acceleration::chebyshev) return chebyshev_;
  return lbfgs_;  // with `none` as well, whose plain moves are watched where they must be
}

Accelerator& Descent::accelerator() {
  return const_cast<Accelerator&>(std::as_const(*this).accelerator());
}

void Descent::begin(const StepContext& context) {
  const auto& groups = context.system.groups();
  has_potentials_ = !std::ranges::all_of(groups, [](const ConstraintGroup* group) { return group->is_projective(); });
  checks_plain_moves_ = context.contact.is_active() || has_potentials_;
  chosen_ = context.settings.acceleration;
  is_accelerated_ = chosen_ == Acceleration::automatic ? checks_plain_moves_ : chosen_ != Acceleration::none;
  has_moved_ = false;
  is_first_ = true;
  judged_.reset();
  steep_energy_ = 0;
  have_pairs_pushed_ = false;
  balance_.begin();
  if (is_needed()) accelerator().begin(context.system.vertex_count());
}

/// What the local step finds, without pairs of surfaces where the last move has been refused without them.
LocalResult Descent::evaluate(const StepContext& context, WorkingState& work) {
  if (judged_) {
    auto [local, is_refused] = *std::exchange(judged_, std::nullopt);
    if (!is_refused) context.contact.add_pairs(work, local);
    return local;
  }
  LocalResult local = context.system.local_step(work.positions, work.prediction, work.residual, context.threads);
  if (context.contact.is_active()) context.contact.add(work, local, context.threads);
  return local;
}

/// A plain move of projections without contact is known to be good, unless it was cut: what is between a vertex that
/// stops and its neighbors that go on is stretched.
bool Descent::must_go_back(const LocalResult& local) const {
  if (!has_moved_) return false;
  const bool is_known = !has_potentials_ && !was_cut_ && accelerator().is_plain() && !(local.contact > 0) &&
                        !(accelerator().local_before().contact > 0);
  return !is_known && accelerator().has_risen(local);
}

LocalResult Descent::local_step(const StepContext& context, WorkingState& work, StepReport& report) {
  LocalResult local = evaluate(context, work);
  if (is_first_ && has_potentials_ && !context.contact.is_active()) local = begin_lower(local, context, work);
  for (Index cuts = 0; cuts <= most_cuts && must_go_back(local); ++cuts) {
    go_back(cuts, local, context, work);
    ++report.backtracks;
    const double seconds = local.seconds_projections;
    local = evaluate(context, work);
    local.seconds_projections += seconds;
  }
  return local;
}

/// A move with memory that went too far is made shorter, along itself, where surfaces push each other: the memory of
/// how stiff they are is worth more than the move. Against colliders a plain move in its place does better.
void Descent::go_back(Index cuts, const LocalResult& local, const StepContext& context, WorkingState& work) {
  const bool may_scale = cuts == 0 && !accelerator().is_plain() && context.contact.pairs_push();
  const Real share = may_scale ? accelerator().best_share(local) : 0;
  if (share > least_share) {
    accelerator().scale_move(share, work.positions);
  } else if (!accelerator().is_plain()) {
    accelerator().note_rise();
    move_plainly(context, work);
    return;
  } else {
    accelerator().shorten(cuts < most_cuts ? next_cut(local) : 0, work.solution, work.positions);
  }
  if (cuts == most_cuts) forget();
  hold_back(context, work);
}

/// What is left of a plain move that has raised the objective. Potentials may stiffen without limit along it: where the
/// parabola leaves next to nothing, the objective has risen with the length to a higher power, of volumes the sixth.
Real Descent::next_cut(const LocalResult& local) const {
  if (!has_potentials_) return cut;
  const Real share = accelerator().best_share(local);
  if (!(share > 0)) return cut;  // the slope has been forgotten
  return std::clamp(share > least_of_parabola ? share : std::pow(share, 0.2), smallest_cut, cut);
}

/// A prediction that leads far into what resists it, as after an impact or from a tangle, is no place to begin: then
/// the substep does so where the one before has ended. Far is where more elastic energy is to be had back than the way
/// there costs, many times.
LocalResult Descent::begin_lower(const LocalResult& local, const StepContext& context, WorkingState& work) {
  const std::span<const Real> weights = context.system.inertia_weights();  // 0 of pinned vertices
  Real inertia = 0;
  for (Index i = 0; i < context.system.vertex_count(); ++i) {
    inertia += weights[at(i)] / 2 * (work.begin.positions.row(i) - work.prediction.row(i)).squaredNorm();
  }
  if (local.objective() <= far_above * inertia) return local;
  work.solution = work.positions;  // both are free until the first solve
  work.velocities = work.residual;
  for (Index i = 0; i < context.system.vertex_count(); ++i) {
    if (context.system.is_pinned()[at(i)] == 0) work.positions.row(i) = work.begin.positions.row(i);
  }
  const LocalResult lower = evaluate(context, work);
  if (!(local.objective() - lower.elastic <= far_above * inertia)) return lower;  // also where it is not finite
  work.positions = work.solution;
  work.residual = work.velocities;
  return local;
}

/// In place of the last move.
void Descent::move_plainly(const StepContext& context, WorkingState& work) {
  if (context.contact.is_active()) context.contact.find_forces(accelerator().positions_before(), context.threads);
  accelerator().move_plainly(work.solution, curvature(context, work), work.positions);
  has_moved_ = checks_plain_moves_;
  hold_back(context, work);
}

/// Where a move is cut it makes no pair, and where it meets another potential it cannot be judged: then it is a plain
/// one, which does not go far.
void Descent::hold_back(const StepContext& context, WorkingState& work) {
  was_cut_ = false;
  judged_.reset();
  if (!context.contact.is_active()) return;
  HeldBack held = context.contact.hold_back_at_colliders(work.positions, context.threads);
  if (!held.has_new_potential && !judge_without_pairs(context, work)) {
    if (held.has_moved) accelerator().forget();
    return;
  }
  const HeldBack by_surfaces =
      context.contact.hold_back_at_surfaces(accelerator().positions_before(), work.positions, context.threads);
  was_cut_ = by_surfaces.has_moved;
  if (was_cut_) judged_.reset();
  held.has_moved |= by_surfaces.has_moved;
  held.has_new_potential |= by_surfaces.has_new_potential;
  if (held.has_moved || held.has_new_potential) accelerator().forget();
  if (!held.has_new_potential) return;
  if (accelerator().is_plain()) {
    has_moved_ = false;
  } else {
    move_plainly(context, work);
  }
}

/// Refuses a move with memory that has raised the objective without pairs of surfaces, whose energy only adds to it:
/// then they need not be found where it leads. Of a move that is refused its best share is found without them as well,
/// so it is too long where they would push; what is left of it is judged again.
bool Descent::judge_without_pairs(const StepContext& context, WorkingState& work) {
  if (!context.contact.has_pairs() || !has_moved_ || accelerator().is_plain()) return true;
  const Stopwatch watch;
  Judged judged{context.system.local_step(work.positions, work.prediction, work.residual, context.threads)};
  context.contact.add_colliders(work, judged.local, context.threads);
  judged.is_refused = accelerator().has_risen(judged.local);
  judged_ = judged;
  seconds_judging_ += watch.seconds();
  return !judged.is_refused;
}

void Descent::move(const LocalResult& local, const StepContext& context, WorkingState& work, StepReport& report) {
  seconds_judging_ = 0;
  solve(local, context, work, report);
  if (!is_accelerated_ || has_left_steep_place(local)) accelerator().forget();
  accelerator().prepare(local, work.residual, work.solution, context.threads);
  accelerator().move(work.solution, accelerator().is_plain() ? curvature(context, work) : 0, work.positions,
                     context.threads);
  has_moved_ = true;
  steep_energy_ = context.contact.steep_energy();
  have_pairs_pushed_ |= context.contact.pairs_push();
  if (!accelerator().is_plain() && have_pairs_pushed_ && is_too_long(context, work)) {
    move_plainly(context, work);
  } else {
    hold_back(context, work);
  }
}

/// Whether the last move has led out of where the potential of pairs is a logarithm, which is far stiffer than what it
/// is there: what such a move says of contact is wrong from now on.
bool Descent::has_left_steep_place(const LocalResult& local) const {
  const Real before = accelerator().local_before().objective();
  return has_moved_ && local.objective() < steep_fall * before && steep_energy_ > mostly * before;
}

/// Whether a move with memory leads farther than surfaces should be searched for. Where contacts begin, the memory may
/// know next to no resistance, and such a move is taken back anyway, or cut at thousands of planes.
bool Descent::is_too_long(const StepContext& context, const WorkingState& work) const {
  const auto longest_of = [](const auto& ways) { return std::sqrt(ways.rowwise().squaredNorm().maxCoeff()); };
  const Real longest = longest_of(work.positions - accelerator().positions_before());
  const Real of_solve = longest_of(work.solution);
  if (longest > longest_of_memory * of_solve) return true;
  if (longest < longest_of_step * longest_of(work.prediction - work.begin.positions)) return false;
  return longest > longest_of_memory * accelerator().plain_length(curvature(context, work)) * of_solve;
}

/// x = B⁻¹ r, with contact in B where that dominates.
void Descent::solve(const LocalResult& local, const StepContext& context, WorkingState& work, StepReport& report) {
  const auto solve_system = [&] {
    report.solves += context.system.solve(work.residual, local.residual, work.solution, context.threads);
  };
  solve_system();
  const bool is_first = std::exchange(is_first_, false);
  if (is_first && context.contact.is_active() && must_factorize(context, work)) {
    factorize(context, work, report);
    solve_system();
  }
}

/// xᵀ (C − D) x, by which a plain move is shorter, with C of where the forces were found last.
Real Descent::curvature(const StepContext& context, const WorkingState& work) const {
  if (!context.contact.is_active()) return 0;
  return context.contact.curvature(work.solution) - in_factor(work);
}

/// Whether contact is to go into the factor, or into it as it is now, and for how many steps more it stays there. The
/// first is decided by how short a plain move on Y would be for the contacts alone that are far stiffer than they were
/// at first; the second by how far D is from C.
bool Descent::must_factorize(const StepContext& context, WorkingState& work) const {
  const ContactSolver& contact = context.contact;
  const Real along = scalar_product(work.solution, work.residual);
  const Real of_contact = in_factor(work);
  const Real resistance = along - of_contact;
  const Real length = resistance / (resistance + contact.stiffened_curvature(work.solution));
  if (work.in_factor.empty()) {
    work.light_steps = 0;
    return length < shortest_length;
  }
  work.light_steps = length > good_length ? work.light_steps + 1 : 0;
  const Real ratio = along / (resistance + contact.curvature(work.solution));
  return ratio < shortest_of_factor || ratio > longest_of_factor;
}

/// xᵀ D x
Real Descent::in_factor(const WorkingState& work) {
  Real sum = 0;
  for (std::size_t i = 0; i < work.in_factor.size(); ++i) {
    sum += work.in_factor[i] * work.solution.row(static_cast<Index>(i)).squaredNorm();
  }
  return sum;
}

void Descent::factorize(const StepContext& context, WorkingState& work, StepReport& report) {
  work.in_factor.assign(at(context.system.vertex_count()), 0);
  context.contact.add_diagonal(work.in_factor);
  if (std::ranges::all_of(work.in_factor, [](Real each) { return each == 0; })) work.in_factor.clear();
  SetUpTimes times;
  context.system.factorize(work.begin.masses, work.in_factor,
                           inertia_step(context.settings.integrator, context.time_step), context.settings.precision,
                           context.threads, times);
  const IntegratorCoefficients form(work.begin, context.settings.integrator, context.time_step);
  context.system.set_inertia(work.begin.masses, form.inertia_step());  // that of the first step of BDF2 is another
  ++report.contact.refactorizations;
}

/// Where surfaces push each other, friction then goes by the loads that a substep ends with, as far as motions of
/// bodies as a whole can follow: the iterations cannot any more.
void Descent::check_last_move(const StepContext& context, WorkingState& work, StepReport& report) {
  if (!has_moved_ && checks_plain_moves_) evaluate(context, work);  // cannot be judged, but its residual is reported
  if (!has_moved_ || (accelerator().is_plain() && !checks_plain_moves_)) return;
  LocalResult local = local_step(context, work, report);
  settle(context, work, local);
  if (!context.contact.pairs_push()) return;
  context.contact.refresh_loads(work, local, context.threads);
  settle(context, work, local);
}

void Descent::settle(const StepContext& context, WorkingState& work, LocalResult& local) {
  if (context.contact.is_active() && balance_.settle(context, work, local)) forget();
}

}  // namespace pliant
