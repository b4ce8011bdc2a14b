#pragma once
// The readers of point caches, one file each, and what they share. The bytes are little-endian, as those of every
// machine that Pliant is built for; MDD's are not.
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/mesh/point_cache.h"

namespace pliant {

static_assert(std::endian::native == std::endian::little, "PC2 and '<f8' are read as they lie in memory");

// Each of them: PointCacheFormat::parse.
PointCache read_pc2(std::string bytes, std::string_view name, Real frames_per_second);
PointCache read_mdd(std::string bytes, std::string_view name, Real frames_per_second);
PointCache read_npy_cache(std::string bytes, std::string_view name, Real frames_per_second);

/// What a header says.
struct CacheCounts {
  std::int64_t frames = 0;
  std::int64_t vertices = 0;
};

/// Whether something may stand behind the frames: in a file that is still written to, a part of the next one.
enum class CacheTail { allowed, refused };

/// The numbers from `first_byte` on must be there, each of `number_size` bytes, and nothing behind them unless `tail`
/// allows it. @throws Error (input)
void check_cache_size(std::string_view name, std::string_view bytes, std::size_t first_byte, CacheCounts counts,
                      std::size_t number_size, CacheTail tail);

/// The times (start + i · rate) / frames_per_second of `count` frames [s].
std::vector<Real> even_times(std::int64_t count, Real start, Real rate, Real frames_per_second);

/// @throws Error (input) `name: what`
[[noreturn]] void fail_cache(std::string_view name, std::string_view what);

/// The number of type Number at a byte; it must be there.
template <typename Number>
Number cache_number_at(std::string_view bytes, std::size_t first) {
  Number number;
  std::memcpy(&number, bytes.data() + first, sizeof number);
  return number;
}

template <typename Number>
Number big_endian_at(std::string_view bytes, std::size_t first) {
  static_assert(sizeof(Number) == 4);
  const auto bits = __builtin_bswap32(cache_number_at<std::uint32_t>(bytes, first));
  return std::bit_cast<Number>(bits);
}

}  // namespace pliant
