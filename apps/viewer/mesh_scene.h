#pragma once
// A scene for a mesh that comes without one: it is simulated as what it most likely is.
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/scene/scene.h"

namespace pliant_viewer {

/// Reads a mesh and makes a scene of it with gravity and
/// - tetrahedra: a soft solid,
/// - a closed surface: a stiff skin; both stand on their lowest vertices, which are pinned,
/// - an open surface: cloth that hangs by its highest vertices, or by its corners where it lies flat,
/// - edges: ropes, likewise.
/// Whatever is longer than 5 m or shorter than 0.2 m is shown 1 m long, unless `import.scale` is given, that is, not 1;
/// `description` says what was made of it. @throws pliant::Error (input) as read_mesh and Simulation::add_body do.
pliant::Scene make_mesh_scene(const std::filesystem::path& file, const pliant::ImportOptions& import);

}  // namespace pliant_viewer
