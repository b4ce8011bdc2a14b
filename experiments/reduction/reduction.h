#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 4.4.3: with A = I changes spread only slowly.
pliant_report::Chapter run_reduction(const ExperimentContext& context);

}  // namespace pliant_experiments
