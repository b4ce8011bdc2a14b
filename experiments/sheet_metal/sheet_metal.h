#pragma once
#include "lab.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.3 and Fig. 6.7.
pliant_report::Chapter run_sheet_metal(const Lab& lab);

}  // namespace pliant_experiments
