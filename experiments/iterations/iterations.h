#pragma once
// What a material is like after so many iterations: Projective Dynamics beside XPBD and PBD.
#include "experiment_context.h"

namespace pliant_experiments {

/// A strip that hangs on springs: its stretch at rest, and on the way there, over the number of iterations and over the
/// time of a step, against the exact step of implicit Euler.
pliant_report::Chapter run_iterations(const ExperimentContext& context);

}  // namespace pliant_experiments
