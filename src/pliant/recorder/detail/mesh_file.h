#pragma once
// The place to switch to mesh/io/mesh_file.h.
#include "pliant/core/error.h"
#include "pliant/mesh/io/obj.h"

namespace pliant {

inline Mesh read_mesh(const std::filesystem::path& path) {
  return read_obj(path);
}

inline void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  if (path.extension() != ".obj") fail_input(path.string() + ": only OBJ files can be written; give a name in .obj");
  write_obj(path, mesh, positions);
}

}  // namespace pliant
