#pragma once
// Vertices of a mesh in the order in which its edges join them, as the two sides of a seam want them.
#include <optional>
#include <span>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

struct Chain {
  std::vector<Index> vertices;  ///< each once
  bool is_closed = false;       ///< the last is joined to the first
};

/// The one chain or loop that edges make of these vertices: edges of the boundary if those do, else any of the mesh. A
/// list whose vertices are joined in the order given keeps that order. None if the vertices make no chain: two pieces,
/// a branch, a vertex alone. Each vertex has to be there once, and in range.
std::optional<Chain> chain_of(const Mesh& mesh, std::span<const Index> vertices);

/// How far along the chain each vertex is [m], from 0 on, by the distances of vertices; one number more: its length, of
/// a loop with the way back to the first vertex.
std::vector<Real> lengths_along(const Chain& chain, const Positions& x);

}  // namespace pliant
