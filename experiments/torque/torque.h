#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.3: rotation by the number of iterations.
pliant_report::Chapter run_torque(const ExperimentContext& context);

}  // namespace pliant_experiments
