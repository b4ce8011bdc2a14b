#pragma once
// A sheet on ground that moves.
#include "experiment_context.h"

namespace pliant_experiments {

/// A conveyor belt takes it along.
void measure_conveyor(const ExperimentContext& context, pliant_report::Chapter& chapter);

/// A turntable takes it along, until it turns too fast.
void measure_turntable(const ExperimentContext& context, pliant_report::Chapter& chapter);

}  // namespace pliant_experiments
