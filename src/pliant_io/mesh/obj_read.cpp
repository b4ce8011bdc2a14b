// The packaged readers do not serve here, see docs/formats.md: tinyobjloader takes a malformed number for 0, and none
// can name the line of what is wrong.
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/mesh/detail/colors.h"
#include "pliant_io/mesh/detail/face_groups.h"
#include "pliant_io/mesh/detail/polygon_builder.h"
#include "pliant_io/mesh/detail/text_lexer.h"
#include "pliant_io/mesh/obj.h"

namespace pliant {

namespace {

constexpr TextSyntax obj_syntax{.comment = '#', .continuation = '\\'};

/// What a file holds. Counting takes a pass of its own; with it every list is allocated once, to its size.
struct Counts {
  std::uint64_t vertices = 0;
  std::uint64_t textures = 0;
  std::uint64_t faces = 0;
  std::uint64_t corners = 0;
  std::uint64_t edges = 0;
};

bool is_face(std::string_view keyword) {
  return keyword == "f" || keyword == "fo";
}

std::uint64_t count_words(TextLexer& lexer) {
  std::uint64_t count = 0;
  while (!lexer.next_word().empty()) ++count;
  return count;
}

Counts count_elements(const ByteSource& source) {
  Counts counts;
  TextLexer lexer(source, obj_syntax);
  while (lexer.next_line()) {
    const std::string_view keyword = lexer.next_word();
    if (keyword == "v") {
      ++counts.vertices;
    } else if (keyword == "vt") {
      ++counts.textures;
    } else if (is_face(keyword)) {
      ++counts.faces;
      counts.corners += count_words(lexer);
      continue;
    } else if (keyword == "l") {
      counts.edges += count_words(lexer);
      continue;
    }
    lexer.skip_rest_of_line();
  }
  return counts;
}

/// One of the three lists that face corners refer to.
struct Referred {
  std::string_view name;
  std::uint64_t count = 0;   ///< so far in the file
  std::int64_t largest = 0;  ///< index that was used before the file had defined so many, from 1
  std::int64_t line = 0;     ///< where
};

/// Statements without which the mesh would not be the one in the file.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> refused_keywords{{
    {"curv", "a free-form curve"},
    {"surf", "a free-form surface"},
    {"bsp", "a B-spline patch"},
    {"bzp", "a Bezier patch"},
    {"cdp", "a Cardinal patch"},
    {"call", "a statement that includes another file"},
    {"csh", "a statement that runs a command"},
}};

class ObjReader {
 public:
  explicit ObjReader(const ByteSource& source)
      : source_(source),
        lexer_(source, obj_syntax),
        polygons_(mesh_, source.size(), 1),
        groups_(mesh_, source.size()) {}

  Mesh read() {
    const Counts counts = count_elements(source_);
    vertex_room_ = std::min(counts.vertices, max_index_count);
    mesh_.vertices.resize(static_cast<Eigen::Index>(vertex_room_), 3);
    texture_room_ = std::min(counts.textures, max_index_count);
    mesh_.texture_coordinates.resize(static_cast<Eigen::Index>(texture_room_), 2);
    polygons_.reserve(counts.faces, counts.corners);
    mesh_.edges.reserve(static_cast<std::size_t>(counts.edges));
    while (lexer_.next_line()) read_line();
    for (const Referred& list : {vertices_, textures_, normals_}) check_largest(list);
    if (vertices_.count == 0) source_.fail("no vertices; give at least one line \"v x y z\"");
    polygons_.finish();
    colors_.finish(mesh_);
    return std::move(mesh_);
  }

 private:
  void read_line() {
    const std::string_view keyword = lexer_.next_word();
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "vt") {
      read_texture();
    } else if (keyword == "vn") {
      count_one_more(normals_, max_index_count);
      lexer_.skip_rest_of_line();
    } else if (is_face(keyword)) {
      read_face();
    } else if (keyword == "l") {
      read_polyline();
    } else if (keyword == "g") {
      groups_.clear_groups();
      for (auto word = lexer_.next_word(); !word.empty(); word = lexer_.next_word()) refuse(groups_.add_group(word));
    } else if (keyword == "o") {
      groups_.set_name(FaceGroupKind::object, rest_of_line());
    } else if (keyword == "usemtl") {
      groups_.set_name(FaceGroupKind::material, rest_of_line());
    } else if (keyword == "mtllib") {
      read_library();
    } else {
      for (const auto& [refused, what] : refused_keywords) {
        if (keyword == refused) lexer_.fail(fmt::format("{} ({}); export the mesh as polygons", what, refused));
      }
      lexer_.skip_rest_of_line();
    }
  }

  void refuse(const std::string& message) const {
    if (!message.empty()) lexer_.fail(message);
  }

  /// Reads a whole line of numbers, at most as many as there is room for.
  std::span<const Real> read_numbers(const Referred& list, std::size_t least, std::size_t most) {
    std::size_t count = 0;
    for (auto word = lexer_.next_word(); !word.empty(); word = lexer_.next_word()) {
      const Real number = lexer_.number(word);
      if (count == most) {
        lexer_.fail(fmt::format("too many coordinates for a {}; give at most {}", list.name, most));
      }
      numbers_[count++] = number;
    }
    if (count < least) {
      lexer_.fail(fmt::format("{} of the {} coordinates of a {}; give them all", count, least, list.name));
    }
    return std::span(numbers_).first(count);
  }

  /// x y z; or x y z and a weight, which only free-form surfaces use; or x y z, a color and perhaps its opacity.
  void read_vertex() {
    const std::size_t v = count_one_more(vertices_, vertex_room_);
    const auto numbers = read_numbers(vertices_, 3, 7);
    if (numbers.size() == 5) {
      lexer_.fail("5 coordinates for a vertex; give 3, or 4 with a weight, 6 with a color, 7 with its opacity");
    }
    for (std::size_t k = 0; k < 3; ++k) mesh_.vertices.data()[3 * v + k] = numbers[k];
    if (numbers.size() > 4) colors_.set(v, numbers.subspan(3), static_cast<std::size_t>(vertex_room_));
  }

  void read_texture() {
    const std::size_t t = count_one_more(textures_, texture_room_);
    const auto numbers = read_numbers(textures_, 1, 3);
    mesh_.texture_coordinates.data()[2 * t] = numbers[0];
    mesh_.texture_coordinates.data()[2 * t + 1] = numbers.size() > 1 ? numbers[1] : 0;
  }

  /// The place of the next entry of a list.
  std::size_t count_one_more(Referred& list, std::uint64_t room) {
    if (list.count == max_index_count) {
      lexer_.fail(fmt::format("more than {} of a {}; cut the mesh up", max_index_count, list.name));
    }
    if (list.count == room) lexer_.fail("a file that changes while it is read; try again when nothing writes to it");
    return static_cast<std::size_t>(list.count++);
  }

  std::string rest_of_line() {
    std::string text;
    for (auto word = lexer_.next_word(); !word.empty(); word = lexer_.next_word()) {
      if (!text.empty()) text += ' ';
      text += word;
    }
    return text;
  }

  void read_library() {
    constexpr std::size_t most = 1000;
    std::string library = rest_of_line();
    if (library.empty() || std::ranges::find(mesh_.material_libraries, library) != mesh_.material_libraries.end()) {
      return;
    }
    if (mesh_.material_libraries.size() == most) {
      lexer_.fail(fmt::format("more than {} material libraries; join some", most));
    }
    mesh_.material_libraries.push_back(std::move(library));
  }

  void read_face() {
    const std::int64_t line = lexer_.line();
    for (auto word = lexer_.next_word(); !word.empty(); word = lexer_.next_word()) read_corner(word);
    std::string message = polygons_.finish_face();
    if (message.empty()) message = groups_.add_face(mesh_.faces.face_count() - 1);
    if (!message.empty()) lexer_.fail_at(line, message);
  }

  /// v, v/vt, v//vn or v/vt/vn.
  void read_corner(std::string_view word) {
    const auto [vertex, rest] = split(word);
    if (rest.empty()) return polygons_.add_corner(resolve(vertex, vertices_));
    const auto [texture, normal] = split(rest);
    if (normal.find('/') != std::string_view::npos) {
      lexer_.fail(fmt::format("{} is not a face corner; write v, v/vt, v//vn or v/vt/vn", TextLexer::quoted(word)));
    }
    polygons_.add_corner(resolve(vertex, vertices_), texture.empty() ? -1 : resolve(texture, textures_));
    if (!normal.empty()) resolve(normal, normals_);
  }

  static std::pair<std::string_view, std::string_view> split(std::string_view word) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    return {word.substr(0, slash), word.substr(std::min(slash + 1, word.size()))};
  }

  void read_polyline() {
    const std::int64_t line = lexer_.line();
    Index previous = -1;
    std::size_t count = 0;
    for (auto word = lexer_.next_word(); !word.empty(); word = lexer_.next_word(), ++count) {
      const Index vertex = resolve(split(word).first, vertices_);
      if (vertex == previous) {
        lexer_.fail(fmt::format("vertex {} twice in a row in a line; remove one", TextLexer::quoted(word)));
      }
      if (count > 0) mesh_.edges.push_back({previous, vertex});
      previous = vertex;
    }
    if (count < 2) lexer_.fail_at(line, fmt::format("a line with {} vertices; give it at least 2", count));
  }

  /// From the file's index, which counts from 1 or, if negative, back from the last, to ours.
  Index resolve(std::string_view word, Referred& list) {
    const std::int64_t index = lexer_.integer(word);
    const auto count = static_cast<std::int64_t>(list.count);
    if (index == 0) lexer_.fail(fmt::format("index 0 of a {}; the first one is 1, the last one -1", list.name));
    if (index < -count) {
      lexer_.fail(fmt::format("{} {} is out of range, since there are {} above; use -1 to -{}", list.name, index, count,
                              count));
    }
    if (index > count && index > list.largest) {
      list.largest = index;
      list.line = lexer_.line();
    }
    return static_cast<Index>(index < 0 ? count + index
                                        : std::min<std::int64_t>(index, std::int64_t{max_index_count}) - 1);
  }

  void check_largest(const Referred& list) const {
    if (list.largest <= static_cast<std::int64_t>(list.count)) return;
    lexer_.fail_at(list.line, fmt::format("{} {} is out of range, since the file has {}; correct the index", list.name,
                                          list.largest, list.count));
  }

  const ByteSource& source_;
  TextLexer lexer_;
  Mesh mesh_;
  PolygonBuilder polygons_;
  FaceGroupsBuilder groups_;
  ColorColumns colors_;
  Referred vertices_{"vertex"};
  Referred textures_{"texture coordinate"};
  Referred normals_{"normal"};
  std::uint64_t vertex_room_ = 0;
  std::uint64_t texture_room_ = 0;
  std::array<Real, 8> numbers_{};
};

}  // namespace

Mesh read_obj(const ByteSource& source) {
  return ObjReader(source).read();
}

}  // namespace pliant
