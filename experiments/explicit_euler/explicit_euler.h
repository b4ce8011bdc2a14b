#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// What the thesis spares itself: the same springs in explicit Euler.
pliant_report::Chapter run_explicit_euler(const ExperimentContext& context);

}  // namespace pliant_experiments
