#pragma once
// One reader a format, behind read_mesh. Each returns the mesh as the file has it, before it is scaled and turned.
#include "pliant/mesh/io/detail/byte_source.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

Mesh read_obj(const ByteSource& source);
Mesh read_ply(const ByteSource& source);
Mesh read_off(const ByteSource& source);
Mesh read_stl(const ByteSource& source);

}  // namespace pliant
