#pragma once
// The writers of animations, one file each. All throw Error (output), and Error (input) for what the format cannot
// hold.
#include <filesystem>

#include "pliant_io/export/export.h"
#include "pliant_io/export/keyframes.h"

namespace pliant {

enum class GltfContainer { text, binary };

/// glTF 2.0: a node and a mesh for each body, y up; keyframe 0 is the mesh, each other one a morph target. The buffer
/// of a text file stands in it.
void write_gltf(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
                GltfContainer container, Normals normals);

/// USD as text: an Xform for each body with a Mesh of its polygons and BasisCurves of its edges.
void write_usda(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames);

/// PC2 or NPY, all frames.
struct ArrayFormat;
void write_array(const std::filesystem::path& path, const Animation& animation, const ArrayFormat& format);

/// MDD, all frames with their times.
void write_mdd(const std::filesystem::path& path, const Animation& animation);

/// When the frame is, counted from the animation's first frame [s].
inline Real time_from_start(const Animation& animation, std::size_t frame) {
  return animation.times[frame] - animation.times.front();
}

/// The same in single precision, for frames whose times must rise there. @throws Error (input): they do not.
std::vector<float> single_precision_times(const Animation& animation, const std::vector<std::size_t>& frames);

}  // namespace pliant
