#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pliant/core/atomic_file.h"
#include "pliant/core/error.h"
#include "pliant/mesh/io/obj.h"
#include "pliant/mesh/topology.h"

namespace pliant {

namespace {

/// A name that reads back as one name: group names end at a blank, a word that starts with # is a comment, and a last
/// backslash would join the next line.
std::string readable_name(const FaceGroup& group) {
  std::string name = group.name;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool is_blank = name[i] == ' ' && group.kind == FaceGroupKind::group;
    const bool is_control = static_cast<unsigned char>(name[i]) < ' ';
    const bool is_comment = name[i] == '#' && (i == 0 || name[i - 1] == ' ');
    const bool is_continuation = name[i] == '\\' && i + 1 == name.size();
    if (is_blank || is_control || is_comment || is_continuation) name[i] = '_';
  }
  return name.empty() ? "_" : name;
}

class ObjWriter {
 public:
  ObjWriter(AtomicFile& file, const Mesh& mesh) : file_(file), mesh_(mesh) {}

  void write(const Positions& positions) {
    text_ = "# Pliant\n";
    for (Eigen::Index v = 0; v < positions.rows(); ++v) write_numbers("v", positions.row(v));
    for (Eigen::Index t = 0; t < mesh_.texture_coordinates.rows(); ++t) {
      write_numbers("vt", mesh_.texture_coordinates.row(t));
    }
    if (mesh_.faces.face_count() > 0) {
      write_polygons();
    } else {
      const bool is_solid = mesh_.triangles.empty();
      write_elements("f", is_solid ? boundary_triangles(mesh_.tetrahedra) : mesh_.triangles);
    }
    write_elements("l", mesh_.edges);
    file_.write(text_);
  }

 private:
  template <typename Number>
  void append(Number number) {
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  }

  void end_line() {
    constexpr std::size_t block = 1 << 20;
    text_ += '\n';
    if (text_.size() < block) return;
    file_.write(text_);
    text_.clear();
  }

  template <typename Row>
  void write_numbers(std::string_view keyword, const Row& numbers) {
    text_ += keyword;
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      text_ += ' ';
      append(numbers[i]);
    }
    end_line();
  }

  template <typename Element>
  void write_elements(std::string_view keyword, const std::vector<Element>& elements) {
    for (const Element& element : elements) {
      text_ += keyword;
      for (Index vertex : element) {
        text_ += ' ';
        append(vertex + 1);
      }
      end_line();
    }
  }

  void write_polygons() {
    const std::vector<std::pair<Index, std::size_t>> memberships = sorted_memberships();
    auto next = memberships.begin();
    for (Index face = 0; face < mesh_.faces.face_count(); ++face) {
      std::vector<std::size_t> objects;
      std::vector<std::size_t> groups;
      for (; next != memberships.end() && next->first == face; ++next) {
        const bool is_object = mesh_.groups[next->second].kind == FaceGroupKind::object;
        (is_object ? objects : groups).push_back(next->second);
      }
      switch_groups("o", current_objects_, std::move(objects));
      switch_groups("g", current_groups_, std::move(groups));
      write_polygon(face);
    }
  }

  /// (face, group), by face.
  std::vector<std::pair<Index, std::size_t>> sorted_memberships() const {
    std::vector<std::pair<Index, std::size_t>> memberships;
    for (std::size_t g = 0; g < mesh_.groups.size(); ++g) {
      for (Index face : mesh_.groups[g].faces) memberships.emplace_back(face, g);
    }
    std::ranges::sort(memberships);
    return memberships;
  }

  void switch_groups(std::string_view keyword, std::vector<std::size_t>& current, std::vector<std::size_t> wanted) {
    if (current == wanted) return;
    current = std::move(wanted);
    text_ += keyword;
    for (std::size_t group : current) text_ += ' ' + readable_name(mesh_.groups[group]);
    end_line();
  }

  void write_polygon(Index face) {
    const PolygonFaces& faces = mesh_.faces;
    text_ += 'f';
    const auto first = static_cast<std::size_t>(faces.offsets[static_cast<std::size_t>(face)]);
    const auto last = static_cast<std::size_t>(faces.offsets[static_cast<std::size_t>(face) + 1]);
    for (std::size_t corner = first; corner < last; ++corner) {
      text_ += ' ';
      append(faces.vertices[corner] + 1);
      if (faces.texture_coordinates.empty() || faces.texture_coordinates[corner] < 0) continue;
      text_ += '/';
      append(faces.texture_coordinates[corner] + 1);
    }
    end_line();
  }

  AtomicFile& file_;
  const Mesh& mesh_;
  std::string text_;
  std::vector<std::size_t> current_objects_;
  std::vector<std::size_t> current_groups_;
};

void check_positions(const std::string& name, const Mesh& mesh, const Positions& positions) {
  if (positions.rows() != mesh.vertices.rows()) {
    fail_input(fmt::format("{}: {} positions for a mesh of {} vertices; give one for each", name, positions.rows(),
                           mesh.vertices.rows()));
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (row(positions, v).allFinite()) continue;
    fail_input(fmt::format("{}: the position of vertex {} is not finite; write a state before it diverged", name, v));
  }
}

}  // namespace

void write_obj(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  check_positions(path.string(), mesh, positions);
  AtomicFile file(path);
  ObjWriter(file, mesh).write(positions);
  file.commit();
}

}  // namespace pliant
