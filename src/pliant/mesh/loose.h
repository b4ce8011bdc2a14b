#pragma once
// Vertices that belong to nothing: construction points, centers of arcs, what an export left over.
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// The vertices that no edge, triangle, tetrahedron or polygon has, rising.
std::vector<Index> loose_vertices(const Mesh& mesh);

/// Takes them out; the others keep their order and are numbered anew, as are the groups and maps of vertices. Returns
/// how many there were.
Index drop_loose_vertices(Mesh& mesh);

}  // namespace pliant
