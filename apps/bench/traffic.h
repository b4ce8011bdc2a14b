#pragma once
#include "bench/results.h"
#include "pliant/simulation/simulation.h"

namespace pliant_bench {

/// What each phase of one iteration must read and write at least [bytes]: every number once, and the factor once in
/// each substitution.
struct Traffic {
  std::int64_t projections = 0;
  std::int64_t gather = 0;
  std::int64_t substitution = 0;  ///< forward, with the permutation into the factor's order
  std::int64_t backward = 0;      ///< backward, with that out of it
  std::int64_t update = 0;        ///< q += correction
  std::int64_t working_set = 0;   ///< everything that an iteration touches

  std::int64_t iteration() const { return projections + gather + substitution + backward + update; }
};

Traffic traffic_of(const pliant::Simulation& simulation, const pliant::SystemInfo& info);

}  // namespace pliant_bench
