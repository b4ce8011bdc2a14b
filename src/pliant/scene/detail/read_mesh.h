#pragma once
#include <filesystem>

#include "pliant/mesh/mass.h"
#include "pliant/mesh/mesh.h"
#include "pliant/scene/detail/json_node.h"

namespace pliant {

/// A body's mesh: {"file": ...}, {"shape": ..., options} or {"vertices": ..., "triangles": ...}. Relative paths start
/// at `folder`.
Mesh read_mesh(const Node& node, const std::filesystem::path& folder);

/// Scales, then turns, then moves.
void apply_transform(const Node& node, Positions& positions);

/// One of the ways to say a mass; the keys are the names of class Mass.
Mass read_mass(const Node& node);

}  // namespace pliant
