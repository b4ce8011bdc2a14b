#pragma once
// The triangles and edges that can cross, their boxes, and which of them meet in a vertex.
#include <array>
#include <span>
#include <vector>

#include "pliant/collision/detail/box_search.h"
#include "pliant/core/types.h"

namespace pliant::collision {

/// What of a triangle a point lies on: one corner, the edge between two, or the interior of three.
struct Feature {
  std::array<Index, 3> vertices{};
  std::size_t count = 0;

  void push(Index vertex) { vertices[count++] = vertex; }
  bool is_part_of(std::span<const Index> corners) const;
};

/// From one vertex to the things that have it, rising.
class VertexLists {
 public:
  /// `items[i]` is a list of vertices, of which i is one of the things.
  template <class Items>
  VertexLists(std::size_t vertex_count, const Items& items);
  std::span<const Index> of(Index vertex) const;

 private:
  std::vector<Index> offsets_;
  std::vector<Index> things_;
};

/// Without triangles that have no area, edges that have no length, and what has a coordinate that is not finite or past
/// coordinate_limit. Triangles keep their numbers; edges are numbered anew, in lexicographic order.
class SurfaceIndex {
 public:
  SurfaceIndex(const Positions& positions, std::span<const Triangle> triangles, std::span<const Edge> edges);

  std::span<const Box> edge_boxes() const { return edge_boxes_; }
  std::span<const Box> triangle_boxes() const { return triangle_boxes_; }

  /// Of a place in triangle_boxes().
  Index triangle_at(Index place) const { return kept_[at(place)]; }
  const Edge& edge(Index edge) const { return edges_[at(edge)]; }
  /// The first two, −1 for none; also of triangles without area.
  const std::array<Index, 2>& triangles_at_edge(Index edge) const { return edge_triangles_[at(edge)]; }
  std::span<const Index> edges_at(Index vertex) const { return edge_lists_.of(vertex); }
  Index other_end(Index edge, Index vertex) const;

  /// The triangles that have the feature, rising.
  std::vector<Index> star(const Feature& feature) const;
  /// The edges of the star that a point of the feature is not on, each once.
  std::vector<Edge> ring(std::span<const Index> star, const Feature& feature) const;

 private:
  std::span<const Triangle> triangles_;
  std::vector<Index> kept_;
  std::vector<Box> triangle_boxes_;
  std::vector<Edge> edges_;
  std::vector<std::array<Index, 2>> edge_triangles_;
  std::vector<Box> edge_boxes_;
  VertexLists triangle_lists_;  ///< of places in kept_
  VertexLists edge_lists_;
};

}  // namespace pliant::collision
