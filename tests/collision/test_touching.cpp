#include <array>

#include <doctest/doctest.h>

#include "pliant/mesh/shapes.h"
#include "tests/collision/scenes_of_crossings.h"

namespace test_touching {

using namespace pliant;
using namespace pliant_tests;

namespace {

using Corners = std::array<Vec3, 4>;

Corners small_tetrahedron(Random& random, Index limit) {
  Corners corners;
  do {
    for (Vec3& corner : corners) corner = Vec3(random.index(limit), random.index(limit), random.index(limit));
  } while ((corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]) == 0);
  return corners;
}

std::pair<Real, Real> extent(const Corners& corners, const Vec3& axis) {
  std::pair<Real, Real> range(corners[0].dot(axis), corners[0].dot(axis));
  for (const Vec3& corner : corners) {
    range = {std::min(range.first, corner.dot(axis)), std::max(range.second, corner.dot(axis))};
  }
  return range;
}

/// Whether a plane has the insides on different sides: exact, since all numbers are whole and small. One of the planes
/// is that of a face or that of two edges.
bool are_apart(const Corners& a, const Corners& b) {
  std::vector<Vec3> ways_a, ways_b, axes;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      ways_a.push_back(a[j] - a[i]);
      ways_b.push_back(b[j] - b[i]);
    }
  }
  for (const auto* first : {&ways_a, &ways_b}) {
    for (const Vec3& u : *first) {
      for (const auto* second : {&ways_a, &ways_b}) {
        for (const Vec3& v : *second) axes.push_back(u.cross(v));
      }
    }
  }
  return std::ranges::any_of(axes, [&](const Vec3& axis) {
    const auto [min_a, max_a] = extent(a, axis);
    const auto [min_b, max_b] = extent(b, axis);
    return axis != Vec3::Zero() && (max_a <= min_b || max_b <= min_a);
  });
}

bool contains_all(const Corners& outer, const Corners& inner) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& origin = outer[(i + 1) % 4];
    const Vec3 normal = (outer[(i + 2) % 4] - origin).cross(outer[(i + 3) % 4] - origin);
    const Real side = normal.dot(outer[i] - origin);
    const auto is_out = [&](const Vec3& x) { return normal.dot(x - origin) * side < 0; };
    if (std::ranges::any_of(inner, is_out)) return false;
  }
  return true;
}

/// Doubles a tetrahedron, and returns one whose corners lie in the middles of its edges and on its corners.
Corners within(Corners& outer, Random& random) {
  Corners inner;
  do {
    for (Vec3& corner : inner) {
      corner = outer[static_cast<std::size_t>(random.index(4))] + outer[static_cast<std::size_t>(random.index(4))];
    }
  } while ((inner[1] - inner[0]).cross(inner[2] - inner[0]).dot(inner[3] - inner[0]) == 0);
  for (Vec3& corner : outer) corner *= 2;
  return inner;
}

/// Four triangles around a vertex at `tip`, with the ring `height` above it.
Mesh pyramid(const Vec3& tip, Real height) {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, height}, {0, 1, height}, {-1, 0, height}, {0, -1, height}},
                      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  return moved(mesh, tip);
}

}  // namespace

TEST_CASE("tetrahedra of small whole coordinates: those that only touch are never reported") {
  Random random(21);
  int apart = 0;
  int nested = 0;
  int crossing = 0;
  int missed = 0;
  for (int i = 0; i < 30000; ++i) {
    Corners a = small_tetrahedron(random, 4);
    Corners b = small_tetrahedron(random, 4);
    if (i % 4 == 0) b = within(a, random);
    const Mesh mesh = joined(tetrahedron_surface(a), tetrahedron_surface(b));
    const std::int64_t count = crossing_count(mesh);
    if (are_apart(a, b) || contains_all(a, b) || contains_all(b, a)) {
      REQUIRE(count == 0);
      ++(are_apart(a, b) ? apart : nested);
    } else {
      ++crossing;
      missed += count == 0 ? 1 : 0;
    }
    if (i % 10 == 0) CHECK(crossing_count(shuffled(mesh, random)) == count);
  }
  CHECK(apart > 5000);
  CHECK(nested > 5000);
  CHECK(crossing > 5000);
  // Some of these pass through each other only within faces that meet in one plane or in one point.
  CHECK(missed < crossing / 50);
}

TEST_CASE("grids that pass through each other exactly along mesh lines and at vertices") {
  const Mesh level = whole_grid(6, 6, 0, 1);
  const Mesh upright = moved(whole_grid(6, 6, 0, 2), {0, 3, -3});
  CHECK(crossing_count(joined(level, upright)) > 6);                          // vertex on vertex
  CHECK(crossing_count(joined(level, moved(upright, {0.5, 0, 0}))) > 6);      // vertex on edge
  CHECK(crossing_count(joined(level, moved(upright, {0, 0, 0.5}))) > 6);      // edges on vertices
  CHECK(crossing_count(joined(level, moved(upright, {0.25, 0, 0.25}))) > 6);  // edges across a mesh line
  CHECK(crossing_count(joined(level, moved(upright, {0, 0.5, 0}))) > 6);      // vertex in triangle
  CHECK(crossing_count(joined(
            level, turned(level, Eigen::AngleAxis<Real>(std::acos(-1.0) / 2, Vec3::UnitY()).toRotationMatrix()))) ==
        0);  // border on border
  Random random(22);
  for (const Vec3& way : {Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0.5)}) {
    const Mesh mesh = joined(level, moved(upright, way));
    CHECK(crossing_count(shuffled(mesh, random)) == crossing_count(mesh));
  }
}

TEST_CASE("a single triangle whose edge passes through a vertex, an edge and a triangle") {
  const Mesh level = whole_grid(4, 4, 0, 1);
  const Mesh needle = mesh_of({{0, 0, -1}, {0, 0, 1}, {9, 7, 1}}, {{0, 1, 2}});
  for (const Vec3& way : {Vec3(2, 2, 0), Vec3(2.5, 2, 0), Vec3(2.5, 2.5, 0), Vec3(2.6, 2.3, 0)}) {
    const Crossings found = crossings_of(joined(level, moved(needle, way)));
    CHECK(std::ranges::any_of(found.first, [](const Crossing& c) { return c.edge == Edge{25, 26}; }));
  }
  // Past the border and through a corner it separates nothing.
  const Mesh thin = mesh_of({{0, 0, -1}, {0, 0, 1}, {-9, 1, 1}}, {{0, 1, 2}});
  CHECK(crossing_count(joined(level, moved(thin, {0, 2.5, 0}))) == 0);
  CHECK(crossing_count(joined(level, moved(thin, {0, 2, 0}))) == 0);
  CHECK(crossing_count(joined(level, moved(thin, {0.1, 2, 0}))) > 0);
}

TEST_CASE("what rests on a sheet does not cross it") {
  const Mesh level = whole_grid(4, 4, 0, 1);
  for (const Vec3& tip : {Vec3(2, 2, 0), Vec3(2.5, 2, 0), Vec3(2.5, 2.5, 0), Vec3(2.6, 2.3, 0), Vec3(0, 2, 0)}) {
    CHECK(crossing_count(joined(level, pyramid(tip, 1))) == 0);
    CHECK(crossing_count(joined(level, pyramid(tip, -1))) == 0);
    CHECK(crossing_count(joined(level, moved(pyramid(tip, 1), {0, 0, -0.25}))) > 0);
  }
  CHECK(crossing_count(joined(pyramid({0, 0, 0}, 1), pyramid({0, 0, 0}, -1))) == 0);  // tip on tip
  CHECK(crossing_count(joined(pyramid({0, 0, 0}, 1), pyramid({0, 0, 0}, 2))) == 0);   // one in the other
  Mesh bent = pyramid({0, 0, 0}, 1);
  bent.vertices(1, 2) = -2;  // one neighbor of the tip lies on the other side
  CHECK(crossing_count(joined(level, moved(bent, {2, 2, 0}))) > 0);
  Mesh askew = pyramid({0, 0, 0}, 1);
  askew.vertices(1, 2) = 5;  // one neighbor inside, one outside
  askew.vertices(3, 2) = -2;
  CHECK(crossing_count(joined(pyramid({0, 0, 0}, 1), askew)) > 0);
}

TEST_CASE("ridge across ridge") {
  const Mesh roof = mesh_of({{-1, 0, 0}, {1, 0, 0}, {0, 1, -1}, {0, -1, -1}}, {{0, 1, 2}, {1, 0, 3}});
  const Mesh bowl = mesh_of({{0, -1, 0}, {0, 1, 0}, {1, 0, 1}, {-1, 0, 1}}, {{0, 1, 2}, {1, 0, 3}});
  CHECK(crossing_count(joined(roof, bowl)) == 0);
  CHECK(crossing_count(joined(roof, moved(bowl, {0, 0, -0.1}))) > 0);
  const Mesh slope = mesh_of({{0, -1, 0}, {0, 1, 0}, {1, 0, 1}, {-1, 0, -1}}, {{0, 1, 2}, {1, 0, 3}});
  CHECK(crossing_count(joined(roof, slope)) > 0);
}

TEST_CASE("seams, overlaps in a plane and sheets that are folded flat do not cross") {
  const Mesh level = whole_grid(4, 4, 0, 1);
  CHECK(crossing_count(joined(level, level)) == 0);
  CHECK(crossing_count(joined(level, moved(level, {4, 0, 0}))) == 0);                   // a seam
  CHECK(crossing_count(joined(level, moved(level, {1.25, 0.5, 0}))) == 0);              // overlapping
  CHECK(crossing_count(joined(level, whole_grid(4, 4, 0, 2))) == 0);                    // a seam at a right angle
  CHECK(crossing_count(joined(level, moved(whole_grid(4, 4, 0, 2), {0, 2, 0}))) == 0);  // a shelf on a wall
  Mesh folded = level;
  for (Index v = 0; v < folded.vertex_count(); ++v) {
    if (folded.vertices(v, 0) > 2) folded.vertices(v, 0) = 4 - folded.vertices(v, 0);
  }
  CHECK(crossing_count(folded) == 0);
  // Two halves of a ball, with a seam of coincident vertices.
  const Mesh ball = sphere({.subdivisions = 2});
  std::array<Mesh, 2> halves;
  for (const Triangle& triangle : ball.triangles) {
    const Real height = ball.vertices(triangle[0], 2) + ball.vertices(triangle[1], 2) + ball.vertices(triangle[2], 2);
    halves[height > 0 ? 0 : 1].triangles.push_back(triangle);
  }
  for (Mesh& half : halves) half.vertices = ball.vertices;
  CHECK(halves[0].triangles.size() + halves[1].triangles.size() == ball.triangles.size());
  CHECK(crossing_count(joined(halves[0], halves[1])) == 0);
  CHECK(crossing_count(joined(halves[0], moved(halves[1], {0.05, 0.02, 0.03}))) > 0);
}

}  // namespace test_touching
