// Gmsh's .msh as text, of versions 2.2 and 4.1.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/mesh/detail/polygon_builder.h"
#include "pliant_io/mesh/detail/tetrahedra.h"
#include "pliant_io/mesh/detail/text_lexer.h"
#include "pliant_io/mesh/gmsh.h"

namespace pliant {

namespace {

/// The types of elements that are read, by their number.
struct ElementType {
  std::int64_t number;
  std::size_t corners;
};
constexpr std::array<ElementType, 5> element_types{{{15, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 4}}};
constexpr std::int64_t point_type = 15;
constexpr std::int64_t line_type = 1;
constexpr std::int64_t tetrahedron_type = 4;

class GmshReader {
 public:
  explicit GmshReader(const ByteSource& source)
      : source_(source), lexer_(source, {}), polygons_(mesh_, source.size(), 0) {}

  Mesh read() {
    while (lexer_.next_line()) read_section();
    if (mesh_.vertex_count() == 0) source_.fail("no $Nodes; give at least one node");
    if (!has_elements_) source_.fail("no $Elements; the file may be cut short");
    polygons_.finish();
    keep_highest_dimension(mesh_);
    return std::move(mesh_);
  }

 private:
  void read_section() {
    const std::string name(lexer_.next_word());
    if (name == "$MeshFormat") {
      read_format();
    } else if (name == "$Nodes") {
      if (mesh_.vertex_count() > 0) lexer_.fail("$Nodes twice; join the two");
      version_ == 2 ? read_nodes_2() : read_nodes_4();
      index_tags();
    } else if (name == "$Elements") {
      version_ == 2 ? read_elements_2() : read_elements_4();
      has_elements_ = true;
    } else if (name.starts_with("$")) {
      return skip_section();
    } else {
      lexer_.fail(fmt::format("{} in place of a section; write $MeshFormat first", TextLexer::quoted(name)));
    }
    next_line();
    if (const auto word = lexer_.next_word(); word != "$End" + name.substr(1)) {
      lexer_.fail(fmt::format("{} in place of the end of {}; correct its counts", TextLexer::quoted(word), name));
    }
    lexer_.skip_rest_of_line();
  }

  void skip_section() {
    do {
      lexer_.skip_rest_of_line();
      next_line();
    } while (!lexer_.next_word().starts_with("$End"));
    lexer_.skip_rest_of_line();
  }

  void next_line() {
    if (!lexer_.next_line()) lexer_.fail("the file ends within a section; it may be cut short");
  }

  void read_format() {
    next_line();
    const std::string version(lexer_.next_word());
    if (version != "2.2" && version != "4.1") {
      lexer_.fail(fmt::format("version {}; save the mesh in version 2.2 or 4.1", TextLexer::quoted(version)));
    }
    if (lexer_.next_word() != "0") lexer_.fail("binary .msh; save the mesh as ASCII");
    lexer_.skip_rest_of_line();
    version_ = version == "2.2" ? 2 : 4;
  }

  std::int64_t next_integer() { return lexer_.integer(lexer_.next_word()); }

  /// A count of rows of at least so many bytes each.
  std::int64_t next_count(std::uint64_t bytes) {
    if (version_ == 0) lexer_.fail("no $MeshFormat before this section; write it first");
    const std::int64_t count = next_integer();
    const std::uint64_t room = std::min(max_index_count, lexer_.remaining() / bytes + 1);
    if (count < 0 || static_cast<std::uint64_t>(count) > room) {
      lexer_.fail(
          fmt::format("a count of {}, where the file has room for at most {}; it may be cut short", count, room));
    }
    return count;
  }

  // ---- nodes

  void read_nodes_2() {
    next_line();
    resize(next_count(8));
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      next_line();
      tags_[static_cast<std::size_t>(v)] = next_integer();
      read_point(v);
    }
  }

  void read_nodes_4() {
    next_line();
    const std::int64_t blocks = next_count(8);
    resize(next_count(8));
    lexer_.skip_rest_of_line();
    Index next = 0;
    for (std::int64_t b = 0; b < blocks; ++b) {
      next_line();
      for (int i = 0; i < 3; ++i) next_integer();  // dimension, entity, whether parameters follow the coordinates
      const std::int64_t count = next_count(8);
      lexer_.skip_rest_of_line();
      if (count > mesh_.vertex_count() - next) lexer_.fail("more nodes than $Nodes counts; correct it");
      for (std::int64_t i = 0; i < count; ++i) {
        next_line();
        tags_[static_cast<std::size_t>(next + i)] = next_integer();
        lexer_.skip_rest_of_line();
      }
      for (std::int64_t i = 0; i < count; ++i) {
        next_line();
        read_point(next++);
      }
    }
    if (next < mesh_.vertex_count()) lexer_.fail("fewer nodes than $Nodes counts; correct it");
  }

  void resize(std::int64_t count) {
    mesh_.vertices.resize(static_cast<Eigen::Index>(count), 3);
    tags_.resize(static_cast<std::size_t>(count));
  }

  void read_point(Index v) {
    for (Eigen::Index k = 0; k < 3; ++k) mesh_.vertices(v, k) = lexer_.number(lexer_.next_word());
    lexer_.skip_rest_of_line();
  }

  /// Elements name nodes by tags, which most files count up from 1 but need not.
  void index_tags() {
    bool is_in_order = true;
    for (std::size_t v = 0; v < tags_.size(); ++v) {
      is_in_order = is_in_order && (v == 0 || (tags_[v] > tags_[v - 1] && tags_[v] - 1 == tags_[v - 1]));
    }
    if (is_in_order) return;
    by_tag_.reserve(tags_.size());
    for (std::size_t v = 0; v < tags_.size(); ++v) by_tag_.emplace_back(tags_[v], static_cast<Index>(v));
    std::ranges::sort(by_tag_);
    const auto same = std::ranges::adjacent_find(by_tag_, {}, &std::pair<std::int64_t, Index>::first);
    if (same != by_tag_.end()) lexer_.fail(fmt::format("node {} twice; number nodes differently", same->first));
  }

  Index resolve(std::int64_t tag) const {
    if (by_tag_.empty()) {
      const bool is_known = !tags_.empty() && tag >= tags_.front() && tag <= tags_.back();
      if (is_known) return static_cast<Index>(tag - tags_.front());
    } else {
      const auto entry = std::ranges::lower_bound(by_tag_, tag, {}, &std::pair<std::int64_t, Index>::first);
      if (entry != by_tag_.end() && entry->first == tag) return entry->second;
    }
    lexer_.fail(fmt::format("node {} is not among the nodes above; correct the element", tag));
  }

  // ---- elements

  void read_elements_2() {
    next_line();
    const std::int64_t count = next_count(8);
    for (std::int64_t e = 0; e < count; ++e) {
      next_line();
      next_integer();  // its tag
      const std::int64_t type = next_integer();
      for (std::int64_t tags = next_integer(); tags > 0; --tags) {
        if (lexer_.next_word().empty()) lexer_.fail("an element that ends within its tags; give all of them");
      }
      read_element(type);
    }
  }

  void read_elements_4() {
    next_line();
    const std::int64_t blocks = next_count(8);
    lexer_.skip_rest_of_line();
    for (std::int64_t b = 0; b < blocks; ++b) {
      next_line();
      for (int i = 0; i < 2; ++i) next_integer();  // dimension, entity
      const std::int64_t type = next_integer();
      const std::int64_t count = next_count(4);
      lexer_.skip_rest_of_line();
      for (std::int64_t e = 0; e < count; ++e) {
        next_line();
        next_integer();  // its tag
        read_element(type);
      }
    }
  }

  void read_element(std::int64_t type) {
    const auto* known = std::ranges::find(element_types, type, &ElementType::number);
    if (known == element_types.end()) {
      lexer_.fail(
          fmt::format("an element of type {}; save lines, triangles, quadrangles and tetrahedra of first order", type));
    }
    std::array<Index, 4> corners;
    for (std::size_t i = 0; i < known->corners; ++i) corners[i] = resolve(next_integer());
    lexer_.skip_rest_of_line();
    if (const std::string message = add_element(type, std::span(corners).first(known->corners)); !message.empty()) {
      lexer_.fail(message);
    }
  }

  std::string add_element(std::int64_t type, std::span<const Index> corners) {
    if (type == point_type) return {};
    if (type == tetrahedron_type) {
      return add_tetrahedron(mesh_, {corners[0], corners[1], corners[2], corners[3]}, 0);
    }
    if (type == line_type) {
      if (corners[0] == corners[1]) return fmt::format("a line from vertex {} to itself; remove it", corners[0]);
      mesh_.edges.push_back({corners[0], corners[1]});
      return {};
    }
    for (const Index corner : corners) polygons_.add_corner(corner);
    return polygons_.finish_face();
  }

  const ByteSource& source_;
  TextLexer lexer_;
  Mesh mesh_;
  PolygonBuilder polygons_;
  bool has_elements_ = false;
  int version_ = 0;                                     ///< the first number of 2.2 or 4.1; 0 before $MeshFormat
  std::vector<std::int64_t> tags_;                      ///< of each vertex
  std::vector<std::pair<std::int64_t, Index>> by_tag_;  ///< sorted; empty when the tags count up
};

}  // namespace

Mesh read_gmsh(const ByteSource& source) {
  return GmshReader(source).read();
}

}  // namespace pliant
