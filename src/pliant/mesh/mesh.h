#pragma once
// The rest shape of one body: vertices and the elements between them. Plain data; functions on it stand in topology.h,
// geometry.h, mass.h, shapes.h and io/.
#include <string>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Polygons as the user's file has them, kept for writing back. Face f owns corners [offsets[f], offsets[f + 1]).
struct PolygonFaces {
  std::vector<Index> offsets;              ///< faces + 1 entries, or empty when the mesh did not come from polygons
  std::vector<Index> vertices;             ///< vertex of each corner
  std::vector<Index> texture_coordinates;  ///< row of Mesh::texture_coordinates of each corner, -1 for none; or empty

  Index face_count() const { return offsets.empty() ? 0 : static_cast<Index>(offsets.size()) - 1; }
};

/// What named a part of the mesh. A face is in at most one object, has at most one material, and is in any number of
/// groups.
enum class FaceGroupKind { group, object, material };

/// A named part of the mesh (OBJ `g`, `o` or `usemtl`): indices into PolygonFaces.
struct FaceGroup {
  std::string name;
  FaceGroupKind kind = FaceGroupKind::group;
  std::vector<Index> faces;
};

/// A named set of vertices, whatever elements they have.
struct VertexGroup {
  std::string name;
  std::vector<Index> vertices;
};

/// A named number for each vertex: a scalar vertex property of a PLY file, or `red`, `green`, `blue` of colors.
struct VertexMap {
  std::string name;
  std::vector<Real> values;  ///< one for each vertex, finite
};

/// How a lattice of tetrahedra carries a surface, see lattice.h. The first vertices of the mesh are the surface's.
struct Embedding {
  std::vector<Index> tetrahedra;             ///< that surface vertex i is in
  std::vector<std::array<Real, 4>> weights;  ///< of its corners, from 0 to 1, summing to 1
  std::vector<Real> filled;                  ///< share of each tetrahedron that is inside the surface, above 0 to 1
  Real spacing = 0;                          ///< side of the lattice's cubes [m]
  std::vector<Real> volumes;  ///< of each vertex of the mesh [m³], > 0, in all what the surface encloses

  bool is_empty() const { return filled.empty(); }
  Index carried_count() const { return static_cast<Index>(tetrahedra.size()); }
};

/// A mesh keeps the order and the count of the user's vertices; vertices without an element are allowed.
struct Mesh {
  Positions vertices;                   ///< rest positions, m × 3 [m]
  std::vector<Edge> edges;              ///< elements that are only edges (chains, OBJ `l`), not the edges of triangles
  std::vector<Triangle> triangles;      ///< polygons are cut as a fan from their first vertex
  std::vector<Tetrahedron> tetrahedra;  ///< positively oriented: det(x1 − x0, x2 − x0, x3 − x0) > 0
  PolygonFaces faces;                   ///< as read, see PolygonFaces
  Eigen::Matrix<Real, Eigen::Dynamic, 2, Eigen::RowMajor> texture_coordinates;  ///< rows referred to by `faces`
  std::vector<FaceGroup> groups;
  std::vector<VertexGroup> vertex_groups;       ///< names differ
  std::vector<std::string> material_libraries;  ///< files that define the materials (OBJ `mtllib`), kept unread
  std::vector<VertexMap> maps;                  ///< names differ
  Embedding embedding;                          ///< empty unless tetrahedra carry the triangles
  Index collapsed_face_count = 0;  ///< facets of an STL file left out, two of their corners being one vertex

  Index vertex_count() const { return static_cast<Index>(vertices.rows()); }
};

}  // namespace pliant
