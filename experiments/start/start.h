#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.4: where the iterations begin.
pliant_report::Chapter run_start(const ExperimentContext& context);

}  // namespace pliant_experiments
