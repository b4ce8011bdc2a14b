#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pliant_io/files/atomic_file.h"
#include "pliant_io/mesh/detail/colors.h"
#include "pliant_io/mesh/detail/mesh_output.h"
#include "pliant_io/mesh/obj.h"

namespace pliant {

namespace {

/// A name that reads back as one name: group names end at a blank, a word that starts with # is a comment, and a last
/// backslash would join the next line.
std::string readable_name(std::string name, FaceGroupKind kind) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool is_blank = name[i] == ' ' && kind == FaceGroupKind::group;
    const bool is_control = static_cast<unsigned char>(name[i]) < ' ';
    const bool is_comment = name[i] == '#' && (i == 0 || name[i - 1] == ' ');
    const bool is_continuation = name[i] == '\\' && i + 1 == name.size();
    if (is_blank || is_control || is_comment || is_continuation) name[i] = '_';
  }
  return name.empty() ? "_" : name;
}

class ObjWriter {
 public:
  ObjWriter(AtomicFile& file, const Mesh& mesh) : text_(file), mesh_(mesh) {}

  void write(const Positions& positions) {
    text_ << "# Pliant\n";
    for (const std::string& library : mesh_.material_libraries) {
      text_ << "mtllib " << readable_name(library, FaceGroupKind::material);
      text_.end_line();
    }
    write_vertices(positions);
    for (Eigen::Index t = 0; t < mesh_.texture_coordinates.rows(); ++t) {
      text_ << "vt " << mesh_.texture_coordinates(t, 0) << " " << mesh_.texture_coordinates(t, 1);
      text_.end_line();
    }
    write_faces();
    for (const auto& [a, b] : mesh_.edges) {
      text_ << "l " << a + 1 << " " << b + 1;
      text_.end_line();
    }
    text_.flush();
  }

 private:
  /// OBJ counts colors from 0 to 1.
  void write_vertices(const Positions& positions) {
    const ColorMaps colors(mesh_);
    const Real full = colors.are_bytes ? 255 : 1;
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
      text_ << "v " << positions(v, 0) << " " << positions(v, 1) << " " << positions(v, 2);
      for (std::size_t k = 0; k < colors.count; ++k) {
        text_ << " " << colors.channels[k]->values[static_cast<std::size_t>(v)] / full;
      }
      text_.end_line();
    }
  }

  void write_faces() {
    const VisibleFaces faces(mesh_);
    const std::vector<std::pair<Index, std::size_t>> memberships = sorted_memberships();
    auto next = memberships.begin();
    for (std::size_t face = 0; face < faces.size(); ++face) {
      std::vector<std::size_t> groups;
      for (; next != memberships.end() && next->first == static_cast<Index>(face); ++next) {
        groups.push_back(next->second);
      }
      if (groups != current_) switch_groups(std::move(groups));
      write_face(faces, face);
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

  void switch_groups(std::vector<std::size_t> wanted) {
    for (const auto& [kind, keyword] : {std::pair{FaceGroupKind::object, "o"}, std::pair{FaceGroupKind::group, "g"},
                                        std::pair{FaceGroupKind::material, "usemtl"}}) {
      const std::string names = names_of(wanted, kind);
      if (names == names_of(current_, kind)) continue;
      text_ << keyword << names;
      text_.end_line();
    }
    current_ = std::move(wanted);
  }

  /// Each with a blank before it.
  std::string names_of(const std::vector<std::size_t>& groups, FaceGroupKind kind) const {
    std::string names;
    for (const std::size_t g : groups) {
      if (mesh_.groups[g].kind == kind) names += ' ' + readable_name(mesh_.groups[g].name, kind);
    }
    return names;
  }

  void write_face(const VisibleFaces& faces, std::size_t face) {
    text_ << "f";
    const auto corners = faces[face];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      text_ << " " << corners[i] + 1;
      if (!faces.has_texture()) continue;
      const Index texture = mesh_.faces.texture_coordinates[faces.first_corner(face) + i];
      if (texture >= 0) text_ << "/" << texture + 1;
    }
    text_.end_line();
  }

  TextOutput text_;
  const Mesh& mesh_;
  std::vector<std::size_t> current_;
};

}  // namespace

void write_obj(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  check_positions(path, mesh, positions);
  AtomicFile file(path);
  ObjWriter(file, mesh).write(positions);
  file.commit();
}

}  // namespace pliant
