#include "pliant/collision/pairs/surface.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace pliant {
namespace {

using IndexPair = std::array<Index, 2>;

Edge rising_edge(Index a, Index b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

void sort_and_drop_doubled(std::vector<IndexPair>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// In the numbers of the simulation.
std::vector<Triangle> triangles_of_parts(std::span<const SurfacePart> parts) {
  std::vector<Triangle> result;
  for (const SurfacePart& part : parts) {
    for (const auto& [a, b, c] : part.triangles) {
      if (a == b || b == c || c == a) continue;
      result.push_back({part.first_vertex + a, part.first_vertex + b, part.first_vertex + c});
    }
  }
  return result;
}

std::vector<Edge> edges_of_triangles(std::span<const Triangle> triangles) {
  std::vector<Edge> result;
  result.reserve(3 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    result.push_back(rising_edge(a, b)), result.push_back(rising_edge(b, c)), result.push_back(rising_edge(c, a));
  }
  sort_and_drop_doubled(result);
  return result;
}

/// `of_triangles` is sorted.
std::vector<Edge> edges_without_triangles(std::span<const SurfacePart> parts, std::span<const Edge> of_triangles) {
  std::vector<Edge> result;
  for (const SurfacePart& part : parts) {
    for (const auto& [a, b] : part.edges) {
      const Edge edge = rising_edge(part.first_vertex + a, part.first_vertex + b);
      if (a != b && !std::ranges::binary_search(of_triangles, edge)) result.push_back(edge);
    }
  }
  sort_and_drop_doubled(result);
  return result;
}

std::vector<std::array<Index, 3>> edges_by_triangle(std::span<const Triangle> triangles, std::span<const Edge> edges) {
  std::vector<std::array<Index, 3>> result(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      const Edge edge = rising_edge(triangles[t][e], triangles[t][(e + 1) % 3]);
      result[t][e] = static_cast<Index>(std::ranges::lower_bound(edges, edge) - edges.begin());
    }
  }
  return result;
}

/// Returns whether the thing has no owner yet; it has one from then on.
bool take(std::vector<char>& taken, Index thing) {
  return taken[at(thing)] == 0 && (taken[at(thing)] = 1) != 0;
}

/// Lists side by side, of (list, number) pairs: list i is numbers[begin[i], begin[i + 1]), rising.
std::pair<std::vector<Index>, std::vector<Index>> lists_of(std::vector<IndexPair> entries, std::size_t count) {
  sort_and_drop_doubled(entries);
  std::vector<Index> begin(count + 1, 0), numbers;
  numbers.reserve(entries.size());
  for (const auto& [list, number] : entries) {
    ++begin[at(list) + 1];
    numbers.push_back(number);
  }
  for (std::size_t i = 0; i < count; ++i) begin[i + 1] += begin[i];
  return {std::move(begin), std::move(numbers)};
}

std::span<const Index> list_of(const std::vector<Index>& begin, const std::vector<Index>& numbers, Index i) {
  return std::span(numbers).subspan(at(begin[at(i)]), at(begin[at(i) + 1] - begin[at(i)]));
}

std::vector<IndexPair> opposite_vertices(std::span<const Triangle> triangles,
                                         std::span<const std::array<Index, 3>> triangle_edges) {
  std::vector<IndexPair> result;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) result.push_back({triangle_edges[t][e], triangles[t][(e + 2) % 3]});
  }
  return result;
}

std::vector<IndexPair> ends_from_each_end(std::span<const Edge> edges) {
  std::vector<IndexPair> result;
  for (const auto& [a, b] : edges) result.push_back({a, b}), result.push_back({b, a});
  return result;
}

}  // namespace

Surface::Surface(std::span<const SurfacePart> parts, Index vertex_count, std::span<const Index> places) {
  triangles = triangles_of_parts(parts);
  edges = edges_of_triangles(triangles);
  loose_begin = count_of(edges);
  const std::vector<Edge> loose = edges_without_triangles(parts, edges);
  triangle_edges = edges_by_triangle(triangles, edges);
  edges.insert(edges.end(), loose.begin(), loose.end());

  std::vector<char> has_owner(at(vertex_count), 0), edge_has_owner(edges.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    unsigned owned = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (take(edge_has_owner, triangle_edges[t][i])) owned |= 1U << i;
      if (take(has_owner, triangles[t][i])) owned |= 8U << i;
    }
    owned_by_triangle.push_back(static_cast<std::uint8_t>(owned));
  }
  for (const auto& [a, b] : loose) {
    const unsigned first = take(has_owner, a) ? 1U : 0U;
    const unsigned second = take(has_owner, b) ? 2U : 0U;
    owned_by_edge.push_back(static_cast<std::uint8_t>(first | second));
  }

  std::tie(opposite_begin_, opposite_) = lists_of(opposite_vertices(triangles, triangle_edges), edges.size());
  std::tie(neighbor_begin_, neighbor_) = lists_of(ends_from_each_end(edges), at(vertex_count));
  add_bodies(parts, has_owner);
  if (!places.empty()) move_to(places);
}

/// Vertices are still those of the simulation.
void Surface::add_bodies(std::span<const SurfacePart> parts, std::span<const char> is_used) {
  body.assign(is_used.size(), -1);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    group.push_back(parts[p].group);
    group_count_ = std::max(group_count_, parts[p].group + 1);
    meets_itself.push_back(parts[p].meets_itself ? 1 : 0);
    for (Index v = 0; v < parts[p].vertex_count; ++v) {
      const Index vertex = parts[p].first_vertex + v;
      body[at(vertex)] = static_cast<Index>(p);
      if (is_used[at(vertex)] != 0) vertices.push_back(vertex), vertex_in_body.push_back(v);
    }
  }
}

/// From the simulation's order of vertices to the solver's.
void Surface::move_to(std::span<const Index> places) {
  const auto place = [&](Index vertex) { return places[at(vertex)]; };
  for (Triangle& corners : triangles) std::ranges::transform(corners, corners.begin(), place);
  for (Edge& ends : edges) std::ranges::transform(ends, ends.begin(), place);
  for (std::vector<Index>* list : {&vertices, &opposite_, &neighbor_}) {
    std::ranges::transform(*list, list->begin(), place);
  }
  const std::vector<Index> old_body = body, old_begin = neighbor_begin_, old_neighbor = neighbor_;
  std::ranges::fill(neighbor_begin_, 0);
  for (std::size_t v = 0; v < places.size(); ++v) {
    body[at(places[v])] = old_body[v];
    neighbor_begin_[at(places[v]) + 1] = old_begin[v + 1] - old_begin[v];
  }
  for (std::size_t v = 0; v < places.size(); ++v) neighbor_begin_[v + 1] += neighbor_begin_[v];
  for (std::size_t v = 0; v < places.size(); ++v) {
    std::ranges::copy(list_of(old_begin, old_neighbor, static_cast<Index>(v)),
                      neighbor_.begin() + neighbor_begin_[at(places[v])]);
  }
}

bool Surface::may_meet(Index part_a, Index part_b) const {
  if (part_a == part_b) return meets_itself[at(part_a)] != 0;
  if (ignored.empty()) return true;
  return ignored[at(group[at(part_a)]) * at(group_count_) + at(group[at(part_b)])] == 0;
}

std::span<const Index> Surface::opposite(Index edge) const {
  return list_of(opposite_begin_, opposite_, edge);
}

std::span<const Index> Surface::neighbors(Index vertex) const {
  return list_of(neighbor_begin_, neighbor_, vertex);
}

}  // namespace pliant
