// TetGen's pair of files: points in .node, tetrahedra in .ele. Numbers begin at 0 or at 1, as the first point says.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "pliant/mesh/geometry.h"
#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/mesh/detail/polygon_builder.h"
#include "pliant_io/mesh/detail/tetrahedra.h"
#include "pliant_io/mesh/detail/text_lexer.h"
#include "pliant_io/mesh/tetgen.h"

namespace pliant {

namespace {

constexpr TextSyntax tetgen_syntax{.comment = '#'};

class TetgenReader {
 public:
  void read_points(TextLexer& lexer) {
    const std::int64_t count = read_count(lexer, "points");
    const std::int64_t dimension = read_head_number(lexer);
    const std::int64_t attributes = read_head_number(lexer);
    const std::int64_t markers = read_head_number(lexer);
    lexer.skip_rest_of_line();
    if (dimension != 3) lexer.fail(fmt::format("points of dimension {}; give 3 coordinates", dimension));
    if (attributes < 0 || attributes > most_attributes) {
      lexer.fail(fmt::format("{} attributes of a point; give at most {}", attributes, most_attributes));
    }
    check_room(lexer, count, "points", static_cast<std::uint64_t>(4 + attributes + (markers > 0 ? 1 : 0)));
    for (std::int64_t a = 0; a < attributes; ++a) add_map(fmt::format("attribute{}", a + 1), count);
    if (markers > 0) add_map("marker", count);
    mesh_.vertices.resize(static_cast<Eigen::Index>(count), 3);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) read_point(lexer, v);
  }

  void read_tetrahedra(TextLexer& lexer) {
    const std::int64_t count = read_count(lexer, "tetrahedra");
    const std::int64_t corners = read_head_number(lexer);
    lexer.skip_rest_of_line();
    if (corners != 4) lexer.fail(fmt::format("tetrahedra of {} points; export them of first order, with 4", corners));
    check_room(lexer, count, "tetrahedra", 5);
    mesh_.tetrahedra.reserve(static_cast<std::size_t>(count));
    for (std::int64_t t = 0; t < count; ++t) {
      next_row(lexer, "tetrahedra");
      lexer.next_word();  // its number
      Tetrahedron tetrahedron;
      for (Index& corner : tetrahedron) corner = resolve(lexer);
      lexer.skip_rest_of_line();  // the region that it is in
      if (const std::string message = add_tetrahedron(mesh_, tetrahedron, first_number_); !message.empty()) {
        lexer.fail(message);
      }
    }
  }

  static void finish(TextLexer& lexer) {
    if (lexer.next_line()) lexer.fail("more rows than the first line counts; correct it");
  }

  Mesh take() { return std::move(mesh_); }

 private:
  static constexpr std::int64_t most_attributes = 100;

  /// The first number of the first line.
  static std::int64_t read_count(TextLexer& lexer, std::string_view what) {
    next_row(lexer, what);
    return lexer.integer(lexer.next_word());
  }

  /// Before anything is allocated. A number takes two bytes at least.
  static void check_room(const TextLexer& lexer, std::int64_t count, std::string_view what, std::uint64_t numbers) {
    const std::uint64_t room = std::min(max_index_count, lexer.remaining() / (2 * numbers) + 1);
    if (count >= 1 && static_cast<std::uint64_t>(count) <= room) return;
    lexer.fail(fmt::format("{} {}, but the file has room for at most {}; it may be cut short", count, what, room));
  }

  static std::int64_t read_head_number(TextLexer& lexer) {
    const std::string_view word = lexer.next_word();
    return word.empty() ? 0 : lexer.integer(word);
  }

  static void next_row(TextLexer& lexer, std::string_view what) {
    if (!lexer.next_line()) lexer.fail(fmt::format("the file ends before its last {}; it may be cut short", what));
  }

  void add_map(std::string name, std::int64_t count) {
    mesh_.maps.push_back({std::move(name), std::vector<Real>(static_cast<std::size_t>(count))});
  }

  void read_point(TextLexer& lexer, Index v) {
    next_row(lexer, "points");
    const std::int64_t number = lexer.integer(lexer.next_word());
    if (v == 0) first_number_ = number == 1 ? 1 : 0;
    if (number != v + first_number_) {
      lexer.fail(fmt::format("point {} in place of {}; number them in order, from 0 or 1", number, v + first_number_));
    }
    for (Eigen::Index k = 0; k < 3; ++k) mesh_.vertices(v, k) = lexer.number(lexer.next_word());
    for (VertexMap& map : mesh_.maps) {
      map.values[static_cast<std::size_t>(v)] = lexer.number(lexer.next_word());
    }
    lexer.skip_rest_of_line();
  }

  Index resolve(TextLexer& lexer) const {
    const std::int64_t number = lexer.integer(lexer.next_word());
    const std::int64_t last = mesh_.vertex_count() - 1 + first_number_;
    if (number < first_number_ || number > last) {
      lexer.fail(fmt::format("point {} is out of range; use {} to {}", number, first_number_, last));
    }
    return static_cast<Index>(number - first_number_);
  }

  Mesh mesh_;
  std::int64_t first_number_ = 0;
};

}  // namespace

Mesh read_tetgen(const ByteSource& points_and_tetrahedra) {
  TetgenReader reader;
  TextLexer lexer(points_and_tetrahedra, tetgen_syntax);
  reader.read_points(lexer);
  reader.read_tetrahedra(lexer);
  TetgenReader::finish(lexer);
  return reader.take();
}

Mesh read_tetgen_pair(const ByteSource& points, const ByteSource& tetrahedra) {
  TetgenReader reader;
  TextLexer point_lexer(points, tetgen_syntax);
  reader.read_points(point_lexer);
  TetgenReader::finish(point_lexer);
  TextLexer lexer(tetrahedra, tetgen_syntax);
  reader.read_tetrahedra(lexer);
  TetgenReader::finish(lexer);
  return reader.take();
}

}  // namespace pliant
