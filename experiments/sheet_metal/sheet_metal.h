#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.3 and Fig. 6.7.
pliant_report::Chapter run_sheet_metal(const ExperimentContext& context);

}  // namespace pliant_experiments
