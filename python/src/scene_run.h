#pragma once
// A scene that Python holds, and its run to files.
#include "handle.h"
#include "pliant_io/scene/scene.h"

namespace pliant_python {

/// A file, the name of a built-in scene, or a mesh by itself. Throws Error(input) as the readers do.
pliant::Scene open_scene(const std::string& name, const pliant::SceneOverrides& overrides);

/// Takes so many steps, and records them in a folder as `pliant run` does; an empty one: records nothing.
/// @throws Error; what was recorded before is whole then, and run.json says how it ended.
void run_scene(pliant::Scene& scene, const std::filesystem::path& folder, std::int64_t steps);

}  // namespace pliant_python
