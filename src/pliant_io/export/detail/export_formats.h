#pragma once
// The writers of animations, one file each: AnimationFormat::write.
#include <filesystem>

#include "pliant_io/export/export.h"
#include "pliant_io/export/keyframes.h"

namespace pliant {

using AnimationWriter = void(const std::filesystem::path& path, const Animation& animation,
                             const std::vector<std::size_t>& frames, const ExportOptions& options);

/// glTF 2.0: a node and a mesh for each body, y up; keyframe 0 is the mesh, each other one a morph target. The buffer
/// of the text file stands in it.
AnimationWriter write_gltf;
/// The same as one binary file.
AnimationWriter write_glb;

/// USD as text: an Xform for each body with a Mesh of its polygons and BasisCurves of its edges.
AnimationWriter write_usda;
/// `flag_textures` beside `flag.usda`, where its pictures are, if it has any. It is replaced as a whole.
std::filesystem::path usd_folder(const std::filesystem::path& path);

/// A collection for ParaView: every frame with the body of each vertex and `ExportOptions::values`, at the animation's
/// own times, as a .vtu file in pvd_folder().
AnimationWriter write_pvd;
/// `flag_frames` beside `flag.pvd`. It is replaced as a whole.
std::filesystem::path pvd_folder(const std::filesystem::path& path);

// The others hold all points as one.
AnimationWriter write_pc2;
AnimationWriter write_npy;
/// With the times of the frames.
AnimationWriter write_mdd;

/// When the frame is, counted from the animation's first frame [s].
inline Real time_from_start(const Animation& animation, std::size_t frame) {
  return animation.times[frame] - animation.times.front();
}

/// The same in single precision, for frames whose times must rise there. @throws Error (input): they do not.
std::vector<float> single_precision_times(const Animation& animation, const std::vector<std::size_t>& frames);

}  // namespace pliant
