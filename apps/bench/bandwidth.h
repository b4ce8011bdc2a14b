#pragma once
#include <vector>

#include "bench/results.h"

namespace pliant_bench {

/// How fast one thread reads from each level: half of L2, half of L3, and several times the largest cache. Where there
/// is not enough memory for the last, it is left out.
std::vector<Level> measure_levels();

}  // namespace pliant_bench
