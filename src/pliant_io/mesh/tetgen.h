#pragma once
// TetGen's pair of files in, behind read_mesh in mesh_file.h.
#include "pliant/mesh/mesh.h"

namespace pliant {

class ByteSource;

/// Points and tetrahedra from one source, one after the other. @throws Error (input) with the line
Mesh read_tetgen(const ByteSource& points_and_tetrahedra);
/// The same from two files. @throws Error (input) with the file and its line
Mesh read_tetgen_pair(const ByteSource& points, const ByteSource& tetrahedra);

}  // namespace pliant
