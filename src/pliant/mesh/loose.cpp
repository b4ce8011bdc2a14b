#include "pliant/mesh/loose.h"

#include <algorithm>

namespace pliant {

std::vector<Index> loose_vertices(const Mesh& mesh) {
  std::vector<bool> has_element(static_cast<std::size_t>(mesh.vertex_count()));
  const auto mark = [&](const auto& vertices) {
    for (const Index vertex : vertices) has_element[static_cast<std::size_t>(vertex)] = true;
  };
  for (const Edge& edge : mesh.edges) mark(edge);
  for (const Triangle& triangle : mesh.triangles) mark(triangle);
  for (const Tetrahedron& tetrahedron : mesh.tetrahedra) mark(tetrahedron);
  mark(mesh.faces.vertices);
  std::vector<Index> loose;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!has_element[static_cast<std::size_t>(v)]) loose.push_back(v);
  }
  return loose;
}

Index drop_loose_vertices(Mesh& mesh) {
  const std::vector<Index> loose = loose_vertices(mesh);
  if (loose.empty()) return 0;
  constexpr Index dropped = -1;
  std::vector<Index> kept;
  std::vector<Index> new_index(static_cast<std::size_t>(mesh.vertex_count()), dropped);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (std::ranges::binary_search(loose, v)) continue;
    new_index[static_cast<std::size_t>(v)] = static_cast<Index>(kept.size());
    kept.push_back(v);
  }
  const auto renumber = [&](auto& vertices) {
    for (Index& vertex : vertices) vertex = new_index[static_cast<std::size_t>(vertex)];
  };
  mesh.vertices = Positions(mesh.vertices(kept, Eigen::all));
  for (Edge& edge : mesh.edges) renumber(edge);
  for (Triangle& triangle : mesh.triangles) renumber(triangle);
  for (Tetrahedron& tetrahedron : mesh.tetrahedra) renumber(tetrahedron);
  renumber(mesh.faces.vertices);
  for (VertexGroup& group : mesh.vertex_groups) {
    renumber(group.vertices);
    std::erase(group.vertices, dropped);
  }
  for (VertexMap& map : mesh.maps) {
    for (std::size_t i = 0; i < kept.size(); ++i) map.values[i] = map.values[static_cast<std::size_t>(kept[i])];
    map.values.resize(kept.size());
  }
  return static_cast<Index>(loose.size());
}

}  // namespace pliant
