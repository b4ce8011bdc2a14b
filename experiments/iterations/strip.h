#pragma once
// One strip, moved by one method or another.
#include <functional>
#include <vector>

#include "experiment_context.h"
#include "support/newton.h"
#include "support/xpbd.h"

namespace pliant_experiments {

/// The strip of the scene with springs of this constant [N/m].
pliant::Scene strip(const ExperimentContext& context, double stiffness);

/// How much longer the strip is than without a load, of its length: the mean over its lower edge, downwards.
double stretch(const pliant::Scene& rest, const pliant::Positions& positions);

/// Takes one step and returns where the vertices are then.
using Mover = std::function<const pliant::Positions&()>;

Mover by_projective_dynamics(const ExperimentContext& context, double stiffness, int iterations, pliant::Start start);
Mover by_position_based_dynamics(const ExperimentContext& context, double stiffness, const XpbdOptions& options);
/// Each step to the minimum of its objective.
Mover by_newton(const ExperimentContext& context, double stiffness);

/// The stretch at rest, by Newton's method alone: no step, no inertia is left in it.
double stretch_at_rest(const ExperimentContext& context, double stiffness);

/// The strip after each step, the start first, and what a step costs.
struct Fall {
  std::vector<double> stretch;
  double seconds = 0;        ///< of a step, the median
  pliant::Positions last{};  ///< m × 3 [m]

  /// Mean over the last `count` steps.
  double last_mean(int count) const;
};

/// Lets a mover take so many steps.
Fall fall(const pliant::Scene& rest, const Mover& mover, int steps);

}  // namespace pliant_experiments
