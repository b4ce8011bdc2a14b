#pragma once
// OFF in and out, behind read_mesh and write_mesh in mesh_file.h.
#include <filesystem>

#include "pliant/mesh/mesh.h"

namespace pliant {

class ByteSource;

/// As MeshFormat::read.
Mesh read_off(const ByteSource& source);

/// Writes the mesh as write_mesh does (mesh_file.h). Kept: polygons, edges (as faces of two corners), colors of
/// vertices (COFF), texture coordinates where every corner has those of its vertex (STOFF). Lost: groups, materials and
/// other maps.
void write_off(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions);

}  // namespace pliant
