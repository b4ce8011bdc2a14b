#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.5.
pliant_report::Chapter run_performance(const ExperimentContext& context);

}  // namespace pliant_experiments
