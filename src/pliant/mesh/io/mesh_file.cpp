#include "pliant/mesh/io/mesh_file.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/error.h"
#include "pliant/mesh/io/detail/readers.h"
#include "pliant/mesh/io/obj.h"
#include "pliant/mesh/io/off.h"
#include "pliant/mesh/io/ply.h"
#include "pliant/mesh/io/stl.h"

namespace pliant {

namespace {

constexpr auto format_names = choice_names(MeshFormat{});

MeshFormat known_format(const std::filesystem::path& path) {
  if (const auto format = mesh_format(path)) return *format;
  fail_input(fmt::format("{}: not the extension of a known mesh format; known: .{}", path.string(),
                         fmt::join(format_names, ", .")));
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

Mesh read_and_place(const ByteSource& source, MeshFormat format, const ImportOptions& options) {
  check_options(source.name(), options);
  Mesh mesh = read(source, format);
  place(mesh, options, source.name());
  return mesh;
}

}  // namespace

std::optional<MeshFormat> mesh_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  for (std::size_t i = 0; i < format_names.size(); ++i) {
    if (extension.size() == format_names[i].size() + 1 && extension.ends_with(format_names[i])) {
      return static_cast<MeshFormat>(i);
    }
  }
  return std::nullopt;
}

Mesh parse_mesh(std::string_view bytes, std::string_view name, MeshFormat format, const ImportOptions& options) {
  return read_and_place(ByteSource(bytes, name), format, options);
}

Mesh read_mesh(const std::filesystem::path& path, const ImportOptions& options) {
  const MeshFormat format = known_format(path);
  return read_and_place(ByteSource(path), format, options);
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  switch (known_format(path)) {
    case MeshFormat::obj:
      return write_obj(path, mesh, positions);
    case MeshFormat::ply:
      return write_ply(path, mesh, positions);
    case MeshFormat::off:
      return write_off(path, mesh, positions);
    case MeshFormat::stl:
      return write_stl(path, mesh, positions);
  }
}

}  // namespace pliant
