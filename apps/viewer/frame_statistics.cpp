#include "viewer/frame_statistics.h"

#include <algorithm>

namespace pliant_viewer {
namespace {

constexpr Seconds memory{1};
constexpr std::size_t least_samples = 5;  // kept however old they are

}  // namespace

void FrameStatistics::add(const Sample& sample) {
  samples_.push_back(sample);
  while (samples_.size() > least_samples && sample.when - samples_.front().when > memory) samples_.pop_front();
}

FrameStatistics::Means FrameStatistics::means(Clock::time_point now) const {
  Means means;
  if (samples_.empty()) return means;
  const auto count = static_cast<double>(samples_.size());
  for (const Sample& sample : samples_) {
    means.local += sample.local / count;
    means.global += sample.global / count;
    means.factor += sample.factor / count;
    means.contact += sample.contact / count;
    means.total += sample.total / count;
  }
  if (samples_.size() < 2) return means;
  const double intervals = count - 1;
  for (auto sample = samples_.begin() + 1; sample != samples_.end(); ++sample) means.speed += sample->simulated;
  const double last_interval = Seconds(now - samples_.back().when).count();
  double span = Seconds(samples_.back().when - samples_.front().when).count();
  if (last_interval > 2 * span / intervals) span += last_interval;
  span = std::max(span, 1e-9);
  means.rate = intervals / span;
  means.speed /= span;
  return means;
}

}  // namespace pliant_viewer
