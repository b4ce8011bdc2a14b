#include "pliant_io/export/keyframes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {
namespace {

Real diagonal(const Positions& positions, Index first, Index count) {
  if (count == 0) return 0;
  const auto part = positions.middleRows(first, count);
  return (part.colwise().maxCoeff() - part.colwise().minCoeff()).norm();
}

/// The bounding box of a body over all frames.
Real way(const Animation& animation, Index first, Index count) {
  Positions corners(2, 3);
  Positions positions;
  for (std::size_t frame = 0; frame < animation.times.size(); ++frame) {
    animation.cache.sample(animation.times[frame], positions);
    const auto part = positions.middleRows(first, count);
    const auto low = part.colwise().minCoeff().eval();
    const auto high = part.colwise().maxCoeff().eval();
    corners.row(0) = frame == 0 ? low : corners.row(0).cwiseMin(low).eval();
    corners.row(1) = frame == 0 ? high : corners.row(1).cwiseMax(high).eval();
  }
  return diagonal(corners, 0, 2);
}

class KeyframeSearch {
 public:
  explicit KeyframeSearch(const Animation& animation) : animation_(animation), last_(animation.times.size() - 1) {
    const std::vector<Real> sizes = body_sizes(animation);
    scales_.resize(static_cast<std::size_t>(animation.cache.vertex_count()), 1 / sizes.front());
    for (std::size_t body = 0; body < animation.bodies.size(); ++body) {
      const auto begin = scales_.begin() + animation.bodies[body].first_vertex;
      std::fill(begin, begin + animation.bodies[body].mesh.vertex_count(), 1 / sizes[body]);
    }
  }

  /// From each keyframe to the farthest that is within the tolerance; none when that takes more than max_count.
  std::vector<std::size_t> keyframes(Real tolerance, std::int64_t max_count) {
    std::vector<std::size_t> frames = {0};
    while (frames.back() < last_) {
      if (std::ssize(frames) == max_count) return {};
      frames.push_back(farthest(frames.back(), tolerance));
    }
    return frames;
  }

  Real largest_error(const std::vector<std::size_t>& frames) {
    Real largest = 0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
      largest = std::max(largest, error(frames[i - 1], frames[i], std::numeric_limits<Real>::infinity()));
    }
    return largest;
  }

 private:
  /// Doubles the distance while that goes well, then bisects.
  std::size_t farthest(std::size_t first, Real tolerance) {
    std::size_t good = first + 1;
    std::size_t bad = last_ + 1;
    for (std::size_t distance = 2; good < last_; distance *= 2) {
      const std::size_t frame = std::min(first + distance, last_);
      if (error(first, frame, tolerance) > tolerance) {
        bad = frame;
        break;
      }
      good = frame;
    }
    while (good + 1 < bad && good < last_) {
      const std::size_t middle = good + (bad - good) / 2;
      (error(first, middle, tolerance) > tolerance ? bad : good) = middle;
    }
    return good;
  }

  /// The largest error of interpolating between two frames, or the first one found that exceeds `limit`.
  Real error(std::size_t first, std::size_t last, Real limit) {
    if (last - first < 2) return 0;
    sample(first, before_);
    sample(last, after_);
    Real largest = 0;
    for (std::size_t frame = first + 1; frame < last && largest <= limit; ++frame) {
      largest = std::max(largest, error_of_frame(first, frame, last));
    }
    return largest;
  }

  Real error_of_frame(std::size_t first, std::size_t frame, std::size_t last) {
    const std::vector<Real>& times = animation_.times;
    const Real share = (times[frame] - times[first]) / (times[last] - times[first]);
    sample(frame, between_);
    Real largest = 0;
    for (Index v = 0; v < between_.rows(); ++v) {
      const Real scale = scales_[static_cast<std::size_t>(v)];
      const Real squared =
          (between_.row(v) - (1 - share) * before_.row(v) - share * after_.row(v)).squaredNorm() * scale * scale;
      largest = std::max(largest, squared);
    }
    return std::sqrt(largest);
  }

  void sample(std::size_t frame, Positions& positions) const {
    animation_.cache.sample(animation_.times[frame], positions);
  }

  const Animation& animation_;
  std::size_t last_;
  std::vector<Real> scales_;  ///< 1 / size of the body, for each vertex
  Positions before_, between_, after_;
};

}  // namespace

std::vector<Real> body_sizes(const Animation& animation) {
  const auto size = [&](const Positions& start, Index first, Index count) {
    const Real extent = diagonal(start, first, count);
    if (extent > 0) return extent;
    const Real length = count == 0 ? 0 : way(animation, first, count);
    return length > 0 ? length : 1;
  };
  Positions start;
  animation.cache.sample(animation.times.front(), start);
  std::vector<Real> sizes;
  for (const Body& body : animation.bodies) sizes.push_back(size(start, body.first_vertex, body.mesh.vertex_count()));
  if (sizes.empty()) sizes.push_back(size(start, 0, animation.cache.vertex_count()));
  return sizes;
}

Keyframes choose_keyframes(const Animation& animation, Real tolerance, std::int64_t max_count) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) {
    fail_input(fmt::format("a tolerance of {} is not possible; give a number from 0 up", tolerance));
  }
  if (max_count < 2) fail_input(fmt::format("at most {} keyframes are not enough; give a number from 2 up", max_count));
  KeyframeSearch search(animation);
  Keyframes result{search.keyframes(tolerance, max_count), 0};
  if (result.frames.empty()) {
    constexpr int halvings = 12;
    Real high = 1;
    while ((result.frames = search.keyframes(high, max_count)).empty()) high *= 16;
    Real low = tolerance;
    for (int i = 0; i < halvings; ++i) {
      const Real middle = low > 0 ? std::sqrt(low * high) : high / 16;
      std::vector<std::size_t> frames = search.keyframes(middle, max_count);
      (frames.empty() ? low : high) = middle;
      if (!frames.empty()) result.frames = std::move(frames);
    }
  }
  result.largest_error = search.largest_error(result.frames);
  return result;
}

}  // namespace pliant
