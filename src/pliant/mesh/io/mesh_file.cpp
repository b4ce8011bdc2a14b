#include "pliant/mesh/io/mesh_file.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/error.h"
#include "pliant/mesh/io/obj.h"
#include "pliant/mesh/io/read_file.h"

namespace pliant {

namespace {

constexpr auto format_names = choice_names(MeshFormat{});

MeshFormat known_format(const std::filesystem::path& path) {
  if (const auto format = mesh_format(path)) return *format;
  fail_input(fmt::format("{}: not the extension of a known mesh format; known: .{}", path.string(),
                         fmt::join(format_names, ", .")));
}

Mesh parse(std::string_view bytes, std::string_view name, MeshFormat format) {
  switch (format) {
    case MeshFormat::obj:
      return parse_obj(bytes, name);
    case MeshFormat::ply:
    case MeshFormat::off:
    case MeshFormat::stl:
      break;
  }
  fail_input(fmt::format("{}: this format cannot be read yet; convert it to OBJ", name));
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
  check_options(name, options);
  Mesh mesh = parse(bytes, name, format);
  place(mesh, options, name);
  return mesh;
}

Mesh read_mesh(const std::filesystem::path& path, const ImportOptions& options) {
  const MeshFormat format = known_format(path);
  return parse_mesh(read_file(path), path.string(), format, options);
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  if (known_format(path) == MeshFormat::obj) return write_obj(path, mesh, positions);
  fail_input(fmt::format("{}: this format cannot be written yet; write OBJ", path.string()));
}

}  // namespace pliant
