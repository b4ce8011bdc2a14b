#pragma once
#include "experiment_context.h"

namespace pliant_experiments {

/// One step of a cloth that hits a sphere, with and without L-BFGS.
void measure_contact_convergence(const ExperimentContext& context, pliant_report::Chapter& chapter);

}  // namespace pliant_experiments
