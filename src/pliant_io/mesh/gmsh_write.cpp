#include <span>
#include <string_view>

#include "pliant_io/files/atomic_file.h"
#include "pliant_io/mesh/detail/mesh_output.h"
#include "pliant_io/mesh/gmsh.h"

namespace pliant {

namespace {

/// Of a type, without tags, numbered on.
void write_element(TextOutput& text, std::size_t& number, int type, std::span<const Index> corners) {
  text << ++number << " " << type << " 0";
  for (const Index corner : corners) text << " " << corner + 1;
  text.end_line();
}

void write_polygon(TextOutput& text, std::size_t& number, std::span<const Index> corners) {
  constexpr int triangle = 2;
  constexpr int quadrangle = 3;
  if (corners.size() <= 4) return write_element(text, number, corners.size() == 3 ? triangle : quadrangle, corners);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    write_element(text, number, triangle, Triangle{corners[0], corners[i - 1], corners[i]});
  }
}

std::size_t element_count(const Mesh& mesh, const VisibleFaces& faces) {
  if (!mesh.tetrahedra.empty()) return mesh.tetrahedra.size();
  std::size_t count = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) count += faces[f].size() <= 4 ? 1 : faces[f].size() - 2;
  return count > 0 ? count : mesh.edges.size();
}

void write_elements(TextOutput& text, const Mesh& mesh) {
  const VisibleFaces faces(mesh);
  std::size_t number = 0;
  text << "$Elements\n" << element_count(mesh, faces) << "\n";
  if (!mesh.tetrahedra.empty()) {
    for (const Tetrahedron& tetrahedron : mesh.tetrahedra) write_element(text, number, 4, tetrahedron);
  } else if (faces.size() > 0) {
    for (std::size_t f = 0; f < faces.size(); ++f) write_polygon(text, number, faces[f]);
  } else {
    for (const Edge& edge : mesh.edges) write_element(text, number, 1, edge);
  }
  text << "$EndElements\n";
}

}  // namespace

void write_gmsh(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  check_positions(path, mesh, positions);
  AtomicFile file(path);
  TextOutput text(file);
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << mesh.vertex_count() << "\n";
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    text << v + 1 << " " << positions(v, 0) << " " << positions(v, 1) << " " << positions(v, 2);
    text.end_line();
  }
  text << "$EndNodes\n";
  write_elements(text, mesh);
  text.flush();
  file.commit();
}

}  // namespace pliant
