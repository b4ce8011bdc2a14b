#pragma once
// Figures that follow from what was measured, shared by all reports. Nothing where they cannot be told.
#include <optional>

#include "bench/results.h"

namespace pliant_bench {

/// Time as a multiple of Eigen's solve, median by median.
std::optional<double> times_eigen(const WorkloadResult& workload, const Seconds& seconds);
/// How many times as long the first takes as the second, median by median.
double ratio(const Seconds& slow, const Seconds& fast);
/// CHOLMOD's better mode.
std::optional<Seconds> best_cholmod(const WorkloadResult& workload);
/// [bytes/s], in the fastest repeat
std::optional<double> speed(const Phase& phase);
/// That speed as a share of what one thread reads of a working set of the same size.
std::optional<double> share(const WorkloadResult& workload, const Phase& phase);

}  // namespace pliant_bench
