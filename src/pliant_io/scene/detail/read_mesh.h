#pragma once
#include "pliant/mesh/mass.h"
#include "pliant/mesh/mesh.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// A body's mesh: {"file": ...}, {"shape": ..., options} or {"vertices": ..., "triangles": ...}.
Mesh read_mesh(const Node& node);

/// Scales, then turns, then moves.
void apply_transform(const Node& node, Positions& positions);

/// One of the ways to say a mass; the keys are the names of class Mass. `mesh` is what maps refer to.
Mass read_mass(const Node& node, const Mesh& mesh);

}  // namespace pliant
