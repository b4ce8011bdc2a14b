#pragma once
#include <vector>

#include "bench/results.h"

namespace pliant_bench {

/// Reads as many bytes as something else touches, in turns with it: what a program could do that only reads.
class ReadProbe {
 public:
  explicit ReadProbe(std::int64_t bytes);
  /// One pass over all of them [s], the mean of some in a row that follow one that fills the caches.
  double seconds();
  std::int64_t bytes() const { return static_cast<std::int64_t>(count_ * sizeof(double)); }

 private:
  std::size_t count_;
  std::vector<double> buffer_;
  const double* aligned_;
};

/// How fast one thread reads from each level: half of L2, half of L3, and several times the largest cache. Where there
/// is not enough memory for the last, it is left out.
std::vector<Level> measure_levels();

}  // namespace pliant_bench
