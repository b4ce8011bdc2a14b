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
  if (beats_.empty()) return means;
  const auto count = static_cast<double>(beats_.size());
  for (const Beat& beat : beats_) {
    means.local += beat.local / count;
    means.global += beat.global / count;
    means.factor += beat.factor / count;
    means.total += beat.total / count;
  }
  if (beats_.size() < 2) return means;
  const double intervals = count - 1;
  for (auto beat = beats_.begin() + 1; beat != beats_.end(); ++beat) means.speed += beat->simulated;
  const double last_interval = Seconds(now - beats_.back().when).count();
  double span = Seconds(beats_.back().when - beats_.front().when).count();
  if (last_interval > 2 * span / intervals) span += last_interval;
  span = std::max(span, 1e-9);
  means.rate = intervals / span;
  means.speed /= span;
  return means;
}

}  // namespace pliant_viewer
