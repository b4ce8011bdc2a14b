#pragma once
// PLY in and out, behind read_mesh and write_mesh in mesh_file.h.
#include <filesystem>

#include "pliant/mesh/mesh.h"

namespace pliant {

class ByteSource;

/// As MeshFormat::read.
Mesh read_ply(const ByteSource& source);

/// How the numbers of a PLY file are written: eight bytes each, the least significant first, or their shortest digits.
/// Both read back to the same bits.
enum class PlyNumbers { binary, ascii };

/// Writes the mesh as write_mesh does (mesh_file.h). Kept: polygons, edges, per-vertex maps, texture coordinates (`s t`
/// of vertices where every corner has those of its vertex, else `texcoord` of faces). Colors that are whole numbers up
/// to 255 are written as bytes. Lost: groups and materials.
void write_ply(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions,
               PlyNumbers numbers = PlyNumbers::binary);

}  // namespace pliant
