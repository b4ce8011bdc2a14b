#include "pliant/collision/detail/surface_index.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "pliant/collision/detail/fan.h"
#include "pliant/mesh/geometry.h"

namespace pliant::collision {

namespace {

constexpr Index no_triangle = std::numeric_limits<Index>::max();

struct SideOfTriangle {
  Edge edge;  // smaller index first
  Index triangle;
};

Edge in_order(Index a, Index b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

bool are_measurable(const Positions& x, std::span<const Index> vertices) {
  return std::ranges::all_of(vertices, [&](Index v) { return (x.row(v).array().abs() <= coordinate_limit).all(); });
}

Box box_of(const Positions& x, std::span<const Index> vertices) {
  Box box{row(x, vertices.front()), row(x, vertices.front())};
  for (const Index v : vertices) {
    box.low = box.low.cwiseMin(row(x, v));
    box.high = box.high.cwiseMax(row(x, v));
  }
  return box;
}

std::vector<Index> triangles_with_area(const Positions& x, std::span<const Triangle> triangles) {
  std::vector<Index> kept;
  for (Index t = 0; t < count_of(triangles); ++t) {
    const auto& [a, b, c] = triangles[at(t)];
    if (are_measurable(x, triangles[at(t)]) && point_off_plane(row(x, a), row(x, b), row(x, c))) kept.push_back(t);
  }
  return kept;
}

/// Of triangles and edges, by edge; those of triangles first.
std::vector<SideOfTriangle> sorted_sides(const Positions& x, std::span<const Triangle> triangles,
                                         std::span<const Edge> edges) {
  std::vector<SideOfTriangle> sides;
  sides.reserve(3 * triangles.size() + edges.size());
  const auto add = [&](const Edge& edge, Index triangle) {
    if (are_measurable(x, edge) && x.row(edge[0]) != x.row(edge[1])) {
      sides.push_back({in_order(edge[0], edge[1]), triangle});
    }
  };
  for (Index t = 0; t < count_of(triangles); ++t) {
    const Triangle& corners = triangles[at(t)];
    for (std::size_t i = 0; i < 3; ++i) add({corners[i], corners[(i + 1) % 3]}, t);
  }
  for (const Edge& edge : edges) add(edge, no_triangle);
  std::ranges::sort(sides, {}, [](const SideOfTriangle& side) { return std::tuple(side.edge, side.triangle); });
  return sides;
}

std::vector<Triangle> chosen_triangles(std::span<const Triangle> triangles, std::span<const Index> chosen) {
  std::vector<Triangle> result;
  result.reserve(chosen.size());
  for (const Index t : chosen) result.push_back(triangles[at(t)]);
  return result;
}

std::vector<Edge> distinct_edges(std::span<const SideOfTriangle> sides) {
  std::vector<Edge> edges;
  for (const SideOfTriangle& side : sides) {
    if (edges.empty() || edges.back() != side.edge) edges.push_back(side.edge);
  }
  return edges;
}

/// The first two of each edge; `edges` are the distinct ones of `sides`.
std::vector<std::array<Index, 2>> first_triangles(std::span<const SideOfTriangle> sides, std::span<const Edge> edges) {
  std::vector<std::array<Index, 2>> result(edges.size(), {-1, -1});
  std::size_t edge = 0;
  for (const SideOfTriangle& side : sides) {
    if (side.edge != edges[edge]) ++edge;
    auto& [first, second] = result[edge];
    if (side.triangle == no_triangle) continue;
    if (first < 0) {
      first = side.triangle;
    } else if (second < 0) {
      second = side.triangle;
    }
  }
  return result;
}

}  // namespace

bool Feature::is_part_of(std::span<const Index> corners) const {
  return std::all_of(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](Index vertex) { return std::ranges::find(corners, vertex) != corners.end(); });
}

template <class Items>
VertexLists::VertexLists(std::size_t vertex_count, const Items& items) : offsets_(vertex_count + 1, 0) {
  for (const auto& item : items) {
    for (const Index vertex : item) ++offsets_[at(vertex) + 1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) offsets_[v + 1] += offsets_[v];
  things_.resize(at(offsets_.back()));
  std::vector<Index> next(offsets_.begin(), offsets_.end() - 1);
  for (Index i = 0; i < count_of(items); ++i) {
    for (const Index vertex : items[at(i)]) things_[at(next[at(vertex)]++)] = i;
  }
}

std::span<const Index> VertexLists::of(Index vertex) const {
  const Index first = offsets_[at(vertex)];
  return std::span(things_).subspan(at(first), at(offsets_[at(vertex) + 1] - first));
}

SurfaceIndex::SurfaceIndex(const Positions& positions, std::span<const Triangle> triangles, std::span<const Edge> edges)
    : triangles_(triangles),
      kept_(triangles_with_area(positions, triangles)),
      triangle_lists_(static_cast<std::size_t>(positions.rows()), chosen_triangles(triangles, kept_)),
      edge_lists_(0, edges_) {
  {
    const std::vector<SideOfTriangle> sides = sorted_sides(positions, triangles, edges);
    edges_ = distinct_edges(sides);
    edge_triangles_ = first_triangles(sides, edges_);
  }
  edge_lists_ = VertexLists(static_cast<std::size_t>(positions.rows()), edges_);
  for (const Index t : kept_) triangle_boxes_.push_back(box_of(positions, triangles_[at(t)]));
  for (const Edge& edge : edges_) edge_boxes_.push_back(box_of(positions, edge));
}

Index SurfaceIndex::other_end(Index edge, Index vertex) const {
  const Edge& ends = edges_[at(edge)];
  return ends[0] == vertex ? ends[1] : ends[0];
}

std::vector<Index> SurfaceIndex::star(const Feature& feature) const {
  std::vector<Index> result;
  for (const Index place : triangle_lists_.of(feature.vertices[0])) {
    const Index triangle = kept_[at(place)];
    if (feature.is_part_of(triangles_[at(triangle)])) result.push_back(triangle);
  }
  return result;
}

std::vector<Edge> SurfaceIndex::ring(std::span<const Index> star, const Feature& feature) const {
  std::vector<Edge> result;
  for (const Index triangle : star) {
    const Triangle& corners = triangles_[at(triangle)];
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge side = in_order(corners[i], corners[(i + 1) % 3]);
      if (!feature.is_part_of(side)) result.push_back(side);
    }
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace pliant::collision
