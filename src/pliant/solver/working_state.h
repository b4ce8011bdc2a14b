#pragma once
// What a substep works on, all of it in the solver's order of vertices: gathered from the state at the beginning,
// scattered into it at the end. Only what the user has made keeps the order of the simulation: the state, the groups as
// they were added, and the forces (AppliedForces).
#include "pliant/solver/integration/integrator.h"
#include "pliant/solver/local/locality.h"

namespace pliant {

struct WorkingState {
  State begin;                 ///< qₙ, vₙ, masses, what BDF2 and energy projection go on from; not step and time
  Positions step_begin;        ///< positions before the first substep, m × 3 [m]; where there are several
  Positions forces;            ///< f at the beginning, m × 3 [N]
  Positions not_conservative;  ///< those of f that are not conservative, m × 3 [N]; where energy is projected
  Positions prediction;        ///< s, m × 3 [m]
  Positions positions;         ///< q, the iterate, then qₙ₊₁, m × 3 [m]
  Positions residual;          ///< r, m × 3 [N]
  Positions solution;          ///< x = Y⁻¹ r, m × 3 [m]; where the global step is accelerated
  Positions velocities;        ///< vₙ₊₁, m × 3 [m/s]
  std::vector<Real> energy_surplus;    ///< for the next step (State::energy_surplus); empty: nothing
  std::vector<Real> in_factor;         ///< D of contact [N/m], also for the next step; empty: none (ContactState)
  Index light_steps = 0;               ///< of those for the next step
  std::vector<Real> contact_energies;  ///< ContactState::energies
  Real predicted_step = 0;             ///< η of the prediction [s]; 0: it does not belong to the state

  /// For m vertices; without a prediction.
  void resize(Index vertex_count);
  /// Takes the state that a substep begins with. Allocates only what has another size than before.
  void gather(const State& state, const LocalGroups& order);
  /// Writes what it has ended with, after a step of length h [s], and, where it `keeps_history`, what it began with.
  void scatter(const LocalGroups& order, bool keeps_history, Real h, State& state) const;
};

}  // namespace pliant
