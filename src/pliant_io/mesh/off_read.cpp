#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/mesh/detail/colors.h"
#include "pliant_io/mesh/detail/polygon_builder.h"
#include "pliant_io/mesh/detail/text_lexer.h"
#include "pliant_io/mesh/off.h"

namespace pliant {

namespace {

class OffReader {
 public:
  explicit OffReader(const ByteSource& source) : lexer_(source, {.comment = '#'}), polygons_(mesh_, source.size(), 0) {}

  Mesh read() {
    read_header();
    for (std::uint64_t v = 0; v < vertex_count_; ++v) read_vertex(v);
    for (std::uint64_t f = 0; f < face_count_; ++f) read_face(f);
    if (lexer_.next_line()) lexer_.fail("more lines than the counts at the top say; correct them");
    polygons_.finish();
    colors_.finish(mesh_);
    if (has_texture_) mesh_.faces.texture_coordinates = mesh_.faces.vertices;
    return std::move(mesh_);
  }

 private:
  /// [ST][C][N]OFF, which may be missing, then the counts of vertices, faces and perhaps edges.
  void read_header() {
    next_line("its counts");
    std::string_view word = lexer_.next_word();
    if (word.ends_with("OFF")) {
      read_keyword(word);
      word = lexer_.next_word();
      if (word == "BINARY") lexer_.fail("binary OFF; export it as ASCII, or as PLY");
      if (word.empty()) {
        next_line("its counts");
        word = lexer_.next_word();
      }
    } else if (word.find_first_not_of("0123456789") != std::string_view::npos) {
      lexer_.fail(
          fmt::format("starts with {}, not with \"OFF\"; give an OFF file, or rename it", TextLexer::quoted(word)));
    }
    vertex_count_ = read_count(word, "vertices");
    face_count_ = read_count(lexer_.next_word(), "faces");
    lexer_.skip_rest_of_line();  // the count of edges, which many programs leave at 0
    check_counts();
  }

  void read_keyword(std::string_view word) {
    std::string_view rest = word.substr(0, word.size() - 3);
    const auto take = [&](std::string_view prefix) {
      const bool is_there = rest.starts_with(prefix);
      if (is_there) rest.remove_prefix(prefix.size());
      return is_there;
    };
    has_texture_ = take("ST");
    has_color_ = take("C");
    has_normal_ = take("N");
    if (rest.empty()) return;
    lexer_.fail(fmt::format("{}: vertices of another dimension than 3; export the mesh as OFF, COFF, NOFF or STOFF",
                            TextLexer::quoted(word)));
  }

  std::uint64_t read_count(std::string_view word, std::string_view what) const {
    if (word.empty()) lexer_.fail(fmt::format("no count of {}; give the counts of vertices, faces and edges", what));
    const std::int64_t count = lexer_.integer(word);
    if (count < 0) lexer_.fail(fmt::format("{} {}; give 0 or more", count, what));
    return static_cast<std::uint64_t>(count);
  }

  /// Before anything is allocated. A vertex takes six bytes at least, a face two.
  void check_counts() const {
    if (vertex_count_ == 0) lexer_.fail("no vertices; give at least one");
    const std::uint64_t room = lexer_.remaining();
    if (vertex_count_ > room / 6 + 1 || face_count_ > room / 2 + 1) {
      lexer_.fail(
          fmt::format("{} vertices and {} faces are more than the {} bytes that follow can hold; the file may "
                      "be cut short",
                      vertex_count_, face_count_, room));
    }
    if (vertex_count_ > max_index_count) lexer_.fail(fmt::format("more than {} vertices; cut it up", max_index_count));
  }

  void next_line(std::string_view what) {
    if (!lexer_.next_line()) lexer_.fail(fmt::format("the file ends before {}; it may be cut short", what));
  }

  void read_vertex(std::uint64_t v) {
    next_line("its last vertex");
    std::size_t count = 0;
    for (auto word = lexer_.next_word(); !word.empty(); word = lexer_.next_word()) {
      if (count == numbers_.size()) lexer_.fail("too many numbers for a vertex; give what the first line announces");
      numbers_[count++] = lexer_.number(word);
    }
    if (v == 0) choose_layout(count);
    if (count != numbers_of_vertex_) {
      lexer_.fail(fmt::format("{} numbers for a vertex, which has {} here; give them all", count, numbers_of_vertex_));
    }
    std::copy_n(numbers_.begin(), 3, mesh_.vertices.data() + 3 * v);
    const std::size_t color = has_normal_ ? 6 : 3;
    if (has_color_) {
      colors_.set(static_cast<std::size_t>(v), std::span(numbers_).subspan(color, color_size_),
                  static_cast<std::size_t>(vertex_count_));
    }
    if (has_texture_)
      std::copy_n(numbers_.begin() + static_cast<std::ptrdiff_t>(count) - 2, 2,
                  mesh_.texture_coordinates.data() + 2 * v);
  }

  /// Position, normal, color with or without its opacity, texture coordinates, in this order.
  void choose_layout(std::size_t count) {
    const std::size_t others = 3 + (has_normal_ ? 3u : 0u) + (has_texture_ ? 2u : 0u);
    color_size_ = !has_color_ ? 0 : count == others + 4 ? 4 : 3;
    numbers_of_vertex_ = others + color_size_;
    mesh_.vertices.resize(static_cast<Eigen::Index>(vertex_count_), 3);
    if (has_texture_) mesh_.texture_coordinates.resize(static_cast<Eigen::Index>(vertex_count_), 2);
  }

  /// A count, so many vertices, and perhaps a color, which is dropped. Two corners make an edge; one makes a point,
  /// which is a vertex already.
  void read_face(std::uint64_t f) {
    next_line("its last face");
    const std::int64_t line = lexer_.line();
    const std::int64_t count = lexer_.integer(lexer_.next_word());
    if (count < 1) lexer_.fail(fmt::format("a face with {} corners; give it at least 3", count));
    if (f == 0) reserve_like_first(static_cast<std::uint64_t>(count));
    for (std::int64_t i = 0; i < count; ++i) {
      const std::string_view word = lexer_.next_word();
      if (word.empty()) lexer_.fail(fmt::format("{} of the {} corners of a face; give them all", i, count));
      polygons_.add_corner(resolve(word));
    }
    lexer_.skip_rest_of_line();
    if (count < 3) return finish_edge();
    if (const std::string message = polygons_.finish_face(); !message.empty()) lexer_.fail_at(line, message);
  }

  /// Most files have faces of one size; a corner takes two bytes at least.
  void reserve_like_first(std::uint64_t corners) {
    const std::uint64_t room = lexer_.remaining() / 2;
    polygons_.reserve(face_count_, std::min(room, face_count_ * std::min(corners, room / face_count_ + 1)));
  }

  void finish_edge() {
    const auto ends = polygons_.corners();
    if (ends.size() == 2) {
      if (ends[0] == ends[1]) lexer_.fail(fmt::format("an edge from vertex {} to itself; remove it", ends[0]));
      mesh_.edges.push_back({ends[0], ends[1]});
    }
    polygons_.drop_corners();
  }

  Index resolve(std::string_view word) const {
    const std::int64_t index = lexer_.integer(word);
    if (index < 0 || index >= static_cast<std::int64_t>(vertex_count_)) {
      lexer_.fail(fmt::format("vertex {} is out of range, since the file has {}; use 0 to {}", index, vertex_count_,
                              vertex_count_ - 1));
    }
    return static_cast<Index>(index);
  }

  TextLexer lexer_;
  Mesh mesh_;
  PolygonBuilder polygons_;
  ColorColumns colors_;
  std::uint64_t vertex_count_ = 0;
  std::uint64_t face_count_ = 0;
  bool has_texture_ = false;
  bool has_color_ = false;
  bool has_normal_ = false;
  std::size_t color_size_ = 0;
  std::size_t numbers_of_vertex_ = 0;
  std::array<Real, 16> numbers_{};
};

}  // namespace

Mesh read_off(const ByteSource& source) {
  return OffReader(source).read();
}

}  // namespace pliant
