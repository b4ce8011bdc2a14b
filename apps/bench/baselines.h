#pragma once
// The baselines of one workload, checked against Pliant and timed in turns with it.
#include <memory>
#include <vector>

#include "bench/bench.h"
#include "bench/solves.h"
#include "bench/textbook.h"
#include "bench/timing.h"

namespace pliant_bench {

/// One program to compare with, ready to run.
class Baseline {
 public:
  virtual ~Baseline() = default;
  /// One solve, or one iteration: the mean of a few in a row [s].
  virtual double seconds() = 0;

  BaselineResult result;
  Samples samples;
};

/// What the baselines start from and must arrive at.
struct Reference {
  const pliant::Simulation& simulation;  ///< at the start of a step
  const pliant::Positions& after_step;   ///< where that step ends
  pliant::LowerMatrix matrix;
  double contraction;  ///< of the factor's precision
};

/// The matrix of a simulation, summed anew.
pliant::LowerMatrix system_matrix(const pliant::Simulation& simulation);

/// Makes and checks those that the options ask for. Throws Error(input) when one gives another result than Pliant.
std::vector<std::unique_ptr<Baseline>> make_baselines(const BenchOptions& options, const Reference& reference);

}  // namespace pliant_bench
