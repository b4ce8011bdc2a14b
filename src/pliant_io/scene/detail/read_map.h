#pragma once
// One number for each vertex of a body.
#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// The map that {"name": ...} of the mesh, or {"file": ...} gives. Throws Error(input) on a name that the mesh does not
/// have, and on a file with other than one number for each vertex.
std::vector<Real> read_map(const Node& node, const Mesh& mesh);

/// {"map": ..., "from": a, "to": b}: the numbers of the map, which go from 0 to 1, taken to those from a to b; as they
/// are without both.
std::vector<Real> read_mapped_values(const Node& node, const Mesh& mesh);

/// Refuses values out of the range of an option; `node` is where the map is given.
void check_mapped_range(const Node& node, const std::vector<Real>& values, const OptionInfo& info);

}  // namespace pliant
