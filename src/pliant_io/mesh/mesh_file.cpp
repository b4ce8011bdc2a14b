#include "pliant_io/mesh/mesh_file.h"

#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/error.h"
#include "pliant/mesh/loose.h"
#include "pliant_io/files/detail/byte_source.h"

namespace pliant {

namespace {

/// The two files of a format of pairs, whichever is named; as that one is written, in capitals or not.
std::vector<std::filesystem::path> pair_of(const std::filesystem::path& path, const MeshFormat& format) {
  const std::string extension = path.extension().string();
  const bool is_first = extension.size() == format.extensions[0].size() + 1;
  std::string other = fmt::format(".{}", format.extensions[is_first ? 1 : 0]);
  if (extension[1] < 'a') {
    for (char& c : other) c = c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  const std::filesystem::path second = std::filesystem::path(path).replace_extension(other);
  return is_first ? std::vector{path, second} : std::vector{second, path};
}

Mesh read_files(const std::vector<std::filesystem::path>& files, const MeshFormat& format) {
  if (files.size() == 1) return format.read(ByteSource(files[0]));
  return format.read_pair(ByteSource(files[0]), ByteSource(files[1]));
}

}  // namespace

/// Differences from 0 keep zeros positive.
void import_positions(Positions& positions, const ImportOptions& options, std::string_view name) {
  check_options(name, options);
  for (Index v = 0; v < static_cast<Index>(positions.rows()); ++v) {
    const Vec3 x = options.scale * row(positions, v);
    if (!x.allFinite()) {
      fail_input(
          fmt::format("{}: vertex {} is not finite once scaled by {}; give a smaller scale", name, v, options.scale));
    }
    switch (options.up) {
      case UpAxis::z:
        positions.row(v) = x.transpose();
        break;
      case UpAxis::y:
        positions.row(v) << x[0], 0 - x[2], x[1];
        break;
      case UpAxis::x:
        positions.row(v) << 0 - x[2], x[1], x[0];
        break;
    }
  }
}

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path) {
  const MeshFormat format = require_mesh_format(path);
  return format.read_pair != nullptr ? pair_of(path, format) : std::vector{path};
}

Mesh parse_mesh(std::string_view bytes, std::string_view name, const MeshFormat& format, const ImportOptions& options) {
  check_options(name, options);
  Mesh mesh = format.read(ByteSource(bytes, name));
  import_positions(mesh.vertices, options, name);
  if (options.drop_loose) drop_loose_vertices(mesh);
  return mesh;
}

Mesh read_mesh(const std::filesystem::path& path, const ImportOptions& options) {
  const std::string name = path.string();
  check_options(name, options);
  Mesh mesh = read_files(mesh_files(path), require_mesh_format(path));
  import_positions(mesh.vertices, options, name);
  if (options.drop_loose) drop_loose_vertices(mesh);
  return mesh;
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  const MeshFormat format = require_mesh_format(path);
  if (format.write == nullptr) {
    fail_input(fmt::format("{}: {} files are read, not written; write .{}", path.string(), format.name,
                           fmt::join(writable_mesh_extensions(), ", .")));
  }
  format.write(path, mesh, positions);
}

}  // namespace pliant
