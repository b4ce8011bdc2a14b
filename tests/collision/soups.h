#pragma once
// Random triangles, small sheets and ropes that do not cross, all their pairs, and whether a pair meets on its way.
#include <algorithm>
#include <memory>

#include "../core/random.h"
#include "pliant/collision/crossings.h"
#include "pliant/collision/pairs/gap.h"

namespace pliant_tests {

/// All pairs of features that share no vertex, in order.
inline std::vector<pliant::Pair> all_pairs(const pliant::Surface& surface) {
  using namespace pliant;
  std::vector<Pair> pairs;
  for (const Index v : surface.vertices) {
    for (Index t = 0; t < count_of(surface.triangles); ++t) {
      const auto& [a, b, c] = surface.triangles[at(t)];
      if (v == a || v == b || v == c) continue;
      pairs.push_back({PairKind::vertex_triangle, surface.owned_by_triangle[at(t)], {v, t}, {v, a, b, c}});
    }
    for (Index e = surface.loose_begin; e < count_of(surface.edges); ++e) {
      const auto& [a, b] = surface.edges[at(e)];
      if (v != a && v != b) pairs.push_back({PairKind::vertex_edge, 0, {v, e}, {v, a, b, b}});
    }
  }
  for (Index e = 0; e < count_of(surface.edges); ++e) {
    for (Index f = e + 1; f < count_of(surface.edges); ++f) {
      const auto& [a, b] = surface.edges[at(e)];
      const auto& [c, d] = surface.edges[at(f)];
      if (a == c || a == d || b == c || b == d) continue;
      pairs.push_back({PairKind::edge_edge, 0, {e, f}, {a, b, c, d}});
    }
  }
  std::ranges::sort(pairs);
  return pairs;
}

/// A body with its pairs.
struct Soup {
  pliant::Positions q;
  std::vector<pliant::Triangle> triangles;
  std::vector<pliant::Edge> edges;
  pliant::Surface surface;
  std::vector<pliant::Pair> pairs;
  std::vector<pliant::Real> radii;

  void finish(pliant::Real radius) {
    const pliant::SurfacePart part{
        .vertex_count = static_cast<pliant::Index>(q.rows()), .triangles = triangles, .edges = edges};
    surface = pliant::Surface({&part, 1}, part.vertex_count, {});
    pairs = all_pairs(surface);
    radii.assign(static_cast<std::size_t>(q.rows()), radius);
  }
  bool is_crossing(const pliant::Positions& x) const { return pliant::find_crossings({x, triangles, edges}).count > 0; }
  /// Adds the points unless something then crosses.
  void add(const pliant::Positions& points, const std::vector<pliant::Triangle>& of_points, bool is_rope) {
    const Soup before = *this;
    const auto first = static_cast<pliant::Index>(q.rows());
    q.conservativeResize(first + points.rows(), 3);
    q.bottomRows(points.rows()) = points;
    for (const auto& [a, b, c] : of_points) triangles.push_back({first + a, first + b, first + c});
    for (pliant::Index i = 1; is_rope && i < points.rows(); ++i) edges.push_back({first + i - 1, first + i});
    if (is_crossing(q)) *this = before;
  }
};

/// In a cube of about 1 m.
inline Soup random_soup(Random& random, int pieces) {
  using namespace pliant;
  Soup soup;
  soup.q.resize(0, 3);
  for (int i = 0; i < pieces; ++i) {
    const Vec3 place = random.vector(0.4);
    Positions points;
    std::vector<Triangle> triangles;
    if (i % 4 == 0) {  // a small sheet
      points = random.positions(9, 0.05);
      const Mat3 rotation = random.rotation();
      for (Index k = 0; k < 9; ++k) {
        points.row(k) += (rotation * Vec3(0.2 * (k % 3 - 1), 0.2 * static_cast<Real>(k / 3 - 1), 0)).transpose();
      }
      for (const Index k : {0, 1, 3, 4}) {
        triangles.push_back({k, k + 1, k + 4});
        triangles.push_back({k, k + 4, k + 3});
      }
    } else if (i % 4 == 1) {  // a rope
      points = random.positions(5, 0.08);
      const Vec3 along = 0.12 * random.unit_vector();
      for (Index k = 0; k < 5; ++k) points.row(k) += (k - 2) * along.transpose();
    } else {
      points = random.positions(3, 0.25);
      triangles = {{0, 1, 2}};
    }
    points.rowwise() += place.transpose();
    soup.add(points, triangles, i % 4 == 1);
  }
  return soup;
}

/// Whether two edges, or a vertex and a triangle, meet while their vertices go straight from q to y: at the times when
/// all four lie in one plane, roots of a cubic, their distance says so.
inline bool meets_on_way(const pliant::Positions& q, const pliant::Positions& y, const pliant::Pair& pair,
                         pliant::Real tolerance) {
  using namespace pliant;
  Positions x(4, 3);
  Pair here = pair;
  here.vertices = {0, 1, 2, 3};
  const auto move = [&](Real s) {
    for (Index j = 0; j < 4; ++j) {
      const Index v = pair.vertices[at(j)];
      x.row(j) = q.row(v) + s * (y.row(v) - q.row(v));
    }
  };
  const auto volume = [&](Real s) {
    move(s);
    return (row(x, 1) - row(x, 0)).dot((row(x, 2) - row(x, 0)).cross(row(x, 3) - row(x, 0)));
  };
  // c0 + c1 s + c2 s² + c3 s³ through four of its values
  const std::array<Real, 4> p{volume(0), volume(1.0 / 3), volume(2.0 / 3), volume(1)};
  const Real c1 = (-11 * p[0] + 18 * p[1] - 9 * p[2] + 2 * p[3]) / 2;
  const Real c2 = 9 * (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3]) / 2;
  const Real c3 = 9 * (-p[0] + 3 * p[1] - 3 * p[2] + p[3]) / 2;
  std::vector<Real> ends{0, 1};
  const Real below_root = c2 * c2 - 3 * c1 * c3;
  for (const Real sign : {-1, 1}) {
    const Real turn = (-c2 + sign * std::sqrt(std::max(Real{0}, below_root))) / (3 * c3);
    if (turn > 0 && turn < 1) ends.push_back(turn);
  }
  std::ranges::sort(ends);
  for (std::size_t i = 1; i < ends.size(); ++i) {
    Real low = ends[i - 1], high = ends[i];
    const bool is_positive = volume(low) > 0;
    if ((volume(high) > 0) == is_positive) continue;
    for (int k = 0; k < 60; ++k) {
      const Real middle = (low + high) / 2;
      ((volume(middle) > 0) == is_positive ? low : high) = middle;
    }
    move(low);
    if (measure(x, here).distance < tolerance) return true;
  }
  return false;
}

}  // namespace pliant_tests
