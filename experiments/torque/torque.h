#pragma once
#include "lab.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.3: rotation by the number of iterations.
pliant_report::Chapter run_torque(const Lab& lab);

}  // namespace pliant_experiments
