#pragma once
// Raw triangles in and out, nine numbers a line, behind read_mesh and write_mesh in mesh_file.h.
#include <filesystem>

#include "pliant/mesh/mesh.h"

namespace pliant {

class ByteSource;

/// As MeshFormat::read; every triangle has corners of its own.
Mesh read_raw(const ByteSource& source);

/// Writes the mesh as write_mesh does (mesh_file.h). Lost: all but the corners of the triangles.
void write_raw(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions);

}  // namespace pliant
