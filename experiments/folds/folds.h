#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.3: folds by the iterations.
pliant_report::Chapter run_folds(const ExperimentContext& context);

}  // namespace pliant_experiments
