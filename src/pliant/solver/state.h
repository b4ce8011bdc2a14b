#pragma once
#include <algorithm>
#include <limits>

#include "pliant/collision/contact/contact_state.h"
#include "pliant/core/state_view.h"

namespace pliant {

/// Steps at least from one change that looks follow to the next: where there is one in each step, most are not
/// followed.
inline constexpr std::int64_t change_gap = 20;

/// All that changes from step to step.
struct State {
  Positions positions;       ///< qₙ, m × 3 [m]
  Positions velocities;      ///< vₙ, m × 3 [m/s]
  std::vector<Real> masses;  ///< m [kg], > 0
  std::int64_t step = 0;     ///< n, steps taken
  Real time = 0;             ///< tₙ [s]
  Real time_excess = 0;      ///< what rounding has put too much into tₙ so far [s]

  /// What BDF2 and an adaptive start go on from besides: qₙ₋₁ and vₙ₋₁, which were a step of `previous_time_step`
  /// before. 0: there are none, and the next step is one of implicit Euler that begins at its prediction.
  Positions previous_positions{};
  Positions previous_velocities{};
  Real previous_time_step = 0;  ///< [s]

  /// Of the next steps, where the settings leave them to be found; 0: none have been found yet.
  Index iterations = 0;
  /// The step before which what holds or drives bodies has changed last, from which on looks follow it
  /// (simulation/step_error.h); a later one where there were looks shortly before. 0: nothing has changed since the
  /// first step.
  std::int64_t changed_step = 0;

  /// What energy projection has let components have too much and does not give them back, at one vertex of each, m
  /// numbers [J]; empty: nothing.
  std::vector<Real> energy_surplus{};

  /// Where colliders are, and what friction remembers.
  ContactState contact{};

  Index vertex_count() const { return static_cast<Index>(positions.rows()); }
  StateView view() const { return {positions, velocities, masses, step, time}; }
  /// To be told before the next step of what holds or drives bodies, when that changes.
  void note_change() {
    if (step > changed_step) changed_step = changed_step > 0 ? std::max(step, changed_step + change_gap) : step;
  }
  /// To the next step, by Kahan's sum: after n steps of h [s] the time is n h to the last digit.
  void advance_time(Real h) {
    ++step;
    const Real exact = h - time_excess;
    const Real next = time + exact;
    time_excess = (next - time) - exact;
    time = next;
  }
};

/// Where the time of the global solves goes [s].
struct SolveTimes {
  double forward = 0;   ///< with the permutation into the order of the factor
  double backward = 0;  ///< with the permutation back

  SolveTimes& operator+=(const SolveTimes& other) {
    forward += other.forward;
    backward += other.backward;
    return *this;
  }
};

/// Where the time of laying out and factorizing goes [s].
struct SetUpTimes {
  double layout = 0;    ///< slots, gathers, pattern and unit matrices of the groups
  double assembly = 0;  ///< the sum of the system matrix
  double symbolic = 0;  ///< ordering and analysis by the back end
  double numeric = 0;   ///< factorization by the back end
  double repack = 0;    ///< its factor into panels
  double estimate = 0;  ///< whether panels in single precision do
};

/// What a step tells about contact.
struct ContactReport {
  Index contacts = 0;          ///< vertices that touch a collider at its end, each with each
  Real deepest = 0;            ///< how much nearer than r the nearest of them is [m]
  Real friction_power = 0;     ///< that friction takes away in the last substep [W]
  Index held_back = 0;         ///< moves of vertices that were cut at a surface
  Index refactorizations = 0;  ///< with contact in the factor
  Index pairs = 0;             ///< of features of surfaces nearer than twice r at its end
  Index active = 0;            ///< of those, that push each other at its end
  Real smallest_gap = std::numeric_limits<Real>::infinity();  ///< between them at its end [m]
  Real lag = 0;  ///< how far pinned vertices are behind where they should be, held up by what is in their way [m]
  Index shortened = 0;  ///< moves of vertices that were cut so that no surface passes through another
  /// What momentum is short of, after what all forces have given in the step [N s]: what moves that were cut and
  /// iterations that have not converged leave. Bodies that nothing holds lose as much. Of vertices that are not pinned.
  Vec3 momentum_lost = Vec3::Zero();
  /// What contact, and iterations that have not converged, would have put into bodies that touch, and was taken from
  /// their velocities [J].
  Real energy_taken = 0;
  /// At its end, edges that pass through a triangle, and pinned vertices that may pass what has held them up.
  Index let_go = 0;
  std::vector<LetGoBodies> let_go_bodies{};  ///< of which something is let go since this step
  double seconds = 0;                        ///< to find them, add them up and hold back what meets a surface
};

/// What a step tells about itself.
struct StepReport {
  Index iterations = 0;            ///< global solves made, in all substeps
  Index backtracks = 0;            ///< moves that were taken back or shortened, since the objective rose
  bool reached_tolerance = false;  ///< in every substep
  Real residual = 0;               ///< largest force left on a vertex [N], of the iterate before the last solve
  double seconds_local = 0;        ///< projections and the sum of the residual
  double seconds_projections = 0;  ///< the first part of it
  double seconds_global = 0;       ///< triangular solves, and what acceleration makes of them
  double seconds_factor = 0;       ///< assembly and factorization, when something changed
  double seconds_total = 0;
  ContactReport contact;
  SolveTimes solves;  ///< parts of seconds_global
  SetUpTimes set_up;  ///< parts of seconds_factor
};

/// The objective at the positions that the last step ended with; energy projection has moved them past its minimum.
struct Evaluation {
  Real residual = 0;  ///< largest force left on a vertex that is not pinned [N]
  Real inertia = 0;   ///< 1/(2h²) ‖M^½ (q − s)‖² [J], with 2h/3 for h in BDF2
  Real elastic = 0;   ///< Σ wᵢ/2 ‖zᵢ − pᵢ‖² [J]
  Real outside = 0;   ///< the same of what forces bring inside the minimization, as the wind does [J]
  Real contact = 0;   ///< of contact and its friction [J]
  Real objective() const { return inertia + elastic + outside + contact; }
};

}  // namespace pliant
