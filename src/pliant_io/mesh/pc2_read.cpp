// PC2: a header of 32 bytes, then float32.
#include <fmt/format.h>

#include "pliant_io/mesh/detail/cache_readers.h"

namespace pliant {

PointCache read_pc2(std::string bytes, std::string_view name, Real frames_per_second) {
  constexpr std::string_view magic("POINTCACHE2\0", 12);
  constexpr std::size_t header_size = 32;
  if (!bytes.starts_with(magic) || bytes.size() < header_size) {
    fail_cache(
        name, "does not begin with POINTCACHE2 and a header of 32 bytes; give a file of the format that its name says");
  }
  if (const auto version = cache_number_at<std::int32_t>(bytes, 12); version != 1) {
    fail_cache(name, fmt::format("header: version {}; only version 1 is known, export the cache as that", version));
  }
  const CacheCounts counts = {cache_number_at<std::int32_t>(bytes, 28), cache_number_at<std::int32_t>(bytes, 16)};
  const Real start = cache_number_at<float>(bytes, 20);
  const Real rate = cache_number_at<float>(bytes, 24);
  check_cache_size(name, bytes, header_size, counts, sizeof(float), CacheTail::allowed);
  return {std::move(bytes),
          {header_size, PointCache::Scalar::float32, static_cast<Index>(counts.vertices)},
          even_times(counts.frames, start, rate, frames_per_second)};
}

}  // namespace pliant
