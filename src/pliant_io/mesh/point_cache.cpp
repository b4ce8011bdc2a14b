#include "pliant_io/mesh/point_cache.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/mesh/detail/cache_readers.h"
#include "pliant_io/mesh/point_cache_format.h"

namespace pliant {

namespace {

void check_times(std::string_view name, const std::vector<Real>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i])) {
      fail_cache(name, fmt::format("frame {}: its time is not finite; write the file again", i));
    }
    if (!std::isfinite(times[i] - times.front())) {
      fail_cache(
          name, fmt::format("frame {}: its time, {} s, is further from the first, {} s, than numbers go; give times in "
                            "seconds",
                            i, times[i], times.front()));
    }
    if (i > 0 && !(times[i] > times[i - 1])) {
      fail_cache(
          name, fmt::format("frame {}: its time, {} s, is not after that of the frame before, {} s; give frames rising "
                            "times",
                            i, times[i], times[i - 1]));
    }
  }
}

}  // namespace

void check_frame_rate(const PointCacheOptions& options) {
  if (std::isfinite(options.frames_per_second) && options.frames_per_second > 0) return;
  fail_input(
      fmt::format("{} frames per second are not possible; give a number greater than 0", options.frames_per_second));
}

void fail_cache(std::string_view name, std::string_view what) {
  fail_input(fmt::format("{}: {}", printable_place(name), what));
}

void check_cache_size(std::string_view name, std::string_view bytes, std::size_t first_byte, CacheCounts counts,
                      std::size_t number_size, CacheTail tail) {
  if (counts.frames < 1) fail_cache(name, fmt::format("header: {} frames; there must be at least one", counts.frames));
  if (counts.vertices < 1 || counts.vertices > std::numeric_limits<Index>::max()) {
    fail_cache(name, fmt::format("header: {} vertices; there must be from 1 to {}", counts.vertices,
                                 std::numeric_limits<Index>::max()));
  }
  const std::size_t available = bytes.size() - std::min(first_byte, bytes.size());
  const std::uint64_t frame_size = static_cast<std::uint64_t>(counts.vertices) * 3 * number_size;
  const std::uint64_t frames = available / frame_size;
  const auto wanted = static_cast<std::uint64_t>(counts.frames);
  const bool is_longer = tail == CacheTail::refused && (frames > wanted || available % frame_size != 0);
  if (first_byte <= bytes.size() && frames >= wanted && !is_longer) return;
  fail_cache(
      name, fmt::format("header: {} frames of {} vertices do not fit a file of {} bytes, which has {} such frames; the "
                        "file is cut off or its header wrong: write it again",
                        counts.frames, counts.vertices, bytes.size(), frames));
}

std::vector<Real> even_times(std::int64_t count, Real start, Real rate, Real frames_per_second) {
  std::vector<Real> times(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = (start + static_cast<Real>(i) * rate) / frames_per_second;
  return times;
}

PointCache::PointCache(std::string bytes, const Layout& layout, std::vector<Real> times)
    : bytes_(std::move(bytes)), layout_(layout), times_(std::move(times)) {}

PointCache PointCache::parse(std::string bytes, std::string_view name, const PointCacheFormat& format,
                             const PointCacheOptions& options) {
  check_frame_rate(options);
  PointCache cache = format.parse(std::move(bytes), name, options.frames_per_second);
  check_times(name, cache.times_);
  cache.check_numbers(name);
  return cache;
}

PointCache PointCache::read(const std::filesystem::path& path, const PointCacheOptions& options) {
  const PointCacheFormat format = require_point_cache_format(path);
  return parse(read_file(path), path.string(), format, options);
}

PointCache PointCache::from_frames(std::span<const Positions> frames, std::vector<Real> times) {
  if (frames.empty()) fail_input("a point cache of no frames; give at least one");
  std::string bytes;
  const Eigen::Index vertex_count = frames.front().rows();
  bytes.reserve(frames.size() * static_cast<std::size_t>(vertex_count) * 3 * sizeof(double));
  for (const Positions& positions : frames) {
    if (positions.rows() != vertex_count || vertex_count == 0) {
      fail_input(fmt::format("a frame of {} vertices among frames of {}; give all frames the same, one or more",
                             positions.rows(), vertex_count));
    }
    bytes.append(reinterpret_cast<const char*>(positions.data()),
                 static_cast<std::size_t>(positions.size()) * sizeof(double));
  }
  PointCache cache(std::move(bytes), {0, Scalar::float64, static_cast<Index>(vertex_count)},
                   std::vector<Real>(frames.size()));
  cache.check_numbers("frames");
  cache.set_times(std::move(times));
  return cache;
}

void PointCache::set_times(std::vector<Real> times) {
  if (times.empty() || times.size() > times_.size()) {
    fail_input(fmt::format("{} times for {} frames; give at least one, and not more than frames", times.size(),
                           times_.size()));
  }
  check_times("times", times);
  times_ = std::move(times);
}

Real PointCache::number(std::size_t i) const {
  switch (layout_.scalar) {
    case Scalar::float32:
      return static_cast<Real>(cache_number_at<float>(bytes_, layout_.first_byte + i * sizeof(float)));
    case Scalar::float32_big_endian:
      return static_cast<Real>(big_endian_at<float>(bytes_, layout_.first_byte + i * sizeof(float)));
    case Scalar::float64:
      break;
  }
  return cache_number_at<double>(bytes_, layout_.first_byte + i * sizeof(double));
}

void PointCache::check_numbers(std::string_view name) const {
  const auto frame_size = static_cast<std::size_t>(layout_.vertex_count) * 3;
  const std::size_t count = frame_size * times_.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isfinite(number(i))) continue;
    fail_cache(name, fmt::format("frame {}, vertex {}: its position is not finite; write the frames before it only",
                                 i / frame_size, i % frame_size / 3));
  }
}

Vec3 PointCache::position(std::int64_t frame, Index vertex) const {
  const std::size_t first = (static_cast<std::size_t>(frame) * static_cast<std::size_t>(layout_.vertex_count) +
                             static_cast<std::size_t>(vertex)) *
                            3;
  return {number(first), number(first + 1), number(first + 2)};
}

void PointCache::frame(std::int64_t frame, Positions& positions) const {
  positions.resize(layout_.vertex_count, 3);
  const auto size = static_cast<std::size_t>(positions.size());
  const std::size_t first = static_cast<std::size_t>(frame) * size;
  for (std::size_t i = 0; i < size; ++i) positions.data()[i] = number(first + i);
}

void PointCache::sample(Real time, Positions& positions) const {
  const auto next = std::ranges::upper_bound(times_, time) - times_.begin();
  if (next == 0 || next == frame_count()) return frame(std::max<std::int64_t>(0, next - 1), positions);
  const Real before = this->time(next - 1);
  const Real share = (time - before) / (this->time(next) - before);
  positions.resize(layout_.vertex_count, 3);
  const auto size = static_cast<std::size_t>(positions.size());
  const std::size_t first = static_cast<std::size_t>(next - 1) * size;
  for (std::size_t i = 0; i < size; ++i) {
    positions.data()[i] = (1 - share) * number(first + i) + share * number(first + size + i);
  }
}

}  // namespace pliant
