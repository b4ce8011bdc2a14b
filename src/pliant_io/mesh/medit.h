#pragma once
// MEDIT's .mesh as text in and out, behind read_mesh and write_mesh in mesh_file.h.
#include <filesystem>

#include "pliant/mesh/mesh.h"

namespace pliant {

class ByteSource;

/// Reads vertices, edges, triangles, quadrilaterals and tetrahedra; of different dimensions the highest, the others
/// being borders. Indices count from 1. A reference other than 0 makes a group: `faces 3` of faces, `vertices 3`,
/// `edges 3` and `tetrahedra 3` of vertices; faces that are borders make groups of their vertices too. Other sections
/// are passed over, but for elements without which the mesh would be another.
/// @throws Error (input) with the line: a binary or malformed file, one without its End, hexahedra, prisms or pyramids.
Mesh read_medit(const ByteSource& source);

/// Writes the mesh as write_mesh does (mesh_file.h), of version 2, with its tetrahedra; without any, its triangles and
/// quadrilaterals (triangles from larger polygons); without those, its edges. Faces and vertices have the reference of
/// the first group that they are in: the number in its name, if that is as read_medit makes it, else one that no other
/// has. Lost: everything else.
void write_medit(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions);

}  // namespace pliant
