// Closest points of two features: the nearest there are, the same wherever the pair lies, and finite whatever its
// shape.
#include <algorithm>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "pliant/collision/pairs/gap.h"

namespace test_pair_gap {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr std::array kinds{PairKind::vertex_triangle, PairKind::edge_edge, PairKind::vertex_edge};

Pair pair_of(PairKind kind, std::uint8_t owned = 0) {
  if (kind == PairKind::vertex_edge) return {kind, owned, {}, {0, 1, 2, 2}};
  return {kind, owned, {}, {0, 1, 2, 3}};
}

Positions positions_of(std::initializer_list<Vec3> points) {
  Positions q(static_cast<Index>(points.size()), 3);
  Index i = 0;
  for (const Vec3& x : points) q.row(i++) = x.transpose();
  return q;
}

Vec3 sum_of(const Positions& q, const Pair& pair, const Gap& gap) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t j = 0; j < 4; ++j) sum += gap.weights[j] * row(q, pair.vertices[j]);
  return sum;
}

void check_is_sound(const Positions& q, const Pair& pair, const Gap& gap) {
  const Real size = q.cwiseAbs().maxCoeff();
  CHECK(std::isfinite(gap.distance));
  CHECK(gap.distance >= 0);
  CHECK(gap.normal.norm() == doctest::Approx(1).epsilon(1e-12));
  Real first = 0, second = 0;
  for (std::size_t j = 0; j < 4; ++j) {
    const bool is_first = static_cast<int>(j) < pair.first_side();
    (is_first ? first : second) += gap.weights[j];
    CHECK((is_first ? gap.weights[j] : -gap.weights[j]) >= -1e-6);
  }
  CHECK(first == doctest::Approx(1).epsilon(1e-13));
  CHECK(second == doctest::Approx(-1).epsilon(1e-13));
  CHECK((sum_of(q, pair, gap) - gap.distance * gap.normal).norm() <= 1e-14 * size);
}

/// Of the distances between many points of both features, the least.
Real least_of_samples(const Positions& q, const Pair& pair) {
  constexpr int steps = 24;
  Real least = 1e300;
  const auto between = [](Real t, const Vec3& a, const Vec3& b) { return Vec3(a + t * (b - a)); };
  std::array<Vec3, 4> x;
  for (std::size_t j = 0; j < 4; ++j) x[j] = row(q, pair.vertices[j]);
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= steps; ++k) {
      const Real s = static_cast<Real>(i) / steps;
      const Real t = static_cast<Real>(k) / steps;
      const bool is_edges = pair.kind == PairKind::edge_edge;
      const Vec3 first = is_edges ? between(s, x[0], x[1]) : x[0];
      const Vec3 second = is_edges ? between(t, x[2], x[3]) : between(t, between(s, x[1], x[2]), x[3]);
      least = std::min(least, (first - second).norm());
    }
  }
  return least;
}

}  // namespace

TEST_CASE("the closest points are nearer than all others") {
  Random random(1);
  for (const PairKind kind : kinds) {
    for (int i = 0; i < 300; ++i) {
      const Positions q = random.positions(4, 1);
      const Pair pair = pair_of(kind);
      const Gap gap = measure(q, pair);
      check_is_sound(q, pair, gap);
      CHECK((sum_of(q, pair, gap) - gap.distance * gap.normal).norm() <= 1e-12);
      const Real samples = least_of_samples(q, pair);
      CHECK(gap.distance <= samples + 1e-12);
      CHECK(gap.distance >= samples - 0.2);
    }
  }
}

TEST_CASE("distances, features and owners of known places") {
  Positions q = positions_of({{0.2, 0.3, 0.5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const auto at_place = [&](const Vec3& x, std::uint8_t owned) {
    q.row(0) = x.transpose();
    return measure(q, pair_of(PairKind::vertex_triangle, owned));
  };
  const Gap face = at_place({0.2, 0.3, -0.5}, 0);
  CHECK(face.distance == doctest::Approx(0.5));
  CHECK((face.normal + Vec3::UnitZ()).norm() < 1e-15);
  CHECK(face.weights[1] == doctest::Approx(-0.5));
  CHECK(face.weights[2] == doctest::Approx(-0.2));
  CHECK(face.counts);
  CHECK(face.place == Gap::interior);
  const std::array<Vec3, 6> over{Vec3{0.5, -0.3, 0.4}, {0.5 + 0.3, 0.5 + 0.3, 0.4},
                                 {-0.3, 0.5, 0.4},     Vec3{-0.3, -0.4, 1.2},
                                 {1.3, -0.4, 1.2},     {-0.4, 1.3, 1.2}};
  const std::array<Real, 6> distances{0.5, std::sqrt(0.18 + 0.16), 0.5, 1.3, 1.3, 1.3};
  for (std::uint8_t place = 0; place < 6; ++place) {
    const auto bit = static_cast<std::uint8_t>(1 << place);
    const Gap gap = at_place(over[place], bit);
    CHECK(gap.place == place);
    CHECK(gap.distance == doctest::Approx(distances[place]));
    CHECK(gap.counts);
    CHECK_FALSE(at_place(over[place], static_cast<std::uint8_t>(63 - bit)).counts);
  }
  q = positions_of({{0, 0, 0}, {2, 0, 0}, {0.5, -1, -0.25}, {0.5, 3, -0.25}});
  const Gap edges = measure(q, pair_of(PairKind::edge_edge));
  CHECK(edges.distance == doctest::Approx(0.25));
  CHECK(edges.weights[1] == doctest::Approx(0.25));
  CHECK(edges.weights[3] == doctest::Approx(-0.25));
  CHECK((edges.normal - Vec3::UnitZ()).norm() < 1e-15);
  CHECK(edges.counts);
  q.row(0) << 0.75, 0, 0;  // an end
  CHECK_FALSE(measure(q, pair_of(PairKind::edge_edge)).counts);
  CHECK(measure(q, pair_of(PairKind::edge_edge)).distance == doctest::Approx(std::sqrt(0.125)));
  q = positions_of({{0.5, 0.2, 0}, {0, 0, 0}, {1, 0, 0}});
  CHECK(measure(q, pair_of(PairKind::vertex_edge, 0)).counts);
  q.row(0) << 1.5, 0.2, 0;
  CHECK(measure(q, pair_of(PairKind::vertex_edge, 2)).counts);
  CHECK_FALSE(measure(q, pair_of(PairKind::vertex_edge, 1)).counts);
  q.row(0) << -1.5, 0.2, 0;
  CHECK(measure(q, pair_of(PairKind::vertex_edge, 1)).counts);
  CHECK_FALSE(measure(q, pair_of(PairKind::vertex_edge, 2)).counts);
}

TEST_CASE("gaps turn, move and grow with their pair") {
  Random random(2);
  for (const PairKind kind : kinds) {
    for (int i = 0; i < 100; ++i) {
      const Pair pair = pair_of(kind);
      const Positions q = random.positions(4, 1);
      const Mat3 rotation = random.rotation();
      const Vec3 shift = random.vector(3);
      const Real scale = std::pow(10, random.uniform(-4, 4));
      Positions moved = scale * q * rotation.transpose();
      moved.rowwise() += scale * shift.transpose();
      const Gap gap = measure(q, pair);
      const Gap found = measure(moved, pair);
      CHECK(found.distance == doctest::Approx(scale * gap.distance).epsilon(1e-11));
      CHECK((found.normal - rotation * gap.normal).norm() < 1e-9);
      CHECK(found.place == gap.place);
      CHECK(found.counts == gap.counts);
      for (std::size_t j = 0; j < 4; ++j) CHECK(std::abs(found.weights[j] - gap.weights[j]) < 1e-9);
    }
  }
}

TEST_CASE("at distances of 0 and about it the normal is that of the features") {
  Random random(5);
  for (const Real height : {0.0, 1e-300, 1e-17, 1e-13, 1e-9, 1e-5}) {
    for (const Real scale : {1e-4, 1.0, 1e4}) {
      Positions q = positions_of({{0.2, 0.3, height}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
      q *= scale;
      const Gap face = measure(q, pair_of(PairKind::vertex_triangle));
      CHECK((face.normal - Vec3::UnitZ()).norm() < 1e-12);
      CHECK(face.distance == doctest::Approx(height * scale).epsilon(1e-9));
      q = scale * positions_of({{0, 0, height}, {2, 0, height}, {0.3, -1, 0}, {0.4, 3, 0}});
      CHECK((measure(q, pair_of(PairKind::edge_edge)).normal - Vec3::UnitZ()).norm() < 1e-12);
      q = scale * positions_of({{0.3, 0, height}, {0, 0, 0}, {1, 0, 0}});
      CHECK(std::abs(measure(q, pair_of(PairKind::vertex_edge)).normal.x()) < 1e-14);
    }
  }
  for (int i = 0; i < 200; ++i) {  // turned, so that rounding is everywhere
    const Mat3 rotation = random.rotation();
    const Real height = std::pow(10, random.uniform(-14, -7));
    const Positions q = positions_of({{0.2, 0.3, height}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) * rotation.transpose();
    CHECK((measure(q, pair_of(PairKind::vertex_triangle)).normal - rotation.col(2)).norm() < 1e-14);
    const Positions over =
        positions_of({{0.4, -height, height}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) * rotation.transpose();
    CHECK(std::abs(measure(over, pair_of(PairKind::vertex_triangle)).normal.dot(rotation.col(0))) < 1e-14);
  }
}

TEST_CASE("whatever the shape, gaps are finite and right") {
  Random random(6);
  for (int i = 0; i < 3000; ++i) {
    const Pair pair = pair_of(kinds[at(i % 3)], 63);
    Positions q = random.positions(4, 1);
    // corners that coincide, lie on one line but for a little, or are very near
    const Real little = i % 5 == 0 ? 0 : std::pow(10, random.uniform(-320, -3));
    const Index a = random.index(4), b = random.index(4), c = random.index(4);
    if (i % 2 == 0) q.row(a) = q.row(b) + little * random.vector(1).transpose();
    if (i % 3 == 0) q.row(c) = 0.3 * q.row(a) + 0.7 * q.row(b) + little * random.vector(1).transpose();
    if (i % 7 == 0) q.row(3) = q.row(2) + (q.row(1) - q.row(0)) + little * random.vector(1).transpose();
    if (i % 97 == 0) q.rowwise() = q.row(0).eval();
    check_is_sound(q, pair, measure(q, pair));
    CHECK(measure(q, pair).distance <= least_of_samples(q, pair) + 1e-14);
  }
}

TEST_CASE("parallel edges do not count, edges that are almost so where they cross") {
  const Pair pair = pair_of(PairKind::edge_edge);
  const Gap parallel = measure(positions_of({{0, 0, 0}, {1, 0, 0}, {0.25, 0, 0.5}, {1.25, 0, 0.5}}), pair);
  CHECK_FALSE(parallel.counts);
  CHECK(parallel.distance == doctest::Approx(0.5));
  for (const Real angle : {1e-2, 1e-4, 1e-6, 1e-7}) {
    const Gap gap =
        measure(positions_of({{0, 0, 0}, {1, 0, 0}, {0.1, -0.3 * angle, 1e-3}, {1.1, 0.7 * angle, 1e-3}}), pair);
    CHECK(gap.counts);
    CHECK(gap.distance == doctest::Approx(1e-3).epsilon(1e-9));
    CHECK(gap.weights[1] == doctest::Approx(0.4).epsilon(1e-6));
  }
}

TEST_CASE("a vertex over a surface counts once, whatever feature it is over") {
  Random random(7);
  for (int turn = 0; turn < 40; ++turn) {
    // Flat, a ridge seen from outside, or a pyramid; corners and triangles in any order.
    const int shape = turn % 3;
    Positions q(10, 3);
    for (Index i = 0; i < 9; ++i) {
      const Real x = static_cast<Real>(i % 3 - 1), y = static_cast<Real>(i / 3 - 1);
      q.row(i) << x, y, shape == 0 ? 0 : shape == 1 ? -0.5 * std::abs(x) : -0.4 * (std::abs(x) + std::abs(y));
    }
    std::vector<Triangle> triangles;
    for (Index i : {0, 1, 3, 4}) {
      triangles.push_back({i, i + 1, i + 4});
      triangles.push_back({i, i + 4, i + 3});
    }
    for (std::size_t i = 0; i < 8; ++i) {
      std::swap(triangles[i], triangles[at(random.index(8))]);
      std::rotate(triangles[i].begin(), triangles[i].begin() + random.index(3), triangles[i].end());
    }
    const SurfacePart part{.vertex_count = 10, .triangles = triangles};
    const Surface surface({&part, 1}, 10, {});
    const Mat3 rotation = turn < 6 ? Mat3(Mat3::Identity()) : random.rotation();
    for (int i = 0; i < 60; ++i) {
      const auto near_line = [&] {
        return random.index(3) == 0 ? random.uniform(-0.9, 0.9) : 0.5 * (random.index(3) - 1);
      };
      const Real x = near_line(), y = random.index(4) == 0 ? x : near_line();
      q.row(9) << x, y, random.uniform(0.01, 0.4);
      Positions turned = q * rotation.transpose();
      int count = 0, without = 0;
      for (Index t = 0; t < 8; ++t) {
        const auto& [a, b, c] = surface.triangles[at(t)];
        const Pair pair{PairKind::vertex_triangle, surface.owned_by_triangle[at(t)], {9, t}, {9, a, b, c}};
        const Gap gap = measure(turned, pair);
        without += gap.counts ? 1 : 0;
        count += gap.counts && is_nearest_there(turned, surface, pair, gap) ? 1 : 0;
      }
      CHECK(count == 1);
      CHECK(without >= count);
    }
  }
}

TEST_CASE("what is nearer to the inside of a triangle around an edge or a corner does not count there") {
  // A sheet of two triangles, and a vertex beside the edge that they share.
  const std::array<Triangle, 2> triangles{Triangle{0, 1, 2}, Triangle{1, 0, 3}};
  const SurfacePart part{.vertex_count = 5, .triangles = triangles};
  const Surface surface({&part, 1}, 5, {});
  const auto seen_from_first = [&](const Vec3& x, const Vec3& fourth) {
    const Positions q = positions_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, fourth, x});
    const Pair pair{PairKind::vertex_triangle, 63, {4, 0}, {4, 0, 1, 2}};
    const Gap gap = measure(q, pair);
    CHECK(gap.place == 0);
    return is_nearest_there(q, surface, pair, gap);
  };
  CHECK_FALSE(seen_from_first({0.5, -0.1, 0.2}, {0.5, -1, 0}));
  CHECK(seen_from_first({0.5, -0.1, 0.2}, {0.5, -1, -1}));
  CHECK_FALSE(seen_from_first({0.5, -0.1, 0.2}, {0.5, -1, 1}));
  CHECK(seen_from_first({0.5, -0.1, 0.01}, {0.5, 1, -1}));
  // The middle joint of a rope that bends away from a vertex, or towards it.
  const std::array<Edge, 2> edges{Edge{0, 1}, Edge{1, 2}};
  const SurfacePart rope{.vertex_count = 4, .edges = edges};
  const Surface joints({&rope, 1}, 4, {});
  const auto at_joint = [&](Real third) {
    const Positions q = positions_of({{-1, -0.5, 0}, {0, 0, 0}, {1, third, 0}, {0.1, 0.3, 0}});
    const Pair pair{PairKind::vertex_edge, 3, {3, 0}, {3, 0, 1, 1}};
    const Gap gap = measure(q, pair);
    CHECK(gap.place == 1);
    return is_nearest_there(q, joints, pair, gap);
  };
  CHECK(at_joint(-0.5));
  CHECK_FALSE(at_joint(0.5));
}

}  // namespace test_pair_gap
