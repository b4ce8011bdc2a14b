#pragma once
#include "bench/bench.h"

namespace pliant_bench {

WorkloadResult measure_workload(const Workload& workload, const BenchOptions& options);

/// Of a falling cloth: steps 30 to 120, without contact, with colliders alone, and with surfaces that touch, in turns.
ContactResult measure_contact(const Workload& workload, const BenchOptions& options);

/// Each type of constraint by itself, on sheets of 100 × 100 vertices and a bar of 20,000 tetrahedra.
std::vector<ProjectionsResult> measure_projections(std::optional<int> repeats);

}  // namespace pliant_bench
