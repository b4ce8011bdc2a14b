// Point caches, the format chosen by the first byte: an Error or frames of finite positions at finite, rising times.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fuzz.h"
#include "pliant_io/mesh/point_cache_format.h"

namespace {

using pliant_fuzz::require;

void check_samples(const pliant::PointCache& cache, pliant::Real time) {
  pliant::Positions positions;
  cache.sample(time, positions);
  require(positions.rows() == cache.vertex_count() && positions.allFinite(), "a position is not finite");
}

void check(const pliant::PointCache& cache) {
  constexpr std::int64_t most_samples = 20;
  require(cache.frame_count() > 0 && cache.vertex_count() > 0, "a cache of nothing");
  for (std::int64_t i = 0; i < cache.frame_count(); ++i) {
    require(std::isfinite(cache.time(i)), "a time is not finite");
    require(i == 0 || cache.time(i) > cache.time(i - 1), "times do not rise");
  }
  constexpr pliant::Real infinity = std::numeric_limits<pliant::Real>::infinity();
  for (const pliant::Real time : {-infinity, infinity}) check_samples(cache, time);
  for (std::int64_t i = 0; i + 1 < std::min(cache.frame_count(), most_samples); ++i) {
    for (const pliant::Real share : {0.0, 0.01, 0.5, 0.99}) {
      check_samples(cache, (1 - share) * cache.time(i) + share * cache.time(i + 1));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto formats = pliant::point_cache_formats();
  const pliant::PointCacheFormat& format = formats[data[0] % formats.size()];
  pliant_fuzz::expect_errors_only([&] {
    // The slowest rate that a user may give brings the times near the largest doubles.
    for (const pliant::Real rate : {24.0, 1e-270}) {
      check(pliant::PointCache::parse(std::string(pliant_fuzz::text(data + 1, size - 1)), "fuzz", format, {rate}));
    }
  });
  return 0;
}
