#pragma once
// Files that hold all frames: a header that counts them, then frame after frame of the same size.
#include <string>
#include <string_view>

#include "pliant/core/types.h"

namespace pliant {

struct ArrayFormat {
  std::string_view name;
  /// The header, of the same size whatever the counts, so that it can be replaced in place.
  std::string (*header)(std::int64_t frame_count, Index vertex_count);
  /// Appends the bytes of a frame. @throws Error (input): a position that the format cannot hold.
  void (*append)(std::string& bytes, const Positions& positions);
};

/// NumPy's array file, version 1.0 (numpy.lib.format): magic bytes, a Python dictionary padded to a multiple of 64
/// bytes, then float64.
extern const ArrayFormat npy_format;

/// The point cache of 3ds Max, Blender and Houdini: 32 bytes of header, then float32. Start frame 0, sample rate 1: a
/// frame of the cache is a frame of the animation, the one thing that all its readers agree on.
extern const ArrayFormat pc2_format;

/// The position in single precision. @throws Error (input) naming the vertex: out of its range.
Eigen::Vector3f single_precision(const Positions& positions, Index vertex);

}  // namespace pliant
