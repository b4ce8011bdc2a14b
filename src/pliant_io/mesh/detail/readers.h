#pragma once
// One reader a format, behind read_mesh. Each returns the mesh as the file has it, before it is scaled and turned.
#include <cstdint>
#include <string>

#include "pliant/mesh/mesh.h"
#include "pliant_io/files/detail/byte_source.h"

namespace pliant {

Mesh read_obj(const ByteSource& source);
Mesh read_ply(const ByteSource& source);
Mesh read_off(const ByteSource& source);
Mesh read_stl(const ByteSource& source);
Mesh read_gmsh(const ByteSource& source);
/// Points and tetrahedra from one source, one after the other, or from two files.
Mesh read_tetgen(const ByteSource& points_and_tetrahedra);
Mesh read_tetgen(const ByteSource& points, const ByteSource& tetrahedra);

/// Adds a tetrahedron of vertices in range, its last two swapped where its volume would be negative: formats differ in
/// their order. What is wrong with it, as an error message without its place, or nothing; numbers in it count from
/// `first_number`.
std::string add_tetrahedron(Mesh& mesh, Tetrahedron tetrahedron, std::int64_t first_number);

}  // namespace pliant
