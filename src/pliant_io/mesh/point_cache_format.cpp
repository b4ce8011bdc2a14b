#include "pliant_io/mesh/point_cache_format.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/extension.h"
#include "pliant_io/mesh/detail/cache_readers.h"

namespace pliant {

namespace {

constexpr PointCacheFormat cache_formats[] = {
    {"pc2", read_pc2},
    {"mdd", read_mdd},
    {"npy", read_npy_cache},
};

}  // namespace

std::span<const PointCacheFormat> point_cache_formats() {
  return cache_formats;
}

std::optional<PointCacheFormat> point_cache_format(const std::filesystem::path& path) {
  const auto* const found = std::ranges::find(cache_formats, small_extension(path), &PointCacheFormat::name);
  if (found == std::end(cache_formats)) return {};
  return *found;
}

PointCacheFormat require_point_cache_format(const std::filesystem::path& path) {
  if (const auto format = point_cache_format(path)) return *format;
  fail_input(fmt::format("{}: not the extension of a known point cache; known: {}", printable_place(path.string()),
                         point_cache_extensions()));
}

std::string point_cache_extensions() {
  std::string text;
  for (const PointCacheFormat& format : cache_formats) {
    text += fmt::format("{}.{}", text.empty() ? "" : ", ", format.name);
  }
  return text;
}

}  // namespace pliant
