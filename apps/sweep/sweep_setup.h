#pragma once
// What a sweep is asked for, and what all its runs have in common.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pliant_io/scene/scene.h"
#include "sweep/variation.h"

namespace pliant_sweep {

struct SweepOptions {
  std::string scene;                  ///< as `pliant run` takes it
  std::vector<Variation> variations;  ///< what differs from run to run
  pliant::SceneOverrides overrides;   ///< of all runs, but for `threads`, which no result depends on
  std::vector<std::pair<std::string, std::string>> import = {};  ///< of a mesh: {"--scale", "0.001"}
};

/// Reads the scene of a sweep with these values over its own.
using OpenScene = std::function<pliant::Scene(const pliant::SceneOverrides&)>;

/// A text that a scene consists of. `file` is empty for a built-in scene.
struct TextStamp {
  std::filesystem::path file;
  std::uint32_t crc32 = 0;
};

/// What has to be the same if runs are to be compared, and the variations.
struct SweepSetup {
  std::string scene;                                         ///< as given
  std::vector<TextStamp> texts;                              ///< the scene file and what it includes, as read
  std::map<std::string, std::uint32_t> files;                ///< meshes and maps, CRC-32 by path
  std::vector<std::string> set;                              ///< overrides of all runs: "path=value"
  std::vector<std::pair<std::string, std::string>> options;  ///< of `pliant run`: {"--steps", "100"}
  std::vector<Variation> variations;                         ///< what differs from run to run
};

/// Reads the scene once with each value, the other variations having their first one, so that a slip is known before
/// anything runs. Reads on only while `goes_on` says so.
/// @throws pliant::Error (input): a path or value that the scene refuses, one that an option of all runs or a `set` has
///   as well, also under another name of the same place; (interrupted)
SweepSetup check_sweep(
    const SweepOptions& options, const OpenScene& open_scene,
    const std::function<bool()>& goes_on = [] { return true; });

/// @throws pliant::Error (input) when a text of the scene, a mesh or a map is no longer what it was
void check_unchanged(const SweepSetup& setup);

/// The words behind `pliant` that make one of the runs. threads < 0: as the scene has it.
std::vector<std::string> run_arguments(const SweepSetup& setup, const Combination& values,
                                       const std::filesystem::path& folder, std::int64_t threads);

/// Whether the threads of a run are among what is varied.
bool varies_threads(const std::vector<Variation>& variations);

}  // namespace pliant_sweep
