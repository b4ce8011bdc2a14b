#pragma once
#include "lab.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.4: where the iterations begin.
pliant_report::Chapter run_start(const Lab& lab);

}  // namespace pliant_experiments
