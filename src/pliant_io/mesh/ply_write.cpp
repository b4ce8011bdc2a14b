#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "pliant_io/files/atomic_file.h"
#include "pliant_io/mesh/detail/colors.h"
#include "pliant_io/mesh/detail/mesh_output.h"
#include "pliant_io/mesh/ply.h"

namespace pliant {

namespace {

/// Names that a reader takes for something else than a map.
constexpr std::array<std::string_view, 14> reserved_names = {
    "x", "y", "z", "nx", "ny", "nz", "s", "t", "u", "v", "texture_u", "texture_v", "texture_s", "texture_t"};

/// Names of one word, none twice and none reserved.
std::vector<std::string> property_names(const std::vector<VertexMap>& maps) {
  std::vector<std::string> names;
  for (const VertexMap& map : maps) {
    std::string name = map.name.empty() ? "_" : map.name;
    std::ranges::replace_if(
        name, [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == '\x7f'; }, '_');
    const auto is_taken = [&] {
      return std::ranges::find(reserved_names, name) != reserved_names.end() ||
             std::ranges::find(names, name) != names.end();
    };
    while (is_taken()) name += '_';
    names.push_back(std::move(name));
  }
  return names;
}

class PlyWriter {
 public:
  PlyWriter(AtomicFile& file, const Mesh& mesh, PlyNumbers numbers)
      : text_(file), mesh_(mesh), numbers_(numbers), faces_(mesh), colors_(mesh) {
    has_texture_by_vertex_ = faces_.has_texture_by_vertex(mesh);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      has_long_faces_ = has_long_faces_ || faces_[f].size() > 255 / (has_texture_by_corner() ? 2 : 1);
    }
    // A map of another length than the mesh's is none of its vertices'.
    for (const VertexMap& map : mesh.maps) {
      if (map.values.size() == static_cast<std::size_t>(mesh.vertex_count())) maps_.push_back(&map);
    }
  }

  void write(const Positions& positions) {
    write_header();
    write_vertices(positions);
    for (std::size_t f = 0; f < faces_.size(); ++f) write_face(f);
    for (const auto& [a, b] : mesh_.edges) {
      add(a);
      add(b);
      end_row();
    }
    text_.flush();
  }

 private:
  bool has_texture_by_corner() const { return faces_.has_texture() && !has_texture_by_vertex_; }

  bool is_byte(const VertexMap& map) const {
    const auto channels = std::span(colors_.channels).first(colors_.count);
    return colors_.are_bytes && std::ranges::find(channels, &map) != channels.end();
  }

  void write_header() {
    static_assert(std::endian::native == std::endian::little);
    text_ << "ply\nformat " << (numbers_ == PlyNumbers::ascii ? "ascii" : "binary_little_endian")
          << " 1.0\ncomment Pliant\nelement vertex " << mesh_.vertex_count() << "\n";
    for (const std::string_view name : {"x", "y", "z"}) text_ << "property double " << name << "\n";
    if (has_texture_by_vertex_) text_ << "property double s\nproperty double t\n";
    const std::vector<std::string> names = property_names(mesh_.maps);
    for (const VertexMap* map : maps_) {
      const std::string& name = names[static_cast<std::size_t>(map - mesh_.maps.data())];
      text_ << "property " << (is_byte(*map) ? "uchar " : "double ") << name << "\n";
    }
    const std::string_view count = has_long_faces_ ? "int" : "uchar";
    if (faces_.size() > 0) {
      text_ << "element face " << faces_.size() << "\nproperty list " << count << " int vertex_indices\n";
      if (has_texture_by_corner()) text_ << "property list " << count << " double texcoord\n";
    }
    if (!mesh_.edges.empty()) {
      text_ << "element edge " << mesh_.edges.size() << "\nproperty int vertex1\nproperty int vertex2\n";
    }
    text_ << "end_header\n";
  }

  void write_vertices(const Positions& positions) {
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
      for (Eigen::Index k = 0; k < 3; ++k) add(positions(v, k));
      for (Eigen::Index k = 0; k < 2 && has_texture_by_vertex_; ++k) add(mesh_.texture_coordinates(v, k));
      for (const VertexMap* map : maps_) {
        const Real value = map->values[static_cast<std::size_t>(v)];
        is_byte(*map) ? add(static_cast<unsigned char>(value)) : add(value);
      }
      end_row();
    }
  }

  void write_face(std::size_t f) {
    const auto corners = faces_[f];
    add_count(corners.size());
    for (const Index vertex : corners) add(vertex);
    if (has_texture_by_corner()) write_textures(f, corners.size());
    end_row();
  }

  /// None where a corner has none.
  void write_textures(std::size_t f, std::size_t corners) {
    const auto rows = std::span(mesh_.faces.texture_coordinates).subspan(faces_.first_corner(f), corners);
    const bool has_all = std::ranges::all_of(rows, [](Index row) { return row >= 0; });
    add_count(has_all ? 2 * corners : 0);
    for (const Index row : has_all ? rows : rows.first(0)) {
      for (Eigen::Index k = 0; k < 2; ++k) add(mesh_.texture_coordinates(row, k));
    }
  }

  void add_count(std::size_t count) {
    has_long_faces_ ? add(static_cast<Index>(count)) : add(static_cast<unsigned char>(count));
  }

  template <typename Number>
  void add(Number number) {
    if (numbers_ == PlyNumbers::binary) {
      text_ << std::string_view(reinterpret_cast<const char*>(&number), sizeof number);
    } else {
      text_ << (is_first_ ? "" : " ");
      if constexpr (std::is_same_v<Number, unsigned char>) {
        text_ << static_cast<int>(number);
      } else {
        text_ << number;
      }
      is_first_ = false;
    }
  }

  void end_row() {
    is_first_ = true;
    numbers_ == PlyNumbers::ascii ? text_.end_line() : text_.flush_when_full();
  }

  TextOutput text_;
  const Mesh& mesh_;
  PlyNumbers numbers_;
  VisibleFaces faces_;
  ColorMaps colors_;
  std::vector<const VertexMap*> maps_;
  bool has_texture_by_vertex_ = false;
  bool has_long_faces_ = false;
  bool is_first_ = true;  ///< number of a row
};

}  // namespace

void write_ply(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions, PlyNumbers numbers) {
  check_positions(path, mesh, positions);
  AtomicFile file(path);
  PlyWriter(file, mesh, numbers).write(positions);
  file.commit();
}

}  // namespace pliant
