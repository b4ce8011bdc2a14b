#pragma once
// The surfaces of all bodies, as they meet each other and themselves: triangles, edges and vertices, and what lies
// around each of them.
#include <cstdint>
#include <span>
#include <vector>

#include "pliant/collision/pairs/joined_vertices.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

/// A body that takes part. Triangles and edges are those of crossings.h: of tetrahedra the boundary.
struct SurfacePart {
  Index first_vertex = 0;  ///< in the simulation
  Index vertex_count = 0;
  std::span<const Triangle> triangles{};  ///< of vertices of the body, from 0 to vertex_count − 1
  std::span<const Edge> edges{};          ///< of the same, that no triangle need have, such as a rope's
  bool meets_itself = true;
  Index group = 0;  ///< from 0; see Surface::ignored
};

struct Surface {
  /// parts: by first vertex. places: of each vertex of the simulation in the solver's order; empty: the same. All
  /// vertices below are in the solver's order, while vertices, edges and triangles are numbered in that of the
  /// simulation, whatever the solver's is. Of an edge or a triangle with two corners the same nothing is taken.
  Surface() = default;
  Surface(std::span<const SurfacePart> parts, Index vertex_count, std::span<const Index> places);

  std::vector<Index> vertices;        ///< that have an edge or a triangle
  std::vector<Index> vertex_in_body;  ///< of each of them its number in its body, for messages
  std::vector<Edge> edges;            ///< those of triangles first, each once
  Index loose_begin = 0;              ///< from here on edges have no triangle
  std::vector<Triangle> triangles;
  std::vector<std::array<Index, 3>> triangle_edges;  ///< edge e goes from corner e to the next
  /// An edge or vertex of several triangles counts in one of them alone, the first, so that what comes near it is not
  /// counted twice. Bit e: edge e of the triangle is its own; bit 3 + i: corner i.
  std::vector<std::uint8_t> owned_by_triangle;
  /// Of loose edge loose_begin + k, bit i: end i is its own, which no triangle and no loose edge before it has.
  std::vector<std::uint8_t> owned_by_edge;
  std::vector<Index> body;   ///< of each vertex of the solver: its part, −1 for none
  std::vector<Index> group;  ///< of each part
  std::vector<char> meets_itself;
  /// Group × group, symmetric, for the groups from 0 to the largest that a part has: not 0 where bodies of the two
  /// ignore each other. Empty at first: none does. Within one body meets_itself alone counts.
  std::vector<char> ignored;
  /// What is sewn together.
  JoinedVertices joined;

  /// Whether pairs of the two parts are of interest.
  bool may_meet(Index part_a, Index part_b) const;

  /// Vertices opposite an edge in its triangles, each once; rising in the order of the simulation.
  std::span<const Index> opposite(Index edge) const;
  /// Vertices that share an edge with a vertex of the solver; rising in the order of the simulation.
  std::span<const Index> neighbors(Index vertex) const;

 private:
  void add_bodies(std::span<const SurfacePart> parts, std::span<const char> is_used);
  void move_to(std::span<const Index> places);

  Index group_count_ = 0;
  std::vector<Index> opposite_begin_, opposite_;
  std::vector<Index> neighbor_begin_, neighbor_;
};

}  // namespace pliant
