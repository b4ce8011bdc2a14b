#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Whether anything passes through anything in the built-in scenes in which surfaces touch.
void measure_crossings(const ExperimentContext& context, pliant_report::Chapter& chapter);

}  // namespace pliant_experiments
