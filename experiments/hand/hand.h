#pragma once
#include "lab.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.3: a closed body under strong forces.
pliant_report::Chapter run_hand(const Lab& lab);

}  // namespace pliant_experiments
