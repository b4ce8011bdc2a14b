#pragma once
// A scene for a mesh that comes without one: it is simulated as what it most likely is.
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/scene/scene.h"

namespace pliant {

/// Reads a mesh and writes a scene around it, with gravity and
/// - tetrahedra: a soft solid,
/// - a closed surface: a stiff skin; both stand on their lowest vertices, which are pinned,
/// - an open surface: cloth that hangs by its highest vertices, or by its corners where it lies flat,
/// - edges: ropes, likewise.
/// A mesh that is longer than 5 m or shorter than 0.2 m is taken as 1 m long, unless `import.scale` is given, that is,
/// not 1. The scene's `description` says what was made of it, its source is the text of a scene file that may stand
/// beside the mesh, and checkpoints hold it as they hold any other.
/// @throws Error (input) as read_mesh and parse_scene do; a file name that is not UTF-8
Scene make_mesh_scene(const std::filesystem::path& file, const ImportOptions& import,
                      const SceneOverrides& overrides = {});

}  // namespace pliant
