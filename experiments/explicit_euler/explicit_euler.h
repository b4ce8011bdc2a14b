#pragma once
#include "lab.h"

namespace pliant_experiments {

/// What the thesis spares itself: the same springs in explicit Euler.
pliant_report::Chapter run_explicit_euler(const Lab& lab);

}  // namespace pliant_experiments
