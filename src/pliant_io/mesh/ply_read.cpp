#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/mesh/detail/ply_header.h"
#include "pliant_io/mesh/detail/ply_rows.h"
#include "pliant_io/mesh/detail/polygon_builder.h"
#include "pliant_io/mesh/ply.h"

namespace pliant {

namespace {

constexpr std::array<std::string_view, 3> coordinate_names = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> normal_names = {"nx", "ny", "nz"};
constexpr std::array<std::array<std::string_view, 2>, 4> texture_names{
    {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}};
constexpr std::array<std::string_view, 2> index_names = {"vertex_indices", "vertex_index"};

bool is_index_list(const PlyProperty& property) {
  return property.count_type && std::ranges::find(index_names, property.name) != index_names.end();
}

/// Of each corner of a face. Of floats only: bytes would become sixteen times as large in memory.
bool is_texture_list(const PlyProperty& property) {
  return property.count_type && property.name == "texcoord" && is_float(property.type);
}

template <class Rows>
class PlyReader {
 public:
  PlyReader(const ByteSource& source, const PlyHeader& header)
      : source_(source), header_(header), rows_(source, header), polygons_(mesh_, source.size(), 0) {}

  Mesh read() {
    find_vertices();
    for (const PlyElement& element : header_.elements) {
      rows_.begin_element(element);
      if (element.properties.empty()) continue;
      check_room(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "edge") {
        read_edges(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else {
        read_rows(element, [&](const PlyProperty& property) { rows_.skip(property); });
      }
    }
    rows_.finish();
    return finish();
  }

 private:
  void find_vertices() {
    for (const PlyElement& element : header_.elements) {
      if (element.name != "vertex") continue;
      if (element.count > max_index_count) {
        source_.fail(fmt::format("more than {} vertices; cut the mesh up", max_index_count));
      }
      if (element.properties.empty()) source_.fail("element \"vertex\" has no properties; give x, y and z");
      vertex_count_ = static_cast<Index>(element.count);
    }
    if (vertex_count_ == 0) source_.fail("no vertices; give at least one row of element \"vertex\"");
  }

  /// Before anything is allocated.
  void check_room(const PlyElement& element) const {
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties)
      bytes += byte_count(property.count_type.value_or(property.type));
    const std::uint64_t room = rows_.room(element.properties.size(), bytes);
    if (element.count <= room) return;
    source_.fail(
        fmt::format("the header counts {} rows of element {}, but the file ends after at most {}; it may be "
                    "cut short",
                    element.count, TextLexer::quoted(element.name), room));
  }

  template <class Read>
  void read_rows(const PlyElement& element, const Read& read) {
    for (std::uint64_t row = 0; row < element.count; ++row) {
      rows_.begin_row(row);
      for (const PlyProperty& property : element.properties) read(property);
      rows_.end_row();
    }
  }

  // ---- vertices

  /// Where the numbers of a scalar property go: values[stride * row]; nowhere when there are none.
  struct Column {
    Real* values = nullptr;
    Index stride = 1;
  };

  void read_vertices(const PlyElement& element) {
    mesh_.vertices.resize(vertex_count_, 3);
    const std::vector<Column> columns = vertex_columns(element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      rows_.begin_row(row);
      for (std::size_t p = 0; p < columns.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (columns[p].values == nullptr) {
          rows_.skip(property);
        } else {
          columns[p].values[static_cast<std::size_t>(columns[p].stride) * row] = rows_.take(property.type);
        }
      }
      check_coordinates(row);
      rows_.end_row();
    }
    // What nothing can be computed with is left out rather than the whole mesh refused: it is not its shape.
    std::erase_if(mesh_.maps, [](const VertexMap& map) {
      return !std::ranges::all_of(map.values, [](Real value) { return std::isfinite(value); });
    });
  }

  void check_coordinates(std::uint64_t row) const {
    const auto v = static_cast<Eigen::Index>(row);
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (std::isfinite(mesh_.vertices(v, k))) continue;
      rows_.fail(fmt::format("coordinate {} of vertex {} is not finite; give a number",
                             coordinate_names[static_cast<std::size_t>(k)], row));
    }
    for (Eigen::Index k = 0; k < 2 && has_texture_by_vertex_; ++k) {
      if (!std::isfinite(mesh_.texture_coordinates(v, k))) {
        rows_.fail(fmt::format("a texture coordinate of vertex {} is not finite; give a number", row));
      }
    }
  }

  std::vector<Column> vertex_columns(const PlyElement& element) {
    std::vector<Column> columns(element.properties.size());
    const auto place = [&](std::string_view name, Real* values, Index stride) {
      const auto entry = std::ranges::find_if(element.properties,
                                              [&](const PlyProperty& p) { return p.name == name && !p.count_type; });
      if (entry == element.properties.end()) return false;
      columns[static_cast<std::size_t>(entry - element.properties.begin())] = {values, stride};
      return true;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      if (place(coordinate_names[k], mesh_.vertices.data() + k, 3)) continue;
      source_.fail(fmt::format("element \"vertex\" has no property {}; give x, y and z", coordinate_names[k]));
    }
    place_texture(element, place);
    mesh_.maps.reserve(columns.size());
    for (std::size_t p = 0; p < columns.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      const bool is_normal = std::ranges::find(normal_names, property.name) != normal_names.end();
      if (property.count_type || is_normal || columns[p].values != nullptr) continue;
      mesh_.maps.push_back({property.name, std::vector<Real>(static_cast<std::size_t>(vertex_count_))});
      columns[p].values = mesh_.maps.back().values.data();
    }
    return columns;
  }

  /// A pair of texture coordinates of each vertex, unless each corner of a face has its own.
  template <class Place>
  void place_texture(const PlyElement& element, const Place& place) {
    for (const PlyElement& other : header_.elements) {
      if (other.name == "face" && std::ranges::any_of(other.properties, is_texture_list)) return;
    }
    const auto has = [&](std::string_view name) {
      return std::ranges::any_of(element.properties,
                                 [&](const PlyProperty& p) { return p.name == name && !p.count_type; });
    };
    for (const auto& [first, second] : texture_names) {
      if (!has(first) || !has(second)) continue;
      mesh_.texture_coordinates.resize(vertex_count_, 2);
      place(first, mesh_.texture_coordinates.data(), 2);
      place(second, mesh_.texture_coordinates.data() + 1, 2);
      has_texture_by_vertex_ = true;
      return;
    }
  }

  // ---- faces, edges, strips

  Index take_index(PlyType type) { return check_index(rows_.take(type)); }

  Index check_index(Real index) const {
    if (!(index >= 0 && index < vertex_count_) || index != std::floor(index)) {
      rows_.fail(fmt::format("vertex {} is out of range, since the file has {}; use 0 to {}", index, vertex_count_,
                             vertex_count_ - 1));
    }
    return static_cast<Index>(index);
  }

  /// How long the list is that comes next; no longer than the file can hold.
  std::uint64_t take_count(const PlyProperty& property) {
    const Real count = rows_.take(*property.count_type);
    const std::uint64_t room = rows_.room(1, byte_count(property.type));
    if (!(count >= 0 && count <= static_cast<Real>(room)) || count != std::floor(count)) {
      rows_.fail(fmt::format("a list of {} numbers, but the rest of the file holds at most {}; it may be cut short",
                             count, room));
    }
    return static_cast<std::uint64_t>(count);
  }

  void read_faces(const PlyElement& element) {
    std::vector<Real> textures;  // of the corners of one face
    for (std::uint64_t row = 0; row < element.count; ++row) {
      rows_.begin_row(row);
      textures.clear();
      bool is_face = false;
      for (const PlyProperty& property : element.properties) {
        if (is_index_list(property)) {
          const std::uint64_t corners = take_count(property);
          if (row == 0) reserve_like_first(element, property, corners);
          for (std::uint64_t i = 0; i < corners; ++i) polygons_.add_corner(take_index(property.type));
          is_face = true;
        } else if (is_texture_list(property)) {
          for (std::uint64_t left = take_count(property); left > 0; --left)
            textures.push_back(rows_.take(property.type));
        } else {
          rows_.skip(property);
        }
      }
      if (is_face) finish_face(textures);
      rows_.end_row();
    }
  }

  /// Most files have faces of one size.
  void reserve_like_first(const PlyElement& element, const PlyProperty& property, std::uint64_t corners) {
    const std::uint64_t room = rows_.room(1, byte_count(property.type));
    polygons_.reserve(element.count, std::min(room, element.count * std::min(corners, room / element.count + 1)));
  }

  void finish_face(const std::vector<Real>& textures) {
    const std::size_t corners = polygons_.corners().size();
    if (!textures.empty() && textures.size() != 2 * corners) {
      rows_.fail(fmt::format("{} texture coordinates for {} corners; give two for each", textures.size(), corners));
    }
    if (!std::ranges::all_of(textures, [](Real value) { return std::isfinite(value); })) {
      rows_.fail("a texture coordinate is not finite; give a number");
    }
    if (const std::string message = polygons_.finish_face(); !message.empty()) rows_.fail(message);
    if (textures.empty() && corner_textures_.empty()) return;
    auto& list = mesh_.faces.texture_coordinates;
    list.resize(mesh_.faces.vertices.size() - corners, -1);
    for (std::size_t i = 0; i < corners; ++i) {
      list.push_back(textures.empty() ? -1 : static_cast<Index>(corner_textures_.size() / 2 + i));
    }
    corner_textures_.insert(corner_textures_.end(), textures.begin(), textures.end());
  }

  void read_edges(const PlyElement& element) {
    const auto is_end = [](const PlyProperty& p) {
      return !p.count_type && (p.name == "vertex1" || p.name == "vertex2");
    };
    const auto ends = std::ranges::count_if(element.properties, is_end);
    if (ends == 1) source_.fail("element \"edge\" has one of vertex1 and vertex2; give both");
    if (ends == 2) mesh_.edges.reserve(static_cast<std::size_t>(element.count));
    read_rows(element, [&](const PlyProperty& property) {
      if (!is_end(property)) return rows_.skip(property);
      edge_[property.name == "vertex1" ? 0 : 1] = take_index(property.type);
      if (++edge_ends_ < 2) return;
      edge_ends_ = 0;
      if (edge_[0] == edge_[1]) rows_.fail(fmt::format("an edge from vertex {} to itself; remove it", edge_[0]));
      mesh_.edges.push_back(edge_);
    });
  }

  /// Every vertex makes a triangle with the two before it, turned the other way each time; −1 begins a new strip. A
  /// triangle with a vertex twice only serves to turn the strip around.
  void read_strips(const PlyElement& element) {
    read_rows(element, [&](const PlyProperty& property) {
      if (!is_index_list(property)) return rows_.skip(property);
      std::array<Index, 3> last{};
      std::uint64_t length = 0;
      for (std::uint64_t left = take_count(property); left > 0; --left) {
        const Real index = rows_.take(property.type);
        if (index == -1) {
          length = 0;
          continue;
        }
        last = {last[1], last[2], check_index(index)};
        if (++length < 3 || last[0] == last[1] || last[1] == last[2] || last[0] == last[2]) continue;
        const bool is_turned = length % 2 == 0;
        for (const std::size_t i : is_turned ? std::array{1u, 0u, 2u} : std::array{0u, 1u, 2u}) {
          polygons_.add_corner(last[i]);
        }
        if (const std::string message = polygons_.finish_face(); !message.empty()) rows_.fail(message);
      }
    });
  }

  Mesh finish() {
    if (!corner_textures_.empty()) {
      mesh_.faces.texture_coordinates.resize(mesh_.faces.vertices.size(), -1);
      mesh_.texture_coordinates = Eigen::Map<const decltype(mesh_.texture_coordinates)>(
          corner_textures_.data(), static_cast<Eigen::Index>(corner_textures_.size() / 2), 2);
    } else if (has_texture_by_vertex_) {
      mesh_.faces.texture_coordinates = mesh_.faces.vertices;
    }
    polygons_.finish();
    return std::move(mesh_);
  }

  const ByteSource& source_;
  const PlyHeader& header_;
  Rows rows_;
  Mesh mesh_;
  PolygonBuilder polygons_;
  Index vertex_count_ = 0;
  bool has_texture_by_vertex_ = false;
  std::vector<Real> corner_textures_;
  Edge edge_{};
  int edge_ends_ = 0;
};

}  // namespace

Mesh read_ply(const ByteSource& source) {
  const PlyHeader header = read_ply_header(source);
  if (header.encoding == PlyEncoding::ascii) return PlyReader<PlyTextRows>(source, header).read();
  return PlyReader<PlyBinaryRows>(source, header).read();
}

}  // namespace pliant
