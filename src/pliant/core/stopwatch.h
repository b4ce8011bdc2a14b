#pragma once
#include <chrono>

namespace pliant {

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// Seconds since it was made or asked here the last time: for phases that follow each other, one look at the clock
  /// for each.
  double lap() {
    const Clock::time_point before = lap_;
    lap_ = Clock::now();
    return std::chrono::duration<double>(lap_ - before).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  Clock::time_point lap_ = start_;
};

}  // namespace pliant
