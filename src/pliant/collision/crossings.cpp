#include "pliant/collision/crossings.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "pliant/collision/detail/box_search.h"
#include "pliant/collision/detail/fan.h"
#include "pliant/collision/detail/surface_index.h"
#include "pliant/collision/exact_orientation.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/topology.h"

namespace pliant {

namespace {

using collision::Feature;
using collision::SurfaceIndex;

/// Which sides of a triangle the signs say that a point is on: side i joins corners i and i + 1.
Feature feature_of(const Triangle& triangle, const std::array<int, 3>& signs) {
  Feature feature;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    // A corner lies on two sides and is opposite the third, the one after it.
    if (signs[(corner + 1) % 3] != 0) feature.push(triangle[corner]);
  }
  return feature;
}

bool all_of(const std::array<int, 3>& signs, int allowed) {
  return std::ranges::all_of(signs, [&](int sign) { return sign == 0 || sign == allowed; });
}

/// The point of the edge where the plane of the triangle is.
Vec3 meeting_point(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a).stableNormalized();
  const Real from = std::abs(normal.dot(p - a));
  const Real to = std::abs(normal.dot(q - a));
  const Real share = from + to > 0 ? from / (from + to) : 0.5;
  return p + share * (q - p);
}

class CrossingSearch {
 public:
  CrossingSearch(const CrossingInput& input, const std::function<void(const Crossing&)>& visit)
      : x_(input.positions), triangles_(input.triangles), surface_(x_, input.triangles, input.edges), visit_(visit) {}

  bool run(std::int64_t most_effort) {
    return collision::visit_overlaps(surface_.edge_boxes(), surface_.triangle_boxes(), most_effort,
                                     [&](Index edge, Index place) { examine(edge, place); });
  }

 private:
  Vec3 at_vertex(Index vertex) const { return row(x_, vertex); }

  bool has(Index triangle, Index vertex) const {
    return std::ranges::find(triangles_[at(triangle)], vertex) != triangles_[at(triangle)].end();
  }

  int side_of_triangle(Index triangle, Index vertex) const {
    const auto& [a, b, c] = triangles_[at(triangle)];
    return orientation(at_vertex(a), at_vertex(b), at_vertex(c), at_vertex(vertex));
  }

  /// `place` is one in the list of triangle boxes.
  void examine(Index edge, Index place) {
    const Index triangle = surface_.triangle_at(place);
    const collision::Box& box = surface_.triangle_boxes()[at(place)];
    const auto [p, q] = surface_.edge(edge);
    const bool has_p = has(triangle, p);
    const bool has_q = has(triangle, q);
    // Each vertex is looked at once, with the first of its edges.
    const bool asks_p = !has_p && surface_.edges_at(p).front() == edge && box.contains(at_vertex(p));
    const bool asks_q = !has_q && surface_.edges_at(q).front() == edge && box.contains(at_vertex(q));
    if ((has_p || has_q) && !asks_p && !asks_q) return;
    const int side_p = has_p ? 0 : side_of_triangle(triangle, p);
    const int side_q = has_q ? 0 : side_of_triangle(triangle, q);
    if (side_p * side_q < 0) return examine_passage(edge, triangle);
    if (asks_p && side_p == 0) examine_vertex(p, triangle);
    if (asks_q && side_q == 0) examine_vertex(q, triangle);
  }

  /// The ends of the edge lie on different sides of the triangle's plane.
  void examine_passage(Index edge, Index triangle) {
    const auto [p, q] = surface_.edge(edge);
    const Vec3 x_p = at_vertex(p);
    const Vec3 x_q = at_vertex(q);
    const auto& [a, b, c] = triangles_[at(triangle)];
    const std::array<Vec3, 3> x = {at_vertex(a), at_vertex(b), at_vertex(c)};
    std::array<int, 3> signs{};
    for (std::size_t i = 0; i < 3; ++i) signs[i] = orientation(x_p, x_q, x[i], x[(i + 1) % 3]);
    if (!all_of(signs, 1) && !all_of(signs, -1)) return;
    const Feature feature = feature_of(triangles_[at(triangle)], signs);
    if (feature.count == 1) return examine_passage_at_vertex(edge, triangle, feature);
    if (feature.count == 2 && !is_separated_at_edge(edge, triangle, feature)) return;
    report(edge, triangle, meeting_point(x_p, x_q, x[0], x[1], x[2]));
  }

  Index opposite_vertex(Index triangle, const Feature& side) const {
    const Triangle& corners = triangles_[at(triangle)];
    const auto is_opposite = [&](Index corner) { return corner != side.vertices[0] && corner != side.vertices[1]; };
    return *std::ranges::find_if(corners, is_opposite);
  }

  /// Whether the triangles at the edge of `feature` lie on both sides of the plane that it spans with the other edge,
  /// and `triangle` is the first of them that does not lie in it.
  bool is_separated_at_edge(Index edge, Index triangle, const Feature& feature) {
    const Vec3 x_p = at_vertex(surface_.edge(edge)[0]);
    const Vec3 x_a = at_vertex(feature.vertices[0]);
    const Vec3 x_b = at_vertex(feature.vertices[1]);
    bool has_above = false;
    bool has_below = false;
    Index first = -1;
    for (const Index other : surface_.star(feature)) {
      const int side = orientation(x_a, x_b, x_p, at_vertex(opposite_vertex(other, feature)));
      if (side != 0 && first < 0) first = other;
      has_above = has_above || side > 0;
      has_below = has_below || side < 0;
    }
    return has_above && has_below && first == triangle;
  }

  /// The edge passes through a vertex of the triangle: it is reported with the first of that vertex' triangles whose
  /// plane it passes through.
  void examine_passage_at_vertex(Index edge, Index triangle, const Feature& feature) {
    const Edge ends = surface_.edge(edge);
    const std::vector<Index> star = surface_.star(feature);
    const auto is_passed = [&](Index other) {
      if (has(other, ends[0]) || has(other, ends[1])) return false;
      return side_of_triangle(other, ends[0]) * side_of_triangle(other, ends[1]) < 0;
    };
    if (*std::ranges::find_if(star, is_passed) != triangle) return;
    const Vec3 x = at_vertex(feature.vertices[0]);
    const std::vector<int> sides =
        collision::sides_of_fan(x, fan(star, feature), {at_vertex(ends[0]), at_vertex(ends[1])});
    if (sides[0] * sides[1] < 0) report(edge, triangle, x);
  }

  /// A vertex in the plane of a triangle that it does not belong to.
  void examine_vertex(Index vertex, Index triangle) {
    const auto& [a, b, c] = triangles_[at(triangle)];
    const std::array<Vec3, 3> x = {at_vertex(a), at_vertex(b), at_vertex(c)};
    const Vec3 x_v = at_vertex(vertex);
    const Vec3 apart = collision::point_off_plane(x[0], x[1], x[2]).value();  // or the triangle would not be here
    const int inside = orientation(x[0], x[1], x[2], apart);
    std::array<int, 3> signs{};
    for (std::size_t i = 0; i < 3; ++i) signs[i] = orientation(x[i], x[(i + 1) % 3], x_v, apart);
    if (!all_of(signs, inside)) return;
    const Feature feature = feature_of(triangles_[at(triangle)], signs);
    const std::vector<Index> star = surface_.star(feature);
    if (star.front() != triangle) return;
    const std::span<const Index> edges = surface_.edges_at(vertex);
    std::vector<Vec3> neighbors;
    for (const Index edge : edges) neighbors.push_back(at_vertex(surface_.other_end(edge, vertex)));
    const std::vector<int> sides = collision::sides_of_fan(x_v, fan(star, feature), neighbors);
    const auto [low, high] = std::ranges::minmax_element(sides);
    if (*low * *high >= 0) return;
    const auto leaving = std::ranges::find_if(sides, [](int side) { return side != 0; });
    report(edges[static_cast<std::size_t>(leaving - sides.begin())], triangle, x_v);
  }

  /// The lines that the triangles of the star do not share, as pairs of points.
  collision::FanRing fan(const std::vector<Index>& star, const Feature& feature) const {
    collision::FanRing ring;
    for (const Edge& side : surface_.ring(star, feature)) ring.push_back({at_vertex(side[0]), at_vertex(side[1])});
    return ring;
  }

  void report(Index edge, Index triangle, const Vec3& point) const {
    visit_({surface_.edge(edge), surface_.triangles_at_edge(edge), triangle, point});
  }

  const Positions& x_;
  std::span<const Triangle> triangles_;
  SurfaceIndex surface_;
  const std::function<void(const Crossing&)>& visit_;
};

auto place_in_list(const Crossing& crossing) {
  return std::tuple(crossing.edge, crossing.triangle);
}

bool comes_before(const Crossing& a, const Crossing& b) {
  return place_in_list(a) < place_in_list(b);
}

}  // namespace

bool visit_crossings(const CrossingInput& input, const std::function<void(const Crossing&)>& visit) {
  return CrossingSearch(input, visit).run(input.most_effort);
}

Crossings find_crossings(const CrossingInput& input, std::size_t most) {
  Crossings result;
  std::vector<Crossing>& heap = result.first;  // the last one of the list in front
  result.is_complete = visit_crossings(input, [&](const Crossing& crossing) {
    ++result.count;
    if (heap.size() >= most && (most == 0 || !comes_before(crossing, heap.front()))) return;
    heap.push_back(crossing);
    std::ranges::push_heap(heap, comes_before);
    if (heap.size() <= most) return;
    std::ranges::pop_heap(heap, comes_before);
    heap.pop_back();
  });
  std::ranges::sort(heap, comes_before);
  return result;
}

std::vector<Triangle> surface_triangles(const Mesh& mesh) {
  return mesh.triangles.empty() ? boundary_triangles(mesh.tetrahedra) : mesh.triangles;
}

}  // namespace pliant
