#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Time of a step over the size of a cloth that may touch itself.
void measure_surface_cost(const ExperimentContext& context, pliant_report::Chapter& chapter);

}  // namespace pliant_experiments
