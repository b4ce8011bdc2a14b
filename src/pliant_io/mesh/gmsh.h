#pragma once
// Gmsh's .msh in and out, behind read_mesh and write_mesh in mesh_file.h.
#include <filesystem>

#include "pliant/mesh/mesh.h"

namespace pliant {

class ByteSource;

/// As MeshFormat::read.
Mesh read_gmsh(const ByteSource& source);

/// Writes the mesh as write_mesh does (mesh_file.h), as text of version 2.2, with its tetrahedra; without any, its
/// polygons of up to four corners and its triangles; without those, its edges. Lost: everything else.
void write_gmsh(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions);

}  // namespace pliant
