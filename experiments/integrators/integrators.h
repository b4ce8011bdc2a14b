#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Beyond the thesis: integrators and damping that answer its main complaint.
pliant_report::Chapter run_integrators(const ExperimentContext& context);

}  // namespace pliant_experiments
