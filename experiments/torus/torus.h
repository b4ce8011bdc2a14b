#pragma once
#include "lab.h"

namespace pliant_experiments {

/// Thesis, Sec. 6.1 and Fig. 6.2.
pliant_report::Chapter run_torus(const Lab& lab);

}  // namespace pliant_experiments
