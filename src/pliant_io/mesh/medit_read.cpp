// MEDIT's .mesh: keywords and numbers, whatever lines they stand on.
#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/mesh/detail/face_groups.h"
#include "pliant_io/mesh/detail/polygon_builder.h"
#include "pliant_io/mesh/detail/tetrahedra.h"
#include "pliant_io/mesh/detail/text_lexer.h"
#include "pliant_io/mesh/medit.h"

namespace pliant {

namespace {

constexpr TextSyntax medit_syntax{.comment = '#'};

/// Groups of vertices by their kind and reference. Their number is held to a share of the file's size, as that of face
/// groups is.
class VertexReferences {
 public:
  VertexReferences(Mesh& mesh, std::uint64_t file_size) : mesh_(mesh), max_groups_((1 << 16) + file_size / 64) {}

  /// What is wrong, as an error message without its place, or nothing.
  std::string add(std::string_view kind, std::int64_t reference, std::span<const Index> vertices) {
    if (reference == 0) return {};
    const auto [entry, is_new] = index_.try_emplace({kind, reference}, mesh_.vertex_groups.size());
    if (is_new) {
      if (mesh_.vertex_groups.size() == max_groups_) {
        return fmt::format("more than {} references for a file of this size; set them to 0", max_groups_);
      }
      mesh_.vertex_groups.push_back({fmt::format("{} {}", kind, reference), {}});
    }
    std::vector<Index>& group = mesh_.vertex_groups[entry->second].vertices;
    group.insert(group.end(), vertices.begin(), vertices.end());
    return {};
  }

  void finish() {
    for (VertexGroup& group : mesh_.vertex_groups) {
      std::ranges::sort(group.vertices);
      group.vertices.erase(std::unique(group.vertices.begin(), group.vertices.end()), group.vertices.end());
    }
  }

 private:
  Mesh& mesh_;
  std::uint64_t max_groups_;
  std::map<std::pair<std::string_view, std::int64_t>, std::size_t> index_;
};

class MeditReader {
 public:
  explicit MeditReader(const ByteSource& source)
      : source_(source),
        lexer_(source, medit_syntax),
        polygons_(mesh_, source.size(), 1),
        face_groups_(mesh_, source.size()),
        references_(mesh_, source.size()) {}

  Mesh read() {
    if (next_word() != "MeshVersionFormatted") {
      source_.fail("not MEDIT's text; it begins with MeshVersionFormatted (a .meshb is binary: save it as .mesh)");
    }
    const std::int64_t version = next_integer();
    if (version < 1 || version > 4) lexer_.fail(fmt::format("version {}; save the mesh in version 2", version));
    keyword_ = next_word();
    while (keyword_ != "End") read_section();
    if (mesh_.vertex_count() == 0) source_.fail("no Vertices; give at least one");
    polygons_.finish();
    if (!mesh_.tetrahedra.empty()) turn_faces_into_vertex_groups();
    references_.finish();
    keep_highest_dimension(mesh_);
    return std::move(mesh_);
  }

 private:
  struct Section {
    std::string_view keyword;
    std::string_view kind;  ///< of groups of vertices
    std::size_t corners;
  };
  static constexpr std::array<Section, 4> sections{{{"Edges", "edges", 2},
                                                    {"Triangles", "faces", 3},
                                                    {"Quadrilaterals", "faces", 4},
                                                    {"Tetrahedra", "tetrahedra", 4}}};

  /// Reads one, its keyword in keyword_, and moves on to the next.
  void read_section() {
    if (keyword_.empty()) lexer_.fail("the file ends before its End; it may be cut short");
    if (std::isalpha(static_cast<unsigned char>(keyword_[0])) == 0) {
      lexer_.fail(fmt::format("{} in place of a keyword; correct the count before it", TextLexer::quoted(keyword_)));
    }
    const auto* elements = std::ranges::find(sections, keyword_, &Section::keyword);
    if (keyword_ == "Dimension") {
      dimension_ = next_integer();
      if (dimension_ != 2 && dimension_ != 3) lexer_.fail(fmt::format("dimension {}; give 2 or 3", dimension_));
    } else if (keyword_ == "Vertices") {
      refuse_again();
      read_vertices();
    } else if (elements != sections.end()) {
      refuse_again();
      read_elements(*elements);
    } else {
      refuse_if_it_matters();
      return skip_section();
    }
    keyword_ = next_word();
  }

  void refuse_again() {
    if (!seen_.insert(keyword_).second) lexer_.fail(fmt::format("{} twice; join the two", keyword_));
  }

  /// Elements that no constraint knows, unless there are none of them.
  void refuse_if_it_matters() {
    for (const std::string_view known : {"Hexahedra", "Hexaedra", "Prisms", "Pyramids"}) {
      if (keyword_ != known || next_integer() == 0) continue;
      lexer_.fail(fmt::format("{}; cut them into Tetrahedra", keyword_));
    }
  }

  void skip_section() {
    do {
      keyword_ = next_word();
    } while (!keyword_.empty() && std::isalpha(static_cast<unsigned char>(keyword_[0])) == 0);
  }

  void read_vertices() {
    if (dimension_ == 0) lexer_.fail("no Dimension before Vertices; write it first");
    const std::int64_t count = next_count(static_cast<std::uint64_t>(dimension_) + 1);
    mesh_.vertices.setZero(static_cast<Eigen::Index>(count), 3);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      for (std::int64_t k = 0; k < dimension_; ++k)
        mesh_.vertices(v, static_cast<Eigen::Index>(k)) = lexer_.number(require_word());
      require(references_.add("vertices", next_integer(), std::span(&v, 1)));
    }
  }

  void read_elements(const Section& section) {
    const std::int64_t count = next_count(section.corners + 1);
    if (count > 0 && mesh_.vertex_count() == 0) {
      lexer_.fail(fmt::format("{} before the Vertices; write those first", section.keyword));
    }
    std::array<Index, 4> corners;
    const auto used = std::span(corners).first(section.corners);
    for (std::int64_t e = 0; e < count; ++e) {
      for (Index& corner : used) corner = resolve(next_integer());
      const std::int64_t reference = next_integer();
      require(section.kind == "faces" ? add_face(used, reference) : add_element(section, used, reference));
    }
  }

  std::string add_element(const Section& section, std::span<const Index> corners, std::int64_t reference) {
    if (corners.size() == 4) {
      const std::string message = add_tetrahedron(mesh_, {corners[0], corners[1], corners[2], corners[3]}, 1);
      if (!message.empty()) return message;
    } else {
      if (corners[0] == corners[1]) return fmt::format("an edge from vertex {} to itself; remove it", corners[0] + 1);
      mesh_.edges.push_back({corners[0], corners[1]});
    }
    return references_.add(section.kind, reference, corners);
  }

  std::string add_face(std::span<const Index> corners, std::int64_t reference) {
    for (const Index corner : corners) polygons_.add_corner(corner);
    if (std::string message = polygons_.finish_face(); !message.empty()) return message;
    if (reference != face_reference_) {
      face_reference_ = reference;
      face_groups_.clear_groups();
      if (reference != 0) require(face_groups_.add_group(fmt::format("faces {}", reference)));
    }
    return face_groups_.add_face(mesh_.faces.face_count() - 1);
  }

  /// The faces are borders, which go: a condition on them is one on their vertices.
  void turn_faces_into_vertex_groups() {
    for (const FaceGroup& group : mesh_.groups) {
      VertexGroup vertices{group.name, {}};
      for (const Index face : group.faces) {
        const auto f = static_cast<std::size_t>(face);
        for (Index c = mesh_.faces.offsets[f]; c < mesh_.faces.offsets[f + 1]; ++c) {
          vertices.vertices.push_back(mesh_.faces.vertices[static_cast<std::size_t>(c)]);
        }
      }
      mesh_.vertex_groups.push_back(std::move(vertices));
    }
    mesh_.groups = {};
  }

  // ---- words and numbers

  /// On whatever line; empty at the end of the file.
  std::string next_word() {
    while (true) {
      if (is_in_line_) {
        const std::string_view word = lexer_.next_word();
        if (!word.empty()) return std::string(word);
      }
      is_in_line_ = lexer_.next_line();
      if (!is_in_line_) return {};
    }
  }

  std::string require_word() {
    std::string word = next_word();
    if (word.empty()) lexer_.fail("the file ends within a section; it may be cut short");
    return word;
  }

  std::int64_t next_integer() { return lexer_.integer(require_word()); }

  /// Of rows of so many numbers, each at least two bytes.
  std::int64_t next_count(std::uint64_t numbers) {
    const std::int64_t count = next_integer();
    const std::uint64_t room = std::min(max_index_count, lexer_.remaining() / (2 * numbers) + 1);
    if (count >= 0 && static_cast<std::uint64_t>(count) <= room) return count;
    lexer_.fail(fmt::format("a count of {}, where the file has room for at most {}; it may be cut short", count, room));
  }

  Index resolve(std::int64_t number) const {
    if (number >= 1 && number <= mesh_.vertex_count()) return static_cast<Index>(number - 1);
    lexer_.fail(fmt::format("vertex {} is out of range; use 1 to {}", number, mesh_.vertex_count()));
  }

  void require(const std::string& message) const {
    if (!message.empty()) lexer_.fail(message);
  }

  const ByteSource& source_;
  TextLexer lexer_;
  Mesh mesh_;
  PolygonBuilder polygons_;
  FaceGroupsBuilder face_groups_;
  VertexReferences references_;
  std::string keyword_;
  std::set<std::string> seen_;       ///< sections that are read
  std::int64_t dimension_ = 0;       ///< 0 before it is read
  std::int64_t face_reference_ = 0;  ///< of the last face
  bool is_in_line_ = false;
};

}  // namespace

Mesh read_medit(const ByteSource& source) {
  return MeditReader(source).read();
}

}  // namespace pliant
