#include "pliant_io/recorder/detail/one_mesh.h"

#include <algorithm>
#include <numeric>

#include "pliant/mesh/topology.h"

namespace pliant {
namespace {

/// Appends faces whose vertices and texture coordinates start at the given ones.
void append_faces(PolygonFaces& all, const PolygonFaces& faces, Index first_vertex, Index first_texture) {
  const auto first_corner = static_cast<Index>(all.vertices.size());
  for (std::size_t f = 1; f < faces.offsets.size(); ++f) all.offsets.push_back(first_corner + faces.offsets[f]);
  for (std::size_t corner = 0; corner < faces.vertices.size(); ++corner) {
    all.vertices.push_back(first_vertex + faces.vertices[corner]);
    const Index texture = faces.texture_coordinates.empty() ? -1 : faces.texture_coordinates[corner];
    all.texture_coordinates.push_back(texture < 0 ? -1 : first_texture + texture);
  }
}

/// Polygons as fans from their first corner.
Mesh objects_of_one_mesh(std::span<const Body> bodies) {
  Mesh all;
  all.faces.offsets.push_back(0);
  if (!bodies.empty()) all.vertices.resize(bodies.back().first_vertex + bodies.back().mesh.vertex_count(), 3);
  for (const Body& body : bodies) {
    all.vertices.middleRows(body.first_vertex, body.mesh.vertex_count()) = body.mesh.vertices;
    const auto first_texture = static_cast<Index>(all.texture_coordinates.rows());
    const Index first_face = all.faces.face_count();
    append_faces(all.faces, visible_faces(body.mesh), body.first_vertex, first_texture);
    all.texture_coordinates.conservativeResize(first_texture + body.mesh.texture_coordinates.rows(), 2);
    all.texture_coordinates.bottomRows(body.mesh.texture_coordinates.rows()) = body.mesh.texture_coordinates;
    for (const Edge& edge : body.mesh.edges) {
      all.edges.push_back({body.first_vertex + edge[0], body.first_vertex + edge[1]});
    }
    FaceGroup object{body.name, FaceGroupKind::object,
                     std::vector<Index>(static_cast<std::size_t>(all.faces.face_count() - first_face))};
    std::iota(object.faces.begin(), object.faces.end(), first_face);
    all.groups.push_back(std::move(object));
    for (FaceGroup group : body.mesh.groups) {
      if (group.kind == FaceGroupKind::object) continue;  // a face is in one object at most, and that is the body
      for (Index& face : group.faces) face += first_face;
      all.groups.push_back(std::move(group));
    }
    for (const std::string& library : body.mesh.material_libraries) {
      if (std::ranges::find(all.material_libraries, library) == all.material_libraries.end()) {
        all.material_libraries.push_back(library);
      }
    }
  }
  if (all.texture_coordinates.rows() == 0) all.faces.texture_coordinates.clear();
  all.triangles = cut_into_triangles(all.faces);
  return all;
}

}  // namespace

std::vector<Triangle> cut_into_triangles(const PolygonFaces& faces) {
  std::vector<Triangle> triangles;
  for (std::size_t face = 1; face < faces.offsets.size(); ++face) {
    const auto first = static_cast<std::size_t>(faces.offsets[face - 1]);
    const auto last = static_cast<std::size_t>(faces.offsets[face]);
    for (std::size_t corner = first + 2; corner < last; ++corner) {
      triangles.push_back({faces.vertices[first], faces.vertices[corner - 1], faces.vertices[corner]});
    }
  }
  return triangles;
}

PolygonFaces visible_faces(const Mesh& mesh) {
  if (mesh.faces.face_count() > 0) return mesh.faces;
  const std::vector<Triangle> triangles = mesh.triangles.empty() ? boundary_triangles(mesh.tetrahedra) : mesh.triangles;
  PolygonFaces faces;
  faces.offsets.push_back(0);
  for (const Triangle& triangle : triangles) {
    faces.vertices.insert(faces.vertices.end(), triangle.begin(), triangle.end());
    faces.offsets.push_back(static_cast<Index>(faces.vertices.size()));
  }
  return faces;
}

Mesh one_mesh(std::span<const Body> bodies) {
  return bodies.size() == 1 ? bodies.front().mesh : objects_of_one_mesh(bodies);
}

Mesh one_mesh_of_run(std::span<const Body> bodies) {
  Mesh mesh = one_mesh(bodies);
  mesh.material_libraries.clear();
  return mesh;
}

}  // namespace pliant
