#pragma once
// Against Newton's method, on the same objective.
#include "experiment_context.h"

namespace pliant_experiments {

/// One step of implicit Euler of a sheet of springs in motion, minimized by Projective Dynamics and by Newton's method:
/// what is left of the error after so many iterations, and after so much time. Two stiffnesses, two sizes.
pliant_report::Chapter run_convergence(const ExperimentContext& context);

}  // namespace pliant_experiments
