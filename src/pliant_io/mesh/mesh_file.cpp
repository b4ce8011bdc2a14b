#include "pliant_io/mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/error.h"
#include "pliant_io/mesh/detail/readers.h"
#include "pliant_io/mesh/gmsh.h"
#include "pliant_io/mesh/obj.h"
#include "pliant_io/mesh/off.h"
#include "pliant_io/mesh/ply.h"
#include "pliant_io/mesh/stl.h"

namespace pliant {

namespace {

constexpr std::array<std::pair<std::string_view, MeshFormat>, 7> extensions{{
    {".obj", MeshFormat::obj},
    {".ply", MeshFormat::ply},
    {".off", MeshFormat::off},
    {".stl", MeshFormat::stl},
    {".msh", MeshFormat::gmsh},
    {".node", MeshFormat::tetgen},
    {".ele", MeshFormat::tetgen},
}};

bool is_writable(MeshFormat format) {
  return format != MeshFormat::tetgen;
}

std::vector<std::string_view> extensions_where(bool (*holds)(MeshFormat)) {
  std::vector<std::string_view> found;
  for (const auto& [extension, format] : extensions) {
    if (holds(format)) found.push_back(extension.substr(1));
  }
  return found;
}

Mesh read(const ByteSource& source, MeshFormat format) {
  switch (format) {
    case MeshFormat::obj:
      return read_obj(source);
    case MeshFormat::ply:
      return read_ply(source);
    case MeshFormat::off:
      return read_off(source);
    case MeshFormat::stl:
      return read_stl(source);
    case MeshFormat::gmsh:
      return read_gmsh(source);
    case MeshFormat::tetgen:
      return read_tetgen(source);
  }
  source.fail("a format that has no reader; see mesh_file.h");
}

/// Scales, then turns the file's up axis to +z. Differences from 0 keep zeros positive.
void place(Mesh& mesh, const ImportOptions& options, std::string_view name) {
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 x = options.scale * row(mesh.vertices, v);
    if (!x.allFinite()) {
      fail_input(
          fmt::format("{}: vertex {} is not finite once scaled by {}; give a smaller scale", name, v, options.scale));
    }
    switch (options.up) {
      case UpAxis::z:
        mesh.vertices.row(v) = x.transpose();
        break;
      case UpAxis::y:
        mesh.vertices.row(v) << x[0], 0 - x[2], x[1];
        break;
      case UpAxis::x:
        mesh.vertices.row(v) << 0 - x[2], x[1], x[0];
        break;
    }
  }
}

/// The points and the elements, whichever of the two files is named; as it is written, in capitals or not.
std::vector<std::filesystem::path> tetgen_files(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  const bool is_points = extension.size() == std::string_view(".node").size();
  std::string other = is_points ? ".ele" : ".node";
  if (extension[1] < 'a') {
    for (char& c : other) c = c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  const std::filesystem::path second = std::filesystem::path(path).replace_extension(other);
  return is_points ? std::vector{path, second} : std::vector{second, path};
}

Mesh read_files(const std::vector<std::filesystem::path>& files, MeshFormat format) {
  if (format != MeshFormat::tetgen) return read(ByteSource(files[0]), format);
  return read_tetgen(ByteSource(files[0]), ByteSource(files[1]));
}

}  // namespace

MeshFormat require_mesh_format(const std::filesystem::path& path) {
  if (const auto format = mesh_format(path)) return *format;
  fail_input(fmt::format("{}: not the extension of a known mesh format; known: .{}", path.string(),
                         fmt::join(readable_mesh_extensions(), ", .")));
}

std::optional<MeshFormat> mesh_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  const auto* entry = std::ranges::find(extensions, extension, &decltype(extensions)::value_type::first);
  return entry == extensions.end() ? std::nullopt : std::optional(entry->second);
}

std::vector<std::string_view> readable_mesh_extensions() {
  return extensions_where([](MeshFormat) { return true; });
}

std::vector<std::string_view> writable_mesh_extensions() {
  return extensions_where(is_writable);
}

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path) {
  return require_mesh_format(path) == MeshFormat::tetgen ? tetgen_files(path) : std::vector{path};
}

Mesh parse_mesh(std::string_view bytes, std::string_view name, MeshFormat format, const ImportOptions& options) {
  check_options(name, options);
  Mesh mesh = read(ByteSource(bytes, name), format);
  place(mesh, options, name);
  return mesh;
}

Mesh read_mesh(const std::filesystem::path& path, const ImportOptions& options) {
  const std::string name = path.string();
  check_options(name, options);
  Mesh mesh = read_files(mesh_files(path), require_mesh_format(path));
  place(mesh, options, name);
  return mesh;
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  switch (require_mesh_format(path)) {
    case MeshFormat::obj:
      return write_obj(path, mesh, positions);
    case MeshFormat::ply:
      return write_ply(path, mesh, positions);
    case MeshFormat::off:
      return write_off(path, mesh, positions);
    case MeshFormat::stl:
      return write_stl(path, mesh, positions);
    case MeshFormat::gmsh:
      return write_gmsh(path, mesh, positions);
    case MeshFormat::tetgen:
      fail_input(fmt::format("{}: TetGen's files are not written; write .msh", path.string()));
  }
}

}  // namespace pliant
