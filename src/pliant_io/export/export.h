#pragma once
// Animations to files that other programs read. docs/exports.md says what each format holds.
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/core/options.h"
#include "pliant_io/export/animation.h"

namespace pliant {

/// What surfaces of a glTF file are shaded by: normals of their own, the mean of the triangles around a vertex, or
/// none, which shows every triangle flat.
enum class Normals { smooth, flat };
constexpr std::array<std::string_view, 2> choice_names(Normals) {
  return {"smooth", "flat"};
}

inline constexpr Real default_gltf_tolerance = 1e-3;

/// What was written.
struct ExportReport {
  std::int64_t frames = 0;     ///< of the animation
  std::int64_t keyframes = 0;  ///< of these, in the file
  Real largest_error = 0;      ///< of the others, in sizes of their body
};

/// A picture, which several bodies may share.
struct SurfaceImage {
  enum class Format { png, jpeg };

  std::string name;             ///< for those who read the file
  Format format = Format::png;  ///< of the bytes
  std::string bytes;            ///< of its file
};

/// What one side of a surface looks like.
struct SurfaceSide {
  std::array<Real, 3> color{};  ///< shares of red, green and blue, 0 to 1 (sRGB)
  /// In place of the color, repeated in both directions, by the texture coordinates of the mesh. Null: the color, as on
  /// a mesh without them.
  std::shared_ptr<const SurfaceImage> image{};
};
/// Whether nothing tells them apart.
bool are_alike(const SurfaceSide& a, const SurfaceSide& b);

/// How a surface throws light back.
struct SurfaceFinish {
  bool is_metal = false;
  Real roughness = 0.8;  ///< 0: a mirror, to 1
};

struct SurfaceLook {
  SurfaceSide front;                      ///< of the side that normals point from
  SurfaceSide back;                       ///< of the other
  std::optional<SurfaceFinish> finish{};  ///< none: dull in glTF, the reader's in USD
};

/// Numbers of all vertices.
struct VertexValues {
  std::string name;
  Index components = 1;
  std::vector<float> numbers;  ///< those of a vertex beside each other
};

struct ExportOptions {
  /// How far linear interpolation between keyframes may be off, in sizes of the body (keyframes.h). 0 keeps all frames
  /// that are not exactly between others. Default: default_gltf_tolerance for glTF, all frames for USD; the other
  /// formats take none.
  std::optional<Real> tolerance = {};
  /// Of glTF, ≥ 2: each but the first is a morph target, and all of them have a weight at each. 256 layers of a texture
  /// are what every browser has for them.
  std::int64_t max_keyframes = 256;
  Normals normals = Normals::smooth;  ///< of glTF
  /// Of glTF and USD, of the first bodies in turn; where the two sides differ, each has triangles of its own in glTF,
  /// and USD has the front's. None: in glTF a muted color for each body, in USD the reader's.
  std::vector<std::optional<SurfaceLook>> looks = {};
  /// Of glTF and USD, by the names of colliders, of which the front counts. Others are a dull gray blue.
  std::map<std::string, SurfaceLook, std::less<>> collider_looks = {};
  /// Of pvd: what vertices have beside positions in a frame, given by its index. Called for one frame after the other.
  /// Default: nothing.
  std::function<std::vector<VertexValues>(std::size_t frame)> values = {};
  /// Called before a file with fewer frames than the animation is written; when it throws, none is. Default: not
  /// called.
  std::function<void(const ExportReport&)> before_thinning = {};
};

/// Writes all bodies and all frames, whole or not at all (atomic_file.h), in the format of the extension. The first
/// frame is at 0 s, of pvd at its own time.
/// @throws Error (input): an extension that is not known, options out of range or not for this format, what the format
///   cannot hold.
/// @throws Error (output): the file cannot be written.
ExportReport export_animation(const std::filesystem::path& path, const Animation& animation,
                              const ExportOptions& options = {});

/// Writes a mesh file for each frame. `pattern` is a path whose file name has one run of '#': these are the digits of
/// the frame's number, from 0, with zeros in front. The files are whole, each by itself. Returns how many there are.
/// @throws Error (input): no such pattern, and as write_mesh does.
std::int64_t export_sequence(const std::filesystem::path& pattern, const Animation& animation);

/// Writes a mesh file of the animation's only frame.
/// @throws Error (input): more frames than one, and as write_mesh does.
void export_frame(const std::filesystem::path& path, const Animation& animation);

}  // namespace pliant
