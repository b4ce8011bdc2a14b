#pragma once
// Repeats that take turns: A B C A B C ..., so that what slows the machine down for a while slows all of them.
#include <functional>
#include <optional>
#include <vector>

#include "bench/results.h"

namespace pliant_bench {

/// Times of one thing; the order of repeats is kept.
class Samples {
 public:
  void add(double seconds) { seconds_.push_back(seconds); }
  Seconds spread() const;

 private:
  std::vector<double> seconds_;
};

/// Calls round() the given number of times, or for about `seconds`, at least five times and at most 200. Returns how
/// many times.
int repeat(std::optional<int> repeats, double seconds, const std::function<void()>& round);

}  // namespace pliant_bench
