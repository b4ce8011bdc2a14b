#pragma once
// The slope of a sheet across each of its edges, as a combination of the vertices around.
//
//        r ─── o₁ ── r          s = ½ (slope of a b o₁ − slope of b a o₂) − Σ γₖ foldₖ, in the direction of o₁
//          ╲  ╱  ╲  ╱           fold: what a triangle's slope toward its apex and its neighbor's toward its own
//           a ──── b                  come to, at the edge itself and at two of the four around; zero on flat sheets
//          ╱  ╲  ╱  ╲           γ: makes s exact on quadratic surfaces; zero where o₁ and o₂ are opposite each other
//        r ─── o₂ ── r
//
// The triangles are unfolded into the plane around each edge. Of the pairs of edges around, the one is taken that needs
// the smallest γ; where none does with γ < 1, or near borders there are not enough, the least γ of all that there are.
#include <array>
#include <vector>

#include "pliant/mesh/topology.h"

namespace pliant {

/// Σ cⱼ xⱼ over the at most eight vertices around an edge; nothing at a free border.
struct EdgeSlope {
  std::array<Index, 8> vertices{};
  std::array<Real, 8> coefficients{};  ///< [1/m]
  std::size_t size = 0;
  Index toward = -1;  ///< the triangle in whose direction it is

  bool is_free() const { return size == 0; }
  void add(Index vertex, Real coefficient);
};

/// A triangulated sheet of which every triangle has an area.
struct Sheet {
  Sheet(const Positions& positions, std::vector<Triangle> triangles_of_sheet);

  const Positions& vertices;
  std::vector<Triangle> triangles;
  EdgeTriangles edges;
  std::vector<std::array<Index, 3>> edges_of;  ///< of each triangle, edge k between its corners k and k + 1
  Index skipped_nonmanifold = 0;               ///< edges with more than two triangles
  Index skipped_degenerate = 0;                ///< edges whose two triangles have the same vertices
};

/// The slope across each edge of the sheet, in the order of `sheet.edges`.
std::vector<EdgeSlope> edge_slopes(const Sheet& sheet);

}  // namespace pliant
