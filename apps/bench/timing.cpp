#include "bench/timing.h"

#include <algorithm>

#include "pliant/core/stopwatch.h"

namespace pliant_bench {
namespace {

constexpr int least_repeats = 5;
constexpr int most_repeats = 200;

}  // namespace

Seconds Samples::spread() const {
  if (seconds_.empty()) return {};
  std::vector<double> sorted = seconds_;
  std::ranges::sort(sorted);
  const std::size_t middle = sorted.size() / 2;
  const double median = sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
  return {sorted.front(), median};
}

int repeat(std::optional<int> repeats, double seconds, const std::function<void()>& round) {
  const pliant::Stopwatch watch;
  const auto is_enough = [&](int done) {
    if (repeats) return done >= *repeats;
    return done >= most_repeats || (done >= least_repeats && watch.seconds() > seconds);
  };
  int done = 0;
  for (; !is_enough(done); ++done) round();
  return done;
}

}  // namespace pliant_bench
