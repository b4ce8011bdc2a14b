#pragma once
// A sheet on a plane that stands still.
#include "experiment_context.h"

namespace pliant_experiments {

/// It sticks or slides on a slope of 16, 17 and 30 degrees, friction 0.3.
void measure_slope(const ExperimentContext& context, pliant_report::Chapter& chapter);

/// It slides to a stop.
void measure_stop(const ExperimentContext& context, pliant_report::Chapter& chapter);

}  // namespace pliant_experiments
