#pragma once
// The list of formats that animations are written in. A new one is a writer, declared in detail/export_formats.h, and
// an entry in animation_format.cpp: messages, commands and tests follow from the list.
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/export/export.h"

namespace pliant {

/// A file format of animations.
struct AnimationFormat {
  std::string_view name;  ///< also the extension, in small letters without the point
  enum class Needs { points, faces } needs;

  /// Whether frames may be left out because programs interpolate: never; where a tolerance is asked for; or always,
  /// with `default_gltf_tolerance` and at most `max_keyframes`.
  enum class Thins { never, when_asked, always } thins;

  /// What it holds beside the bodies: rigid surfaces of their own, or numbers of vertices.
  enum class Beside { nothing, colliders, values } beside;

  /// Writes these frames, given by their indices, whole or not at all. @throws Error (output), and Error (input) for
  /// what the format cannot hold.
  void (*write)(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
                const ExportOptions& options);

  /// Of a format of several files, the folder of all but the first, which is replaced as a whole; else null.
  std::filesystem::path (*folder)(const std::filesystem::path& path) = nullptr;
};

/// All of them, in the order in which messages name them: glTF as text or binary, triangles with morph targets; USD as
/// text; ParaView's collection of frames; point caches; NumPy's array.
std::span<const AnimationFormat> animation_formats();

/// The format that the extension stands for, in capitals or not; none when it stands for no known one.
std::optional<AnimationFormat> animation_format(const std::filesystem::path& path);

/// The extensions, as messages list them: "gltf, glb, usda".
std::string animation_extensions();

}  // namespace pliant
