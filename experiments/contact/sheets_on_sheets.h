#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// What each layer of a stack carries.
void measure_layer_loads(const ExperimentContext& context, pliant_report::Chapter& chapter);

/// A sheet slides on another one.
void measure_sheet_on_sheet(const ExperimentContext& context, pliant_report::Chapter& chapter);

}  // namespace pliant_experiments
