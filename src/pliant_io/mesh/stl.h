#pragma once
// STL out; read_mesh in mesh_file.h reads it.
#include <filesystem>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// Writes the triangles as write_mesh does (mesh_file.h), in binary STL: three points each, in single precision. Lost:
/// everything else, vertices without a triangle as well.
/// @throws Error (input): a mesh without triangles; a position past what single precision holds.
void write_stl(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions);

}  // namespace pliant
