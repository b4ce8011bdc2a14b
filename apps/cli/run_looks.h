#pragma once
// What the bodies and colliders of a run look like, for its exports.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/export/export.h"
#include "pliant_io/scene/scene.h"
#include "pliant_io/scene/scene_source.h"

namespace pliant_cli {

/// Whether a text of the scene, or what was set in it, has that word.
bool mentions(const pliant::SceneSource& source, std::string_view word);

struct RunLooks {
  std::vector<std::optional<pliant::SurfaceLook>> of_bodies;             ///< of the first bodies in turn
  std::map<std::string, pliant::SurfaceLook, std::less<>> of_colliders;  ///< by name
  std::vector<std::filesystem::path> textures;                           ///< the files that were read
};

/// What the scene of a run in `folder` says of the bodies and colliders of an animation, of which there may be fewer;
/// none where it leaves them as they are, or is not known. Bodies with a pattern or a texture get the texture
/// coordinates by which it lies on them. A texture that cannot be read is left out, with a warning. A scene without any
/// appearance is not made again, which may take long.
RunLooks looks_of_run(const std::filesystem::path& folder, pliant::Animation& animation);
/// The same of a scene as it is.
RunLooks looks_of_scene(const pliant::Scene& scene, pliant::Animation& animation);

}  // namespace pliant_cli
