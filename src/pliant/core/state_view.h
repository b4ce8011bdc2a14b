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
};

}  // namespace pliant
