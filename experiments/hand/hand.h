#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.3: a closed body under strong forces.
pliant_report::Chapter run_hand(const ExperimentContext& context);

}  // namespace pliant_experiments
