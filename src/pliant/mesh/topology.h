#pragma once
// What is connected to what. Every function asks for vertex indices in range (check_mesh in geometry.h) and nothing
// else: non-manifold edges, meshes without a consistent orientation and several components are all welcome.
#include <array>
#include <span>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// All edges of triangles, of tetrahedra and of Mesh::edges, each once: smaller index first, in lexicographic order.
std::vector<Edge> unique_edges(const Mesh& mesh);

/// The triangles at each edge. One triangle: a boundary edge; two: an interior one; more: a non-manifold one.
struct EdgeTriangles {
  std::vector<Edge> edges;       ///< edges of the triangles only, as unique_edges orders them
  std::vector<Index> offsets;    ///< edges + 1 entries: edge e has triangles [offsets[e], offsets[e + 1])
  std::vector<Index> triangles;  ///< ascending for each edge

  Index edge_count() const { return static_cast<Index>(edges.size()); }
  std::span<const Index> triangles_of(Index edge) const;
};
EdgeTriangles edge_triangles(const Mesh& mesh);

/// Edges with exactly one triangle, in lexicographic order, smaller index first.
std::vector<Edge> boundary_edges(const Mesh& mesh);

/// Closed walks along boundary edges, each the vertices in the order of the walk: from each vertex along edges not yet
/// walked, lowest first, until there is none to go on with. By their first vertex, which is their lowest.
std::vector<std::vector<Index>> boundary_loops(std::vector<Edge> boundary_edges);

/// The surface of a tetrahedral mesh: the faces that only one tetrahedron has, oriented outward (counter-clockwise seen
/// from outside), by tetrahedron in ascending order.
std::vector<Triangle> boundary_triangles(std::span<const Tetrahedron> tetrahedra);

/// Vertices on the boundary, ascending: of the triangles the ends of boundary edges; without triangles, the vertices of
/// the tetrahedra's surface; without those as well, the vertices with exactly one edge.
std::vector<Index> boundary_vertices(const Mesh& mesh);

/// The neighbors of each interior vertex in cyclic order:
///
///            n1 ---- n0           consecutive neighbors (cyclically) span a triangle with the center;
///           /  \    /  \          n0 → n1 is the direction in which the center's first triangle (the one of the
///         n2 -- center - n5       smallest index) runs. Nothing asks the other triangles to agree, so a Moebius
///           \  /    \  /          strip has rings, too.
///            n3 ---- n4
///
/// Every other vertex is counted under exactly one of the reasons.
struct VertexRings {
  std::vector<Index> centers;          ///< the interior vertices, ascending
  std::vector<Index> offsets;          ///< centers + 1 entries: ring r has neighbors [offsets[r], offsets[r + 1])
  std::vector<Index> neighbors;        ///< at least three for each ring
  Index boundary_vertex_count = 0;     ///< the triangles form one open fan
  Index nonmanifold_vertex_count = 0;  ///< they form neither one closed nor one open fan
  Index isolated_vertex_count = 0;     ///< no triangle at all

  Index ring_count() const { return static_cast<Index>(centers.size()); }
  std::span<const Index> ring(Index r) const;
};
VertexRings vertex_rings(const Mesh& mesh);

/// One interior edge and what it folds.
///
///            x1            x0 x1 x2 is the first triangle (of the smaller index) in its own orientation;
///          / |  \          x3 is the vertex of the second triangle opposite the edge.
///        x2  |   x3
///          \ |  /
///            x0
using Hinge = std::array<Index, 4>;

/// The hinges of a mesh in the order of their edges. Every other edge is counted under exactly one of the reasons.
struct Hinges {
  std::vector<Hinge> stencils;
  Index boundary_edge_count = 0;     ///< one triangle
  Index nonmanifold_edge_count = 0;  ///< more than two triangles
  Index degenerate_edge_count = 0;   ///< two triangles with the same three vertices: x2 = x3
};
Hinges hinges(const Mesh& mesh);

/// The connected component of each vertex, through elements of every kind. Components are numbered 0, 1, ... by their
/// smallest vertex; a vertex without elements is a component of its own.
std::vector<Index> components(const Mesh& mesh);

}  // namespace pliant
