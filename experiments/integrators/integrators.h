#pragma once
#include "lab.h"

namespace pliant_experiments {

/// Beyond the thesis: integrators and damping that answer its main complaint.
pliant_report::Chapter run_integrators(const Lab& lab);

}  // namespace pliant_experiments
