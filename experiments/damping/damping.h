#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.2 and Fig. 6.4 to 6.6.
pliant_report::Chapter run_damping(const ExperimentContext& context);

}  // namespace pliant_experiments
