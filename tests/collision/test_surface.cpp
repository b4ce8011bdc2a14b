#include <algorithm>
#include <numeric>
#include <set>

#include <doctest/doctest.h>

#include "pliant/collision/pairs/surface.h"
#include "pliant/mesh/shapes.h"
#include "tests/core/random.h"
#include "tests/mesh/meshes.h"

namespace test_surface {

using namespace pliant;
using namespace pliant_tests;

namespace {

std::vector<Index> listed(std::span<const Index> list) {
  return {list.begin(), list.end()};
}

/// Corners c of a triangle as bits 3 + c, edges as bits below.
constexpr unsigned corner(unsigned c) {
  return 8U << c;
}
constexpr unsigned all = 63;

/// A square 0 1 2 3 of two triangles with a string from 2 to 4, whose vertex 5 is unused, and a rope of its own. The
/// lists of edges have a side of a triangle, doubled edges and one of no length.
struct ClothAndRope {
  std::vector<Triangle> triangles = {{0, 1, 2}, {2, 2, 1}, {0, 2, 3}};
  std::vector<Edge> strings = {{4, 2}, {1, 0}, {2, 4}, {3, 3}};
  std::vector<Edge> rope = {{2, 1}, {0, 1}};
  std::vector<SurfacePart> parts = {{.first_vertex = 0, .vertex_count = 6, .triangles = triangles, .edges = strings},
                                    {.first_vertex = 7, .vertex_count = 3, .edges = rope, .group = 1}};
  Surface surface{parts, 10, {}};
};

/// That of triangles alone.
Surface surface_of(const std::vector<Triangle>& triangles, Index vertex_count) {
  const SurfacePart part{.vertex_count = vertex_count, .triangles = triangles};
  return {std::span(&part, 1), vertex_count, {}};
}

}  // namespace

TEST_CASE("surface: rope beside cloth, by hand") {
  const ClothAndRope scene;
  const Surface& surface = scene.surface;
  CHECK(surface.vertices == std::vector<Index>{0, 1, 2, 3, 4, 7, 8, 9});
  CHECK(surface.vertex_in_body == std::vector<Index>{0, 1, 2, 3, 4, 0, 1, 2});
  CHECK(surface.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(surface.edges == std::vector<Edge>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}, {2, 4}, {7, 8}, {8, 9}});
  CHECK(surface.loose_begin == 5);
  CHECK(surface.triangle_edges == std::vector<std::array<Index, 3>>{{0, 3, 1}, {1, 4, 2}});
  CHECK(surface.owned_by_triangle == std::vector<std::uint8_t>{all, 0b110 | corner(2)});
  CHECK(surface.owned_by_edge == std::vector<std::uint8_t>{2, 3, 2});
  CHECK(surface.body == std::vector<Index>{0, 0, 0, 0, 0, 0, -1, 1, 1, 1});
  CHECK(surface.group == std::vector<Index>{0, 1});
}

TEST_CASE("surface: what lies opposite an edge, and around a vertex") {
  const ClothAndRope scene;
  const Surface& surface = scene.surface;
  CHECK(listed(surface.opposite(1)) == std::vector<Index>{1, 3});
  CHECK(listed(surface.opposite(0)) == std::vector<Index>{2});
  CHECK(surface.opposite(5).empty());
  CHECK(listed(surface.neighbors(2)) == std::vector<Index>{0, 1, 3, 4});
  CHECK(listed(surface.neighbors(8)) == std::vector<Index>{7, 9});
  CHECK(surface.neighbors(5).empty());
  CHECK(surface.neighbors(6).empty());
}

TEST_CASE("surface: an edge of three triangles, and a doubled triangle") {
  const Mesh book = book_of_three_pages();
  const Surface surface = surface_of(book.triangles, book.vertex_count());
  const auto spine = static_cast<Index>(std::ranges::find(surface.edges, Edge{0, 1}) - surface.edges.begin());
  CHECK(listed(surface.opposite(spine)) == std::vector<Index>{4, 7, 10});
  int owners = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (unsigned e = 0; e < 3; ++e) {
      if (surface.triangle_edges[t][e] == spine) owners += (surface.owned_by_triangle[t] >> e & 1U) != 0 ? 1 : 0;
    }
  }
  CHECK(owners == 1);

  const Surface doubled = surface_of({{0, 1, 2}, {2, 1, 0}}, 3);
  CHECK(doubled.triangles.size() == 2);
  CHECK(doubled.edges.size() == 3);
  CHECK(doubled.owned_by_triangle == std::vector<std::uint8_t>{all, 0});
  CHECK(listed(doubled.opposite(0)) == std::vector<Index>{2});
}

TEST_CASE("surface: every edge and vertex has one owner") {
  const Mesh mesh = moebius_strip(17);
  const Surface surface = surface_of(mesh.triangles, mesh.vertex_count());
  std::multiset<Index> edges, vertices;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      if ((surface.owned_by_triangle[t] >> i & 1U) != 0) edges.insert(surface.triangle_edges[t][i]);
      if ((surface.owned_by_triangle[t] >> (3 + i) & 1U) != 0) vertices.insert(surface.triangles[t][i]);
    }
  }
  std::vector<Index> numbers(surface.edges.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  CHECK(std::ranges::equal(edges, numbers));
  CHECK(std::ranges::equal(vertices, surface.vertices));
}

TEST_CASE("surface: numbers do not depend on the order of the solver") {
  const ClothAndRope scene;
  const std::vector<Index> places = {3, 9, 0, 7, 1, 2, 8, 6, 4, 5};
  const Surface moved(scene.parts, 10, places);
  const auto place = [&](auto corners) {
    for (Index& vertex : corners) vertex = places[at(vertex)];
    return corners;
  };
  CHECK(moved.vertices == place(scene.surface.vertices));
  CHECK(moved.vertex_in_body == scene.surface.vertex_in_body);
  REQUIRE(moved.edges.size() == scene.surface.edges.size());
  for (Index e = 0; e < count_of(moved.edges); ++e) {
    CHECK(moved.edges[at(e)] == place(scene.surface.edges[at(e)]));
    CHECK(listed(moved.opposite(e)) == place(listed(scene.surface.opposite(e))));
  }
  REQUIRE(moved.triangles.size() == scene.surface.triangles.size());
  for (std::size_t t = 0; t < moved.triangles.size(); ++t) {
    CHECK(moved.triangles[t] == place(scene.surface.triangles[t]));
  }
  CHECK(moved.triangle_edges == scene.surface.triangle_edges);
  CHECK(moved.owned_by_triangle == scene.surface.owned_by_triangle);
  CHECK(moved.owned_by_edge == scene.surface.owned_by_edge);
  CHECK(moved.loose_begin == scene.surface.loose_begin);
  for (Index v = 0; v < 10; ++v) {
    CHECK(moved.body[at(places[at(v)])] == scene.surface.body[at(v)]);
    CHECK(listed(moved.neighbors(places[at(v)])) == place(listed(scene.surface.neighbors(v))));
  }
}

TEST_CASE("surface: which parts may meet") {
  const std::vector<SurfacePart> parts = {{.vertex_count = 1, .meets_itself = false},
                                          {.first_vertex = 1, .vertex_count = 1, .group = 1},
                                          {.first_vertex = 2, .vertex_count = 1, .group = 1}};
  Surface surface(parts, 3, {});
  CHECK_FALSE(surface.may_meet(0, 0));
  CHECK(surface.may_meet(1, 1));
  CHECK(surface.may_meet(0, 1));
  surface.ignored = {0, 1, 1, 0};
  CHECK_FALSE(surface.may_meet(0, 1));
  CHECK_FALSE(surface.may_meet(2, 0));
  CHECK(surface.may_meet(1, 2));
  surface.ignored = {0, 0, 0, 1};
  CHECK_FALSE(surface.may_meet(1, 2));
  CHECK(surface.may_meet(1, 1));
}

TEST_CASE("surface: nothing, and triangles without three corners") {
  CHECK(Surface({}, 0, {}).vertices.empty());
  const Surface surface = surface_of({{0, 0, 0}, {0, 1, 1}, {2, 1, 2}}, 3);
  CHECK(surface.triangles.empty());
  CHECK(surface.edges.empty());
  CHECK(surface.vertices.empty());
}

}  // namespace test_surface
