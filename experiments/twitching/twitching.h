#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.4: twitching with one iteration.
pliant_report::Chapter run_twitching(const ExperimentContext& context);

}  // namespace pliant_experiments
