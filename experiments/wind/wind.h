#pragma once
#include "lab.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.1 and Fig. 6.1.
pliant_report::Chapter run_wind(const Lab& lab);

}  // namespace pliant_experiments
