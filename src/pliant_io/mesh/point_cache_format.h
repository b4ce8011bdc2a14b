#pragma once
// The list of point caches' formats. A new one is a reader, declared in detail/cache_readers.h, and an entry in
// point_cache_format.cpp: messages, commands, scenes and tests follow from the list.
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "pliant_io/mesh/point_cache.h"

namespace pliant {

/// A file format of point caches.
struct PointCacheFormat {
  std::string_view name;  ///< also the extension, in small letters without the point

  /// The bytes as frames. `name` is what messages call them; `frames_per_second` > 0 goes to formats without times.
  /// @throws Error (input) with the place in the file
  PointCache (*parse)(std::string bytes, std::string_view name, Real frames_per_second);
};

/// All of them, in the order in which messages name them: PC2 of 3ds Max, Blender and Houdini: float32, evenly spaced,
/// times in frames. MDD of LightWave: float32, a time [s] for each frame. NPY, NumPy's array, frames × m × 3 of float32
/// or float64, as `pliant run` writes it: no times.
std::span<const PointCacheFormat> point_cache_formats();

/// The format that a file's extension tells, in any case; none for another extension.
std::optional<PointCacheFormat> point_cache_format(const std::filesystem::path& path);
/// The same. @throws Error (input), listing the known ones
PointCacheFormat require_point_cache_format(const std::filesystem::path& path);

/// The extensions, as messages list them: ".pc2, .mdd, .npy".
std::string point_cache_extensions();

}  // namespace pliant
