#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Contact with colliders: friction, impacts, convergence and cost. Of surfaces: crossings, loads, friction and cost.
pliant_report::Chapter run_contact(const ExperimentContext& context);

}  // namespace pliant_experiments
