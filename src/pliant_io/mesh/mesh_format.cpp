#include "pliant_io/mesh/mesh_format.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/error.h"
#include "pliant_io/files/extension.h"
#include "pliant_io/mesh/gmsh.h"
#include "pliant_io/mesh/medit.h"
#include "pliant_io/mesh/obj.h"
#include "pliant_io/mesh/off.h"
#include "pliant_io/mesh/ply.h"
#include "pliant_io/mesh/stl.h"
#include "pliant_io/mesh/tetgen.h"
#include "pliant_io/mesh/vtk.h"

namespace pliant {

namespace {

void write_binary_ply(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  write_ply(path, mesh, positions, PlyNumbers::binary);
}

constexpr MeshFormat formats[] = {
    {"obj", {"obj"}, read_obj, write_obj},
    {"ply", {"ply"}, read_ply, write_binary_ply},
    {"off", {"off"}, read_off, write_off},
    {"stl", {"stl"}, read_stl, write_stl},
    {"gmsh", {"msh"}, read_gmsh, write_gmsh},
    {"medit", {"mesh"}, read_medit, write_medit},
#ifdef PLIANT_HAS_VTU
    {"vtu", {"vtu"}, read_vtu, write_vtu},
#endif
    {"vtk", {"vtk"}, read_vtk},
    {"tetgen", {"node", "ele"}, read_tetgen, nullptr, read_tetgen_pair},
};

std::vector<std::string_view> extensions_where(bool (*holds)(const MeshFormat&)) {
  std::vector<std::string_view> found;
  for (const MeshFormat& format : formats) {
    if (!holds(format)) continue;
    for (const std::string_view extension : format.extensions) {
      if (!extension.empty()) found.push_back(extension);
    }
  }
  return found;
}

}  // namespace

std::span<const MeshFormat> mesh_formats() {
  return formats;
}

std::optional<MeshFormat> mesh_format(const std::filesystem::path& path) {
  const std::string extension = small_extension(path);
  if (extension.empty()) return {};
  for (const MeshFormat& format : formats) {
    if (std::ranges::find(format.extensions, extension) != format.extensions.end()) return format;
  }
  return {};
}

MeshFormat require_mesh_format(const std::filesystem::path& path) {
  if (const auto format = mesh_format(path)) return *format;
  fail_input(fmt::format("{}: not the extension of a known mesh format; known: .{}", path.string(),
                         fmt::join(readable_mesh_extensions(), ", .")));
}

std::vector<std::string_view> readable_mesh_extensions() {
  return extensions_where([](const MeshFormat&) { return true; });
}

std::vector<std::string_view> writable_mesh_extensions() {
  return extensions_where([](const MeshFormat& format) { return format.write != nullptr; });
}

}  // namespace pliant
