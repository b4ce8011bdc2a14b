#pragma once
// STL in and out, behind read_mesh and write_mesh in mesh_file.h.
#include <filesystem>

#include "pliant/mesh/mesh.h"

namespace pliant {

class ByteSource;

/// As MeshFormat::read.
Mesh read_stl(const ByteSource& source);

/// Writes the triangles as write_mesh does (mesh_file.h), in binary STL: three points each, in single precision. Lost:
/// everything else, vertices without a triangle as well.
/// @throws Error (input): a mesh without triangles; a position past what single precision holds.
void write_stl(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions);

}  // namespace pliant
