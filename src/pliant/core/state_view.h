#pragma once
// What constraints and forces may see of a simulation at the start of a step.
#include "pliant/core/types.h"

namespace pliant {

/// A read-only view of m vertices at time tₙ; valid during the call it is handed to.
struct StateView {
  const Positions& positions;       ///< qₙ, m × 3 [m]
  const Positions& velocities;      ///< vₙ, m × 3 [m/s]
  const std::vector<Real>& masses;  ///< m [kg]
  std::int64_t step;                ///< n, the number of steps taken so far
  Real time;                        ///< tₙ [s]

  /// The step to come, as its integrator has it: v = (q − a)/η.
  Real inertia_step = 0;                          ///< η [s]; 0: nobody has said
  const Positions* previous_positions = nullptr;  ///< qₙ₋₁ of a step of BDF2 that has it, else null

  /// a of a vertex [m]: qₙ, or (4 qₙ − qₙ₋₁)/3 of BDF2.
  Vec3 origin(Index vertex) const {
    const Vec3 now = row(positions, vertex);
    return previous_positions == nullptr ? now : Vec3((4 * now - row(*previous_positions, vertex)) / 3);
  }
};

}  // namespace pliant
