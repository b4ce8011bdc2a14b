#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "pliant/collision/exact_orientation.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"
#include "tests/collision/scenes_of_crossings.h"

namespace test_crossings {

using namespace pliant;
using namespace pliant_tests;

namespace {

using Pairs = std::vector<std::pair<Edge, Index>>;

/// Each edge with each triangle; of points in general position.
Pairs all_crossings(const Mesh& mesh) {
  const Positions& x = mesh.vertices;
  Pairs pairs;
  for (const auto& [p, q] : unique_edges(mesh)) {
    for (Index t = 0; t < count_of(mesh.triangles); ++t) {
      const auto& [a, b, c] = mesh.triangles[at(t)];
      if (p == a || p == b || p == c || q == a || q == b || q == c) continue;
      const auto side = [&](Index i, Index j, Index k, Index l) {
        return orientation(row(x, i), row(x, j), row(x, k), row(x, l));
      };
      if (side(a, b, c, p) == side(a, b, c, q)) continue;
      const int turn = side(p, q, a, b);
      if (turn == side(p, q, b, c) && turn == side(p, q, c, a)) pairs.push_back({{p, q}, t});
    }
  }
  return pairs;
}

Pairs pairs_of(const Crossings& crossings) {
  Pairs pairs;
  for (const Crossing& crossing : crossings.first) pairs.push_back({crossing.edge, crossing.triangle});
  return pairs;
}

/// A sheet that is rolled up askew, so that its turns pass through each other.
Mesh folded_sheet() {
  Mesh mesh = grid({.columns = 30, .rows = 12, .size = {6, 1}, .plane = Plane::xz});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Real s = mesh.vertices(v, 0);
    mesh.vertices(v, 0) = std::sin(2 * s) + 0.1 * s;
    mesh.vertices(v, 1) = std::cos(2 * s) + 0.013 * s;
    mesh.vertices(v, 2) += 0.03 * s;  // so that no mesh lines meet
  }
  return mesh;
}

}  // namespace

TEST_CASE("an edge through a triangle: which, where, and of which triangles it is an edge") {
  const Mesh mesh = joined(mesh_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}),
                           mesh_of({{1, 1, -1}, {1, 1, 3}, {-5, 1, 3}, {-5, -1, 3}}, {{0, 1, 2}, {3, 1, 0}}));
  const Crossings crossings = crossings_of(mesh);
  REQUIRE(crossings.count >= 1);
  const auto& first = *std::ranges::find(crossings.first, Edge{3, 4}, &Crossing::edge);
  CHECK(first.triangle == 0);
  CHECK(first.edge_triangles == std::array<Index, 2>{1, 2});
  CHECK((first.point - Vec3(1, 1, 0)).norm() < 1e-15);
  CHECK(static_cast<std::size_t>(crossings.count) == all_crossings(mesh).size());

  Mesh chain = mesh_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}}, {{0, 1, 2}});
  CHECK(crossing_count(chain) == 0);
  chain.edges = {{4, 3}};
  REQUIRE(crossing_count(chain) == 1);
  CHECK(crossings_of(chain).first[0].edge == Edge{3, 4});
  CHECK(crossings_of(chain).first[0].edge_triangles == std::array<Index, 2>{-1, -1});
}

TEST_CASE("random triangles: the same crossings as each edge tried with each triangle") {
  Random random(1);
  std::int64_t found = 0;
  for (const Real size : {0.02, 0.2, 1.0}) {
    for (int i = 0; i < 10; ++i) {
      Mesh mesh = soup(random, 120, size);
      if (i % 2 == 0) mesh = joined(mesh, soup(random, 2, 20));  // among them some huge ones
      const Crossings crossings = crossings_of(mesh);
      const Pairs pairs = pairs_of(crossings);
      CHECK(pairs == all_crossings(mesh));
      CHECK(crossings.count == static_cast<std::int64_t>(pairs.size()));
      CHECK(std::ranges::is_sorted(pairs));
      found += crossings.count;
    }
  }
  CHECK(found > 5000);
  const Mesh rolled = folded_sheet();
  CHECK(pairs_of(crossings_of(rolled)) == all_crossings(rolled));
  CHECK(crossing_count(rolled) > 20);
}

TEST_CASE("the list is cut, the count is not") {
  Random random(2);
  const Mesh mesh = soup(random, 200, 0.5);
  const Pairs all = pairs_of(crossings_of(mesh));
  REQUIRE(all.size() > 20);
  for (const std::size_t most : {std::size_t{0}, std::size_t{1}, std::size_t{7}, all.size(), all.size() + 5}) {
    const Crossings cut = crossings_of(mesh, most);
    CHECK(cut.count == static_cast<std::int64_t>(all.size()));
    CHECK(pairs_of(cut) == Pairs(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size()))));
  }
}

TEST_CASE("a search that would take too long ends early, and says so") {
  Random random(7);
  const Mesh mesh = soup(random, 800, 2);  // nearly all boxes meet
  const Crossings all = find_crossings({.positions = mesh.vertices, .triangles = mesh.triangles});
  CHECK(all.is_complete);
  const auto cut = [&](std::int64_t effort) {
    return find_crossings({.positions = mesh.vertices, .triangles = mesh.triangles, .most_effort = effort});
  };
  CHECK(!cut(0).is_complete);
  CHECK(cut(0).count == 0);
  CHECK(!cut(1000000).is_complete);
  CHECK(cut(1000000).count < all.count);
  CHECK(cut(1000000000000).count == all.count);
  const Mesh smooth = torus({.major_segments = 200, .minor_segments = 100});
  const auto effort = 1000 * static_cast<std::int64_t>(smooth.triangles.size());
  CHECK(
      find_crossings({.positions = smooth.vertices, .triangles = smooth.triangles, .most_effort = effort}).is_complete);
}

TEST_CASE("neither the order of vertices and triangles nor a mirror changes what crosses") {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Mesh mesh = i % 2 == 0 ? soup(random, 80, 0.5) : folded_sheet();
    const Crossings crossings = crossings_of(mesh);
    Vec3 sum = Vec3::Zero();
    for (const Crossing& crossing : crossings.first) sum += crossing.point;
    const Crossings others = crossings_of(shuffled(mesh, random));
    for (const Crossing& crossing : others.first) sum -= crossing.point;
    CHECK(others.count == crossings.count);
    CHECK(sum.norm() < 1e-6);
    Mesh mirrored = mesh;
    mirrored.vertices.col(i % 3) *= -1;
    CHECK(pairs_of(crossings_of(mirrored)) == pairs_of(crossings));
    mirrored.vertices.col(0).swap(mirrored.vertices.col(2));
    CHECK(pairs_of(crossings_of(mirrored)) == pairs_of(crossings));
    mirrored.vertices *= 0x1p-900;
    CHECK(pairs_of(crossings_of(mirrored)) == pairs_of(crossings));
  }
}

TEST_CASE("twice the same input gives the same bits") {
  Random random(4);
  const Mesh mesh = soup(random, 300, 0.4);
  const Crossings once = crossings_of(mesh);
  const Crossings again = crossings_of(mesh);
  REQUIRE(once.first.size() == again.first.size());
  for (std::size_t i = 0; i < once.first.size(); ++i) {
    CHECK(once.first[i].edge == again.first[i].edge);
    CHECK(once.first[i].point == again.first[i].point);
  }
}

TEST_CASE("shapes that do not cross, and pairs that do and do not") {
  const TorusOptions ring{.major_segments = 30, .minor_segments = 16, .major_radius = 0.5, .minor_radius = 0.1};
  const Mat3 upright = Eigen::AngleAxis<Real>(std::acos(0.0), Vec3::UnitX()).toRotationMatrix();
  for (const Mesh& mesh : {torus(ring), sphere({.subdivisions = 3}), pillow({}), cylinder({.caps = Caps::closed}),
                           grid({.diagonals = Diagonals::crossed}), bar({}), moebius_strip(40)}) {
    CHECK(crossing_count(mesh) == 0);
  }
  CHECK(crossing_count(joined(torus(ring), moved(turned(torus(ring), upright), {0.5, 0, 0}))) == 0);
  CHECK(crossing_count(joined(torus(ring), moved(turned(torus(ring), upright), {0.17, 0, 0}))) > 10);
  CHECK(crossing_count(joined(torus(ring), moved(turned(torus(ring), upright), {2, 0, 0}))) == 0);
  CHECK(crossing_count(joined(sphere({.subdivisions = 3, .radius = 1}), sphere({.radius = 0.9}))) == 0);
  CHECK(crossing_count(joined(sphere({.subdivisions = 3, .radius = 1}), moved(sphere({.radius = 0.9}), {0.3, 0, 0}))) >
        10);
  Random random(5);
  for (int i = 0; i < 5; ++i) {
    const Mesh sheets = joined(moved(grid({.plane = Plane::xy}), {-0.5, -0.5, 0}),
                               turned(moved(grid({.plane = Plane::xy}), {-0.47, -0.52, 0}), random.rotation()));
    CHECK(pairs_of(crossings_of(sheets)) == all_crossings(sheets));
    CHECK(crossing_count(sheets) > 10);
  }
}

TEST_CASE("solids cross by their surfaces") {
  const Mesh block = bar({.cells = {4, 2, 2}, .size = {4, 2, 2}});
  CHECK(surface_triangles(block) == boundary_triangles(block.tetrahedra));
  const auto both = [&](const Vec3& way) {
    Mesh mesh = joined(block, moved(block, way));
    const std::vector<Tetrahedron> first = mesh.tetrahedra;
    for (const auto& [a, b, c, d] : first) {
      const Index shift = block.vertex_count();
      mesh.tetrahedra.push_back({a + shift, b + shift, c + shift, d + shift});
    }
    return crossing_count(mesh);
  };
  CHECK(both({1.3, 0.4, 0.7}) > 10);
  CHECK(both({4.01, 0, 0}) == 0);
  CHECK(both({4, 0, 0}) == 0);    // side on side, vertex on vertex
  CHECK(both({3.5, 1, 2}) == 0);  // stacked, edges across edges
  CHECK(both({0.5, 0.25, 2}) == 0);
  CHECK(both({1, 1, 1}) > 10);  // vertex on vertex, right through
  CHECK(both({0, 0, 0}) == 0);  // twice the same
}

TEST_CASE("values that no mesh should have") {
  Random random(6);
  const Mesh mesh = soup(random, 60, 0.5);
  const Pairs pairs = pairs_of(crossings_of(mesh));
  for (const Real bad :
       {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity(), 1e300, -1e101}) {
    Mesh spoiled = joined(mesh, mesh_of({{bad, 0, 0}, {1, 1, 1}, {-1, -1, -1}}, {{0, 1, 2}}));
    spoiled.edges = {{0, 180}};
    Pairs found = pairs_of(crossings_of(spoiled));
    // What is left of the last triangle is its one edge with two sound ends.
    std::erase_if(found, [](const auto& pair) { return pair.first == Edge{181, 182}; });
    CHECK(found == pairs);
  }
  Mesh repeated = mesh;
  repeated.triangles.insert(repeated.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  CHECK(crossing_count(repeated) == 2 * static_cast<std::int64_t>(pairs.size()));
  CHECK(find_crossings({mesh.vertices, {}}).count == 0);
  CHECK(find_crossings({Positions(0, 3), {}}).count == 0);

  Mesh flattened = mesh;  // into a line: no area anywhere
  flattened.vertices.rightCols(2).setZero();
  CHECK(crossing_count(flattened) == 0);
  flattened = mesh;  // into a plane
  flattened.vertices.col(1).setZero();
  CHECK(crossing_count(flattened) == 0);
}

TEST_CASE("a million vertices in one point, and one triangle over all others") {
  Mesh point;
  point.vertices = Positions::Constant(1000000, 3, 0.3);
  for (Index v = 0; v + 2 < point.vertex_count(); ++v) point.triangles.push_back({v, v + 1, v + 2});
  CHECK(crossing_count(point) == 0);

  Mesh sheet = grid({.columns = 101, .rows = 101, .plane = Plane::xy});
  sheet = joined(sheet, mesh_of({{-1e6, 0.503, -1e6}, {1e6, 0.503, -1e6}, {0, 0.503, 1e6}}, {{0, 1, 2}}));
  CHECK(crossing_count(sheet) == 101 + 100);  // lines across, diagonals
}

}  // namespace test_crossings
