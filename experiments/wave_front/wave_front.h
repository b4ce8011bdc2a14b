#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.2 and 6.3 and the right half of Fig. 6.7: how fast a disturbance runs, by the iterations.
pliant_report::Chapter run_wave_front(const ExperimentContext& context);

}  // namespace pliant_experiments
