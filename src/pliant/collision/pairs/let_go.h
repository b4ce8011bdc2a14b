#pragma once
// Which pairs are let go: a relation of vertices, by which those pairs are meant that have one of two related vertices
// on each side. Where the edge pq passes through the triangle abc, each of p and q is related to each of a, b and c.
// Then all pairs of what lies around these are free, and the curve in which surfaces cross may move on by an edge in
// any direction; whatever crosses then has such vertices again.
#include <span>
#include <vector>

#include "pliant/collision/pairs/pair.h"

namespace pliant {

/// Calls visit(a, b) with each vertex of the one side and each of the other.
template <class Visit>
void for_each_across(const Pair& pair, Visit&& visit) {
  const auto second_side = static_cast<std::size_t>(pair.first_side());
  for (std::size_t i = 0; i < second_side; ++i) {
    for (std::size_t j = second_side; j < 4; ++j) visit(pair.vertices[i], pair.vertices[j]);
  }
}

class LetGo {
 public:
  using Vertices = std::array<Index, 2>;

  void clear();
  /// Vertices from 0 to vertex_count − 1, in any order.
  void set(std::vector<Vertices> pairs, std::size_t vertex_count);
  /// Returns whether one of them is new.
  bool add(std::span<const Vertices> pairs, std::size_t vertex_count);

  bool is_empty() const { return pairs_.empty(); }
  /// Whether a vertex is related to another.
  bool has(Index vertex) const { return !is_empty() && is_related_[at(vertex)] != 0; }
  bool has(Index a, Index b) const;
  bool has(const Pair& pair) const;
  /// Each with the smaller first, in their order.
  std::span<const Vertices> pairs() const { return pairs_; }

 private:
  std::vector<Vertices> pairs_;
  std::vector<char> is_related_;  // of each vertex
};

}  // namespace pliant
