#pragma once
// Point caches: the positions of a mesh's vertices at many times, as animation programs exchange them.
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

struct PointCacheFormat;  // point_cache_format.h

struct PointCacheOptions {
  Real frames_per_second = 24;  ///< what a frame of a PC2 or NPY file lasts, > 0; an MDD file has its own times
};

/// @throws Error (input): frames per second that are not finite and above 0
void check_frame_rate(const PointCacheOptions& options);

/// The frames of a file; it is kept as it was read, so that it takes the file's size in memory.
class PointCache {
 public:
  /// How a number is stored.
  enum class Scalar { float32, float32_big_endian, float64 };

  /// Where the numbers of a file are: frames × m × 3 from a byte on.
  struct Layout {
    std::size_t first_byte;
    Scalar scalar;
    Index vertex_count;
  };

  /// For the readers of formats: bytes that hold all frames so, with their times [s]. parse() checks the numbers.
  PointCache(std::string bytes, const Layout& layout, std::vector<Real> times);

  /// Reads a file, its format told by its extension (.pc2, .mdd or .npy).
  /// @throws Error (input) `file: place: what; remedy`: not a regular readable file, another extension, counts that do
  ///   not fit the size, no frames or no vertices, a position or a time that is not finite, times that do not rise.
  static PointCache read(const std::filesystem::path& path, const PointCacheOptions& options = {});

  /// The same for bytes. `name` is what messages call them.
  static PointCache parse(std::string bytes, std::string_view name, const PointCacheFormat& format,
                          const PointCacheOptions& options = {});

  /// Frames that are there already, m × 3 each, with their times [s].
  static PointCache from_frames(std::span<const Positions> frames, std::vector<Real> times);

  Index vertex_count() const { return layout_.vertex_count; }
  std::int64_t frame_count() const { return static_cast<std::int64_t>(times_.size()); }

  /// When a frame is [s]. PC2: (start frame + frame · sample rate) / frames per second; NPY: frame / frames per
  /// second.
  Real time(std::int64_t frame) const { return times_[static_cast<std::size_t>(frame)]; }

  /// Gives the frames other times [s], finite and rising. Frames past the last time are dropped; there is at least one
  /// time, and not more than frames. @throws Error (input)
  void set_times(std::vector<Real> times);

  /// A vertex of a frame, as the file has it.
  Vec3 position(std::int64_t frame, Index vertex) const;

  /// All vertices of a frame, m × 3; resizes `positions` where that is needed.
  void frame(std::int64_t frame, Positions& positions) const;

  /// All vertices at a time [s], linear between the frames around it; before the first frame and after the last one,
  /// these.
  void sample(Real time, Positions& positions) const;

 private:
  Real number(std::size_t i) const;
  void check_numbers(std::string_view name) const;

  std::string bytes_;
  Layout layout_;
  std::vector<Real> times_;
};

}  // namespace pliant
