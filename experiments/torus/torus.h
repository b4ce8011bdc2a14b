#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.1 and Fig. 6.2.
pliant_report::Chapter run_torus(const ExperimentContext& context);

}  // namespace pliant_experiments
