#pragma once
#include "lab.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.5.
pliant_report::Chapter run_performance(const Lab& lab);

}  // namespace pliant_experiments
