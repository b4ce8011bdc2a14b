// MDD: the counts of frames and vertices, a time for each frame, then float32; all of it big end first.
#include <algorithm>

#include "pliant_io/mesh/detail/cache_readers.h"

namespace pliant {

PointCache read_mdd(std::string bytes, std::string_view name, Real /*frames_per_second*/) {
  constexpr std::size_t counts_size = 8;
  if (bytes.size() < counts_size) {
    fail_cache(name, "header: is cut off; an MDD file begins with two counts of 4 bytes");
  }
  const CacheCounts counts = {big_endian_at<std::int32_t>(bytes, 0), big_endian_at<std::int32_t>(bytes, 4)};
  const std::size_t first =
      counts_size + static_cast<std::size_t>(std::max<std::int64_t>(0, counts.frames)) * sizeof(float);
  check_cache_size(name, bytes, first, counts, sizeof(float), CacheTail::refused);
  std::vector<Real> times(static_cast<std::size_t>(counts.frames));
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] = static_cast<Real>(big_endian_at<float>(bytes, counts_size + i * sizeof(float)));
  }
  return {std::move(bytes),
          {first, PointCache::Scalar::float32_big_endian, static_cast<Index>(counts.vertices)},
          std::move(times)};
}

}  // namespace pliant
