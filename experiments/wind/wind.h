#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.1 and Fig. 6.1.
pliant_report::Chapter run_wind(const ExperimentContext& context);

}  // namespace pliant_experiments
