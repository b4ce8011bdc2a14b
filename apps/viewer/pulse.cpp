#include "viewer/pulse.h"

#include <algorithm>

namespace pliant_viewer {
namespace {

constexpr Seconds memory{1};
constexpr std::size_t least_beats = 5;  // are kept, however old

}  // namespace

void Pulse::add(const Beat& beat) {
  beats_.push_back(beat);
  while (beats_.size() > least_beats && beat.when - beats_.front().when > memory) beats_.pop_front();
}

Pulse::Means Pulse::means(Clock::time_point now) const {
  Means means;
  if (beats_.size() < 2) return means;
  const auto intervals = static_cast<double>(beats_.size() - 1);
  const double last_interval = Seconds(now - beats_.back().when).count();
  double span = Seconds(beats_.back().when - beats_.front().when).count();
  if (last_interval > 2 * span / intervals) span += last_interval;
  for (auto beat = beats_.begin() + 1; beat != beats_.end(); ++beat) {
    means.speed += beat->simulated;
    means.local += beat->local / intervals;
    means.global += beat->global / intervals;
    means.factor += beat->factor / intervals;
    means.total += beat->total / intervals;
  }
  span = std::max(span, 1e-9);
  means.rate = intervals / span;
  means.speed /= span;
  return means;
}

}  // namespace pliant_viewer
