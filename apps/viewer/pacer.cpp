#include "viewer/pacer.h"

#include <algorithm>

namespace pliant_viewer {

void Pacer::start(Clock::time_point now) {
  last_ = now;
  steps_behind_ = 1;
}

Seconds Pacer::wait(Clock::time_point now, double h) {
  const double elapsed = std::max(0.0, Seconds(now - last_).count());
  last_ = now;
  if (speed_ >= unlimited) {
    steps_behind_ = 1;
    return Seconds(0);
  }
  steps_behind_ = std::min(steps_behind_ + elapsed * speed_ / h, most_behind);
  if (steps_behind_ >= 1) return Seconds(0);
  return Seconds((1 - steps_behind_) * h / speed_);
}

}  // namespace pliant_viewer
