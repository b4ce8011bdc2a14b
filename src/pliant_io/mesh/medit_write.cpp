#include <charconv>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/files/atomic_file.h"
#include "pliant_io/mesh/detail/mesh_output.h"
#include "pliant_io/mesh/medit.h"

namespace pliant {

namespace {

/// The number in a name that begins with that kind, as in `faces 3`; 0 for another name.
std::int64_t named_reference(std::string_view name, std::string_view kind) {
  std::int64_t reference = 0;
  if (!name.starts_with(kind) || name.size() <= kind.size() || name[kind.size()] != ' ') return 0;
  name.remove_prefix(kind.size() + 1);
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), reference);
  return error == std::errc() && end == name.data() + name.size() ? reference : 0;
}

/// Hands out references: those in names, and the least positive ones that no name has.
class References {
 public:
  template <class Groups>
  References(const Groups& groups, std::string_view kind) : kind_(kind) {
    for (const auto& group : groups) used_.insert(named_reference(group.name, kind));
  }
  std::int64_t of(std::string_view name) {
    if (const std::int64_t named = named_reference(name, kind_); named != 0) return named;
    while (!used_.insert(next_).second) ++next_;
    return next_;
  }

 private:
  std::string_view kind_;
  std::set<std::int64_t> used_;
  std::int64_t next_ = 1;
};

void refer(std::vector<std::int64_t>& references, std::span<const Index> members, std::int64_t reference) {
  for (const Index member : members) {
    std::int64_t& own = references[static_cast<std::size_t>(member)];
    if (own == 0) own = reference;
  }
}

/// Those of edges and tetrahedra are only known by their vertices, which does not say which elements they were.
bool is_of_elements(const VertexGroup& group) {
  return named_reference(group.name, "edges") != 0 || named_reference(group.name, "tetrahedra") != 0 ||
         named_reference(group.name, "faces") != 0;
}

std::vector<std::int64_t> vertex_references(const Mesh& mesh) {
  std::vector<std::int64_t> references(static_cast<std::size_t>(mesh.vertex_count()), 0);
  References numbers(mesh.vertex_groups, "vertices");
  for (const VertexGroup& group : mesh.vertex_groups) {
    if (!is_of_elements(group)) refer(references, group.vertices, numbers.of(group.name));
  }
  return references;
}

std::vector<std::int64_t> face_references(const Mesh& mesh, std::size_t face_count) {
  std::vector<std::int64_t> references(face_count, 0);
  References numbers(mesh.groups, "faces");
  for (const FaceGroup& group : mesh.groups) refer(references, group.faces, numbers.of(group.name));
  return references;
}

class MeditWriter {
 public:
  MeditWriter(AtomicFile& file, const Mesh& mesh) : text_(file), mesh_(mesh), faces_(mesh) {}

  void write(const Positions& positions) {
    text_ << "MeshVersionFormatted 2\nDimension 3\n\nVertices\n" << mesh_.vertex_count() << "\n";
    const std::vector<std::int64_t> references = vertex_references(mesh_);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      text_ << positions(v, 0) << " " << positions(v, 1) << " " << positions(v, 2) << " "
            << references[static_cast<std::size_t>(v)];
      text_.end_line();
    }
    if (!mesh_.tetrahedra.empty()) {
      begin("Tetrahedra", mesh_.tetrahedra.size());
      for (const Tetrahedron& tetrahedron : mesh_.tetrahedra) write_element(tetrahedron, 0);
    } else if (faces_.size() > 0) {
      write_faces();
    } else if (!mesh_.edges.empty()) {
      begin("Edges", mesh_.edges.size());
      for (const Edge& edge : mesh_.edges) write_element(edge, 0);
    }
    text_ << "\nEnd\n";
    text_.flush();
  }

 private:
  void begin(std::string_view keyword, std::size_t count) { text_ << "\n" << keyword << "\n" << count << "\n"; }

  void write_element(std::span<const Index> corners, std::int64_t reference) {
    for (const Index corner : corners) text_ << corner + 1 << " ";
    text_ << reference;
    text_.end_line();
  }

  /// A file has one section of each; the kind of the first face comes first, so that a file read keeps its order.
  void write_faces() {
    const std::vector<std::int64_t> references = face_references(mesh_, faces_.size());
    if (faces_[0].size() == 4) {
      write_quadrilaterals(references);
      write_triangles(references);
    } else {
      write_triangles(references);
      write_quadrilaterals(references);
    }
  }

  void write_triangles(const std::vector<std::int64_t>& references) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) count += faces_[f].size() == 4 ? 0 : faces_[f].size() - 2;
    if (count == 0) return;
    begin("Triangles", count);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto corners = faces_[f];
      if (corners.size() == 4) continue;
      for (std::size_t i = 2; i < corners.size(); ++i) {
        write_element(Triangle{corners[0], corners[i - 1], corners[i]}, references[f]);
      }
    }
  }

  void write_quadrilaterals(const std::vector<std::int64_t>& references) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) count += faces_[f].size() == 4 ? 1 : 0;
    if (count == 0) return;
    begin("Quadrilaterals", count);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].size() == 4) write_element(faces_[f], references[f]);
    }
  }

  TextOutput text_;
  const Mesh& mesh_;
  VisibleFaces faces_;
};

}  // namespace

void write_medit(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  check_positions(path, mesh, positions);
  AtomicFile file(path);
  MeditWriter(file, mesh).write(positions);
  file.commit();
}

}  // namespace pliant
