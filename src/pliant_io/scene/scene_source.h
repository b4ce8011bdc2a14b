#pragma once
// What a scene is read from: texts, and values that take the place of some of theirs.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pliant/core/options.h"
#include "pliant/solver/settings.h"

namespace pliant {

/// What the frames of a run are written as: one array, one point cache, one mesh file each, or nothing.
enum class FrameFormat { npy, pc2, obj, ply, none };
constexpr std::array<std::string_view, 5> choice_names(FrameFormat) {
  return {"npy", "pc2", "obj", "ply", "none"};
}

/// Values that take the place of the scene's own.
struct SceneOverrides {
  std::optional<std::int64_t> steps = {};
  std::optional<Real> time_step = {};  ///< [s]; moves keep their times, or their steps where those are given
  std::optional<Index> iterations = {};
  std::optional<Real> tolerance = {};  ///< [N]
  std::optional<Index> threads = {};
  std::optional<Backend> backend = {};
  std::optional<FrameFormat> format = {};
  std::optional<std::int64_t> every = {};
  /// "PATH=VALUE" each, in turn, before the others: `bodies[sheet].constraints[bend].stiffness=2e-3`. Entries of lists
  /// go by index or by name; the value is JSON, or a text where it is none. Paths of files start at the current folder.
  std::vector<std::string> set = {};
};

/// One text of a scene.
struct SceneText {
  std::string name;              ///< what messages call it: its path, or the name of a built-in scene
  std::filesystem::path folder;  ///< where paths in it start; relative ones at the current folder
  std::string text;
  std::filesystem::path file = {};  ///< absolute; none: it was not read from a file
};

/// All that is needed to read a scene again, but for the files of its meshes and maps.
struct SceneSource {
  std::vector<SceneText> texts;  ///< the scene's own, then those that it includes
  bool is_complete = false;      ///< all texts that are included are there: no file of another is read
  SceneOverrides overrides;
  std::filesystem::path overrides_folder;  ///< where paths in `overrides.set` start
  /// Events that cannot act, since what they act on is not there, are left out instead of refused: see Scene::left_out.
  bool leaves_out_events = false;
};

/// A file that a scene was read from besides its texts.
struct SceneFile {
  std::string path;
  std::uint64_t size = 0;  ///< [bytes]
  std::uint32_t crc32 = 0;
};

}  // namespace pliant
