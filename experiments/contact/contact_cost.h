#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Time of a step over the size of a cloth, with and without colliders.
void measure_contact_cost(const ExperimentContext& context, pliant_report::Chapter& chapter);

}  // namespace pliant_experiments
