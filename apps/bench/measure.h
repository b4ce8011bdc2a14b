#pragma once
#include "bench/bench.h"

namespace pliant_bench {

WorkloadResult measure_workload(const Workload& workload, const BenchOptions& options);

/// Each type of constraint by itself, on sheets of 100 × 100 vertices and a bar of 20,000 tetrahedra.
std::vector<ProjectionsResult> measure_projections(std::optional<int> repeats);

}  // namespace pliant_bench
