// The packaged readers do not serve here: tinyobjloader takes a malformed number for 0, and neither it nor the others
// can name the line of what is wrong.
#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/error.h"
#include "pliant/mesh/io/detail/obj_lexer.h"
#include "pliant/mesh/io/obj.h"
#include "pliant/mesh/io/read_file.h"

namespace pliant {

namespace {

constexpr std::size_t max_count = std::numeric_limits<Index>::max();

/// One of the three lists that face corners refer to.
struct Referred {
  std::string_view name;
  std::size_t count = 0;  ///< so far in the file
};

/// An index to something that the file had not yet defined where it was used.
struct Promise {
  const Referred* list;
  std::int64_t index;  ///< as in the file, from 1
  std::int64_t line;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, std::string_view name) : name_(name), lexer_(text, name) {}

  Mesh read() {
    mesh_.faces.offsets.push_back(0);
    while (lexer_.next_line()) read_line();
    check_promises();
    if (vertices_.count == 0) fail_input(fmt::format("{}: no vertices; give at least one line \"v x y z\"", name_));
    return finish();
  }

 private:
  void read_line() {
    const std::string_view keyword = lexer_.next_word();
    if (keyword == "v") {
      read_coordinates(vertices_, coordinates_, {3, 7}, 3);
    } else if (keyword == "vt") {
      read_coordinates(textures_, texture_coordinates_, {1, 3}, 2);
    } else if (keyword == "vn") {
      count_one_more(normals_);
      lexer_.skip_rest_of_line();
    } else if (keyword == "f") {
      read_face();
    } else if (keyword == "l") {
      read_polyline();
    } else if (keyword == "g") {
      group_names_ = read_words();
      is_group_current_ = false;
    } else if (keyword == "o") {
      object_name_ = fmt::format("{}", fmt::join(read_words(), " "));
      is_group_current_ = false;
    } else {
      lexer_.skip_rest_of_line();
    }
  }

  /// Reads a whole line of numbers; keeps the first `kept`, with zeros for what is not there.
  void read_coordinates(Referred& list, std::vector<Real>& numbers, std::pair<std::size_t, std::size_t> allowed,
                        std::size_t kept) {
    count_one_more(list);
    std::size_t count = 0;
    for (auto word = lexer_.next_word(); !word.empty(); word = lexer_.next_word()) {
      const Real number = lexer_.number(word);
      if (count++ < kept) numbers.push_back(number);
      if (count > allowed.second) {
        lexer_.fail(fmt::format("too many coordinates for a {}; give at most {}", list.name, allowed.second));
      }
    }
    if (count < allowed.first) {
      lexer_.fail(fmt::format("{} of the {} coordinates of a {}; give them all", count, allowed.first, list.name));
    }
    numbers.resize(list.count * kept, 0);
  }

  void count_one_more(Referred& list) {
    if (list.count == max_count)
      lexer_.fail(fmt::format("more than {} of a {}; cut the mesh up", max_count, list.name));
    ++list.count;
  }

  std::vector<std::string> read_words() {
    std::vector<std::string> words;
    for (auto word = lexer_.next_word(); !word.empty(); word = lexer_.next_word()) words.emplace_back(word);
    return words;
  }

  void read_face() {
    PolygonFaces& faces = mesh_.faces;
    const std::size_t first = faces.vertices.size();
    const std::int64_t line = lexer_.line();
    for (auto word = lexer_.next_word(); !word.empty(); word = lexer_.next_word()) read_corner(word);
    const auto corners = std::span(faces.vertices).subspan(first);
    if (corners.size() < 3) {
      lexer_.fail_at(line, fmt::format("a face with {} corners; give it at least 3", corners.size()));
    }
    check_distinct(corners, line);
    if (faces.vertices.size() > max_count) {
      lexer_.fail_at(line, fmt::format("more than {} face corners; cut the mesh up", max_count));
    }
    faces.offsets.push_back(static_cast<Index>(faces.vertices.size()));
    for (std::size_t i = 2; i < corners.size(); ++i) {
      mesh_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
    make_groups_current();
    for (std::size_t group : current_groups_) mesh_.groups[group].faces.push_back(faces.face_count() - 1);
  }

  /// v, v/vt, v//vn or v/vt/vn.
  void read_corner(std::string_view word) {
    const auto [vertex, rest] = split(word);
    const auto [texture, normal] = split(rest);
    if (normal.find('/') != std::string_view::npos) {
      lexer_.fail(fmt::format("{} is not a face corner; write v, v/vt, v//vn or v/vt/vn", ObjLexer::quoted(word)));
    }
    mesh_.faces.vertices.push_back(resolve(vertex, vertices_));
    mesh_.faces.texture_coordinates.push_back(texture.empty() ? -1 : resolve(texture, textures_));
    has_texture_ = has_texture_ || !texture.empty();
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
        lexer_.fail(fmt::format("vertex {} twice in a row in a line; remove one", ObjLexer::quoted(word)));
      }
      if (count > 0) mesh_.edges.push_back({previous, vertex});
      previous = vertex;
    }
    if (count < 2) lexer_.fail_at(line, fmt::format("a line with {} vertices; give it at least 2", count));
  }

  /// From the file's index, which counts from 1 or, if negative, back from the last, to ours.
  Index resolve(std::string_view word, const Referred& list) {
    const std::int64_t index = lexer_.integer(word);
    const auto count = static_cast<std::int64_t>(list.count);
    if (index == 0) lexer_.fail(fmt::format("index 0 of a {}; the first one is 1, the last one -1", list.name));
    if (index < -count) {
      lexer_.fail(fmt::format("{} {} is out of range, since there are {} above; use -1 to -{}", list.name, index, count,
                              count));
    }
    if (index > count) promises_.push_back({&list, index, lexer_.line()});
    return static_cast<Index>(index < 0 ? count + index : std::min<std::int64_t>(index - 1, max_count));
  }

  void check_promises() const {
    for (const auto& [list, index, line] : promises_) {
      if (index <= static_cast<std::int64_t>(list->count)) continue;
      lexer_.fail_at(line, fmt::format("{} {} is out of range, since the file has {}; correct the index", list->name,
                                       index, list->count));
    }
  }

  void check_distinct(std::span<const Index> corners, std::int64_t line) {
    sorted_corners_.assign(corners.begin(), corners.end());
    std::ranges::sort(sorted_corners_);
    const auto repeated = std::ranges::adjacent_find(sorted_corners_);
    if (repeated == sorted_corners_.end()) return;
    lexer_.fail_at(line, fmt::format("a face with vertex {} at two corners; remove one", *repeated + std::int64_t{1}));
  }

  /// Groups come into being with their first face, so that their order does not change when the mesh is written.
  void make_groups_current() {
    if (is_group_current_) return;
    current_groups_.clear();
    if (!object_name_.empty()) add_current(FaceGroupKind::object, object_name_);
    for (const std::string& name : group_names_) add_current(FaceGroupKind::group, name);
    is_group_current_ = true;
  }

  void add_current(FaceGroupKind kind, const std::string& name) {
    const auto [entry, is_new] = group_index_.try_emplace({kind, name}, mesh_.groups.size());
    if (is_new) mesh_.groups.push_back({name, kind, {}});
    if (std::ranges::find(current_groups_, entry->second) == current_groups_.end()) {
      current_groups_.push_back(entry->second);
    }
  }

  Mesh finish() {
    mesh_.vertices = Eigen::Map<const Positions>(coordinates_.data(), static_cast<Index>(vertices_.count), 3);
    mesh_.texture_coordinates = Eigen::Map<const decltype(mesh_.texture_coordinates)>(
        texture_coordinates_.data(), static_cast<Index>(textures_.count), 2);
    if (!has_texture_) mesh_.faces.texture_coordinates.clear();
    if (mesh_.faces.vertices.empty()) mesh_.faces.offsets.clear();
    return std::move(mesh_);
  }

  std::string_view name_;
  ObjLexer lexer_;
  Mesh mesh_;
  Referred vertices_{"vertex"};
  Referred textures_{"texture coordinate"};
  Referred normals_{"normal"};
  std::vector<Real> coordinates_;          ///< three for each vertex
  std::vector<Real> texture_coordinates_;  ///< two for each `vt`
  std::vector<Promise> promises_;
  std::vector<Index> sorted_corners_;  ///< scratch
  bool has_texture_ = false;

  std::string object_name_;
  std::vector<std::string> group_names_;
  std::vector<std::size_t> current_groups_;
  bool is_group_current_ = false;  ///< current_groups_ is what the two names say
  std::map<std::pair<FaceGroupKind, std::string>, std::size_t> group_index_;
};

}  // namespace

Mesh parse_obj(std::string_view bytes, std::string_view name) {
  return ObjReader(bytes, name).read();
}

Mesh read_obj(const std::filesystem::path& path) {
  return parse_obj(read_file(path), path.string());
}

}  // namespace pliant
