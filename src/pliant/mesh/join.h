#pragma once
// Several meshes as one body: planks and ropes, a mat and its springs.
#include <optional>
#include <span>
#include <string>

#include "pliant/mesh/mesh.h"

namespace pliant {

struct MeshPart {
  std::string name;  ///< of its vertices and faces in the whole; several parts may share one; "": none
  Mesh mesh;
};

/// Vertices, elements, texture coordinates and groups of all parts, in turn. A name becomes a vertex group and, where
/// the part has a surface, a face group. Mesh::faces of the whole are every part's: its polygons, or else its triangles
/// and the surface of its tetrahedra. A vertex map is 0 where a part has none of its name.
///
/// With `weld` [m], ≥ 0, a vertex is merged with the nearest vertex of the parts before its own that is within that
/// distance, and takes its index and place; of several vertices of one part only the nearest is, so that the vertices
/// of a part stay apart and no element collapses by that alone. Throws Error(input) on a weld out of range, an index
/// out of range, and more than max_shape_vertices vertices.
Mesh join(std::span<const MeshPart> parts, std::optional<Real> weld = std::nullopt);

}  // namespace pliant
