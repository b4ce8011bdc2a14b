#pragma once
// Bodies that hit something.
#include "experiment_context.h"

namespace pliant_experiments {

/// A sheet thrown at a plane, a sphere, a capsule and a box.
void measure_thrown_sheets(const ExperimentContext& context, pliant_report::Chapter& chapter);

/// A soft block falls onto a plane and comes to rest.
void measure_dropped_block(const ExperimentContext& context, pliant_report::Chapter& chapter);

}  // namespace pliant_experiments
