#pragma once
// How far the iterations of a step leave it from where it should end, and how many are enough.
#include "pliant/simulation/simulation.h"

namespace pliant {

/// How far a step ends from where it would with a great many iterations, of the body in which that is farthest. What
/// matters is what it does to a motion: bodies are then accelerated by e/h² too much or too little, so that cloth falls
/// slowly, stands off its own folds and does not swing.
struct StepError {
  BodyId body{};
  Real distance = 0;      ///< e, the root of the mean square over the mass of the body [m]
  Real acceleration = 0;  ///< e/h² [m/s²]
  /// Of that the share in the gravity of the earth, or in how strongly the step accelerates the body, if that is more.
  Real share = 0;
};

inline constexpr Real standard_gravity = 9.80665;  ///< [m/s²]

/// From here on it shows.
inline constexpr Real far_from_converged = 0.5;

/// Takes the coming step twice, with the iterations that it will have and with eight times as many and L-BFGS, at least
/// 160 and at most 2,000, and leaves the state as it was: steps to come have the same bits either way. Costs as many
/// iterations. What contacts(), evaluate() and objective_history() tell is not of the last step then. Nothing where the
/// step diverges, or has 2,000 iterations or more itself, as those have that end at a tolerance.
/// @throws Error (interrupted) when it is given up (Simulation::set_stop)
std::optional<StepError> find_step_error(Simulation& simulation);

/// So many steps after what holds or drives bodies has changed the motion has begun, and is looked at: errors are
/// largest about then.
inline constexpr std::int64_t look_after_change = 10;

/// Whether automatic iterations are to be found before the coming step: before steps 10, 30, 90 and each 180th, and
/// where what holds or drives bodies has changed, before the first step with it, look_after_change later and 30 steps
/// later.
bool finds_iterations(const State& state);

/// Finds iterations for the coming steps, as StepError of the coming one tells, and puts them into the state. Half as
/// many more are tried until their error is no larger than the setting, and a third fewer where it is less than half of
/// that. Where something has changed they are at least as many as in the first step, and no fewer look_after_change
/// later: what was enough at rest says nothing of the motion. Throws as find_step_error().
void find_iterations(Simulation& simulation);

}  // namespace pliant
