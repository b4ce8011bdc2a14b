#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"
#include "tests/mesh/meshes.h"

namespace test_topology {

using namespace pliant;
using namespace pliant_tests;

namespace {

std::vector<Index> ring_of(const VertexRings& rings, Index center) {
  const auto found = std::ranges::find(rings.centers, center);
  if (found == rings.centers.end()) return {};
  const auto ring = rings.ring(static_cast<Index>(found - rings.centers.begin()));
  return {ring.begin(), ring.end()};
}

/// Every vertex in one class; consecutive neighbors span a triangle with the center, each triangle once.
void check_rings(const Mesh& mesh, const VertexRings& rings) {
  CHECK(rings.ring_count() + rings.boundary_vertex_count + rings.nonmanifold_vertex_count +
            rings.isolated_vertex_count ==
        mesh.vertex_count());
  std::multiset<Triangle> triangles;
  for (Triangle triangle : mesh.triangles) {
    std::ranges::sort(triangle);
    triangles.insert(triangle);
  }
  for (Index r = 0; r < rings.ring_count(); ++r) {
    const auto ring = rings.ring(r);
    const Index center = rings.centers[static_cast<std::size_t>(r)];
    const auto valence = std::ranges::count_if(
        mesh.triangles, [&](const Triangle& t) { return std::ranges::find(t, center) != t.end(); });
    CHECK(static_cast<std::ptrdiff_t>(ring.size()) == valence);
    CHECK(std::set<Index>(ring.begin(), ring.end()).size() == ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Triangle spanned{center, ring[i], ring[(i + 1) % ring.size()]};
      std::ranges::sort(spanned);
      CHECK(triangles.count(spanned) == 1);
    }
  }
}

}  // namespace

TEST_CASE("unique edges are sorted, ascending within, each once, from every kind of element") {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {3, 0, 0}}, {{2, 1, 0}, {0, 1, 2}});
  mesh.edges = {{5, 4}, {1, 0}};
  CHECK(unique_edges(mesh) == std::vector<Edge>{{0, 1}, {0, 2}, {1, 2}, {4, 5}});
  mesh.tetrahedra = {{0, 1, 2, 3}};
  CHECK(unique_edges(mesh) == std::vector<Edge>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}, {4, 5}});
  CHECK(unique_edges(Mesh{}).empty());
}

TEST_CASE("edges tell boundary, interior and non-manifold apart") {
  const EdgeTriangles book = edge_triangles(book_of_three_pages());
  CHECK(book.edges == unique_edges(book_of_three_pages()));
  std::array<int, 4> histogram{};
  for (Index e = 0; e < book.edge_count(); ++e) ++histogram[book.triangles_of(e).size()];
  CHECK(histogram == std::array<int, 4>{0, 12, 9, 2});
  const auto spine = book.triangles_of(0);
  CHECK(book.edges[0] == Edge{0, 1});
  CHECK(std::vector<Index>(spine.begin(), spine.end()) == std::vector<Index>{1, 5, 9});
  CHECK(edge_triangles(Mesh{}).edge_count() == 0);
}

TEST_CASE("the boundary of triangles, of tetrahedra and of chains") {
  const Mesh sheet = grid({.columns = 4, .rows = 3});
  CHECK(boundary_vertices(sheet) == std::vector<Index>{0, 1, 2, 3, 4, 7, 8, 9, 10, 11});
  CHECK(boundary_edges(sheet).size() == 10);
  CHECK(boundary_vertices(torus({})).empty());
  CHECK(boundary_vertices(chain({.links = 4})) == std::vector<Index>{0, 4});
  CHECK(boundary_vertices(Mesh{}).empty());

  const std::vector<Index> surface = boundary_vertices(bar({.cells = {2, 2, 2}}));
  CHECK(surface.size() == 26);
  CHECK(std::ranges::find(surface, 13) == surface.end());
}

TEST_CASE("the surface of one tetrahedron is its four faces, seen counter-clockwise from outside") {
  const std::vector<Tetrahedron> one{{0, 1, 2, 3}};
  CHECK(boundary_triangles(one) == std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  CHECK(boundary_triangles({}).empty());
}

TEST_CASE("the surface of a bar is closed and holds the bar's volume") {
  for (const TetrahedronCut cut : {TetrahedronCut::five, TetrahedronCut::six}) {
    const Mesh box = bar({.cells = {3, 2, 4}, .size = {1.5, 0.5, 2}, .cut = cut});
    Mesh skin;
    skin.vertices = box.vertices;
    skin.triangles = boundary_triangles(box.tetrahedra);
    CHECK(skin.triangles.size() == 2 * 2 * (3 * 2 + 2 * 4 + 4 * 3));
    CHECK(boundary_edges(skin).empty());
    Real volume = 0;
    for (const auto& [a, b, c] : skin.triangles) {
      volume += row(skin.vertices, a).dot(row(skin.vertices, b).cross(row(skin.vertices, c))) / 6;
    }
    CHECK(volume == doctest::Approx(1.5).epsilon(1e-14));
  }
}

TEST_CASE("rings of a grid run as its triangles do") {
  const Mesh sheet = grid({.columns = 4, .rows = 4, .plane = Plane::xy});
  const VertexRings rings = vertex_rings(sheet);
  check_rings(sheet, rings);
  CHECK(rings.centers == std::vector<Index>{5, 6, 9, 10});
  CHECK(rings.boundary_vertex_count == 12);
  CHECK(rings.nonmanifold_vertex_count == 0);
  CHECK(ring_of(rings, 5) == std::vector<Index>{0, 1, 6, 10, 9, 4});
}

TEST_CASE("a Moebius strip has a ring at every middle vertex and one border") {
  const Mesh strip = moebius_strip(9);
  const VertexRings rings = vertex_rings(strip);
  check_rings(strip, rings);
  CHECK(rings.ring_count() == 9);
  CHECK(rings.boundary_vertex_count == 18);
  CHECK(rings.nonmanifold_vertex_count == 0);
  CHECK(hinges(strip).boundary_edge_count == 18);
  CHECK(hinges(strip).stencils.size() == 45);
  // Euler characteristic 0 and one border: a Moebius strip, where an annulus has two.
  CHECK(27 - static_cast<int>(unique_edges(strip).size()) + 36 == 0);
  Mesh border;
  border.vertices = strip.vertices;
  border.edges = boundary_edges(strip);
  const std::vector<Index> component = components(border);
  CHECK(std::ranges::max(component) == 9);  // the border and nine lonely middle vertices
}

TEST_CASE("rings do not ask for a consistent orientation") {
  Mesh sheet = grid({.columns = 3, .rows = 3, .plane = Plane::xy});
  for (std::size_t t = 1; t < sheet.triangles.size(); t += 2) {
    std::swap(sheet.triangles[t][0], sheet.triangles[t][1]);
  }
  CHECK(ring_of(vertex_rings(sheet), 4) == std::vector<Index>{0, 1, 5, 8, 7, 3});
  std::swap(sheet.triangles[0][0], sheet.triangles[0][1]);
  CHECK(ring_of(vertex_rings(sheet), 4) == std::vector<Index>{1, 0, 3, 7, 8, 5});
}

TEST_CASE("vertices without a ring are counted by reason") {
  const VertexRings book = vertex_rings(book_of_three_pages());
  CHECK(book.ring_count() == 0);
  CHECK(book.nonmanifold_vertex_count == 3);
  CHECK(book.boundary_vertex_count == 9);

  SUBCASE("two fans that meet in a point") {
    const VertexRings tie = vertex_rings(mesh_of(std::vector<std::array<Real, 3>>(6), {{0, 1, 2}, {0, 3, 4}}));
    CHECK(tie.nonmanifold_vertex_count == 1);
    CHECK(tie.boundary_vertex_count == 4);
    CHECK(tie.isolated_vertex_count == 1);
  }
  SUBCASE("two closed fans that meet in a point, and one open and one closed") {
    std::vector<Triangle> tents{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}};
    CHECK(vertex_rings(mesh_of(std::vector<std::array<Real, 3>>(7), tents)).nonmanifold_vertex_count == 1);
    tents.pop_back();
    CHECK(vertex_rings(mesh_of(std::vector<std::array<Real, 3>>(7), tents)).nonmanifold_vertex_count == 1);
  }
  SUBCASE("the same triangle twice") {
    const VertexRings twice = vertex_rings(mesh_of(std::vector<std::array<Real, 3>>(3), {{0, 1, 2}, {2, 1, 0}}));
    CHECK(twice.nonmanifold_vertex_count == 3);
  }
}

TEST_CASE("a fan of many triangles takes no longer than its size") {
  const Index count = 200'000;
  const Mesh lid = cylinder({.segments = count, .rows = 2, .caps = Caps::closed});
  const VertexRings rings = vertex_rings(lid);
  CHECK(rings.ring_count() == lid.vertex_count());
  CHECK(rings.ring(lid.vertex_count() - 1).size() == static_cast<std::size_t>(count));
}

TEST_CASE("a hinge is an edge as its first triangle runs and the two vertices opposite") {
  const Mesh pair = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{2, 0, 1}, {1, 3, 2}});
  const Hinges folded = hinges(pair);
  CHECK(folded.stencils == std::vector<Hinge>{{1, 2, 0, 3}});
  CHECK(folded.boundary_edge_count == 4);
  CHECK(folded.nonmanifold_edge_count == 0);
  CHECK(folded.degenerate_edge_count == 0);

  const Hinges book = hinges(book_of_three_pages());
  CHECK(book.nonmanifold_edge_count == 2);
  CHECK(book.boundary_edge_count == 12);
  CHECK(book.stencils.size() == 9);

  const Hinges twice = hinges(mesh_of(std::vector<std::array<Real, 3>>(3), {{0, 1, 2}, {2, 1, 0}}));
  CHECK(twice.degenerate_edge_count == 3);
  CHECK(twice.stencils.empty());
}

TEST_CASE("every hinge of a closed surface joins its two triangles") {
  const Mesh ball = sphere({.subdivisions = 2});
  const Hinges folds = hinges(ball);
  CHECK(folds.stencils.size() == 480);
  const std::set<Triangle> triangles(ball.triangles.begin(), ball.triangles.end());
  const auto has = [&](Index a, Index b, Index c) {
    return triangles.count({a, b, c}) + triangles.count({b, c, a}) + triangles.count({c, a, b}) == 1;
  };
  for (const auto& [x0, x1, x2, x3] : folds.stencils) {
    CHECK(has(x0, x1, x2));
    CHECK(has(x1, x0, x3));
  }
}

TEST_CASE("components are numbered by their smallest vertex, through elements of every kind") {
  Mesh mesh = joined(book_of_three_pages(), grid({.columns = 2, .rows = 2}));
  mesh.vertices.conservativeResize(mesh.vertex_count() + 1, 3);
  std::vector<Index> expected(17, 0);
  std::fill(expected.begin() + 12, expected.end(), 1);
  expected[16] = 2;
  CHECK(components(mesh) == expected);
  mesh.edges.push_back({16, 3});
  expected[16] = 0;
  CHECK(components(mesh) == expected);
  mesh.tetrahedra.push_back({12, 13, 14, 0});
  CHECK(components(mesh) == std::vector<Index>(17, 0));
  CHECK(components(Mesh{}).empty());
}

}  // namespace test_topology
