#pragma once
// Two features of surfaces that may touch, and how far they are apart.
#include <compare>

#include "pliant/collision/pairs/surface.h"

namespace pliant {

enum class PairKind : std::uint8_t { vertex_triangle, edge_edge, vertex_edge };

struct Pair {
  PairKind kind = PairKind::vertex_triangle;
  /// What of the second feature counts here: of a triangle as Surface::owned_by_triangle has it, of a loose edge as
  /// owned_by_edge.
  std::uint8_t owned = 0;
  /// Their numbers in the surface; of two edges the smaller first. With the kind they are the order of pairs.
  std::array<Index, 2> features{};
  /// Vertex and triangle; both edges; vertex and loose edge, whose second end stands twice.
  std::array<Index, 4> vertices{};

  /// How many of the vertices are on the first side.
  int first_side() const { return kind == PairKind::edge_edge ? 2 : 1; }
  friend bool operator==(const Pair& a, const Pair& b) { return a.kind == b.kind && a.features == b.features; }
  friend auto operator<=>(const Pair& a, const Pair& b) {
    const auto order = a.kind <=> b.kind;
    return order != 0 ? order : a.features <=> b.features;
  }
};

}  // namespace pliant
