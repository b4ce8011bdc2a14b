// Several meshes as one: numbering, welding, groups.
#include <algorithm>
#include <limits>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/join.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"
#include "tests/mesh/meshes.h"

namespace test_join {

using namespace pliant;
using namespace pliant_tests;

namespace {

Mesh moved(Mesh mesh, const Vec3& offset) {
  mesh.vertices.rowwise() += offset.transpose();
  return mesh;
}

Index component_count(const Mesh& mesh) {
  return std::ranges::max(components(mesh)) + 1;
}

const VertexGroup& vertex_group(const Mesh& mesh, const std::string& name) {
  const auto found = std::ranges::find(mesh.vertex_groups, name, &VertexGroup::name);
  REQUIRE(found != mesh.vertex_groups.end());
  return *found;
}

/// Merged by looking at every pair.
std::vector<Index> slowly_merged(const std::vector<MeshPart>& parts, Real weld) {
  std::vector<Vec3> x;
  std::vector<Index> target;
  for (const MeshPart& part : parts) {
    const Index begin = static_cast<Index>(x.size());
    struct Pair {
      Real distance;
      Index vertex;
    };
    std::vector<Pair> nearest(x.size(), {std::numeric_limits<Real>::infinity(), -1});
    for (Index v = 0; v < part.mesh.vertex_count(); ++v) {
      x.push_back(row(part.mesh.vertices, v));
      target.push_back(begin + v);
      Index best = -1;
      for (Index u = 0; u < begin; ++u) {
        if (target[static_cast<std::size_t>(u)] != u) continue;
        const Real distance = (x[static_cast<std::size_t>(u)] - x.back()).norm();
        if (distance <= weld && (best < 0 || distance < (x[static_cast<std::size_t>(best)] - x.back()).norm()))
          best = u;
      }
      if (best < 0) continue;
      Pair& pair = nearest[static_cast<std::size_t>(best)];
      const Real distance = (x[static_cast<std::size_t>(best)] - x.back()).norm();
      if (distance < pair.distance) pair = {distance, begin + v};
    }
    for (std::size_t u = 0; u < nearest.size(); ++u) {
      if (nearest[u].vertex >= 0) target[static_cast<std::size_t>(nearest[u].vertex)] = static_cast<Index>(u);
    }
  }
  return target;
}

}  // namespace

TEST_CASE("joined without a weld: vertices and elements in turn") {
  const std::vector<MeshPart> parts = {
      {"sheet", grid({.columns = 2, .rows = 2})}, {"rope", chain({.links = 2})}, {"box", bar({.cells = {1, 1, 1}})}};
  const Mesh whole = join(parts);
  CHECK(whole.vertex_count() == 4 + 3 + 8);
  CHECK(whole.triangles == std::vector<Triangle>{{0, 1, 3}, {0, 3, 2}});
  CHECK(whole.edges == std::vector<Edge>{{4, 5}, {5, 6}});
  CHECK(whole.tetrahedra.size() == 6);
  CHECK(whole.tetrahedra[0] == Tetrahedron{7, 8, 10, 14});
  CHECK(whole.vertices.middleRows(4, 3) == parts[1].mesh.vertices);
  CHECK(component_count(whole) == 3);
  CHECK(vertex_group(whole, "rope").vertices == std::vector<Index>{4, 5, 6});
  CHECK(vertex_group(whole, "box").vertices == std::vector<Index>{7, 8, 9, 10, 11, 12, 13, 14});
  CHECK_NOTHROW(check_mesh(whole, "whole"));

  // The faces are the sheet's, with its texture, and the box's surface, without one.
  REQUIRE(whole.groups.size() == 2);
  CHECK(whole.groups[0].name == "sheet");
  CHECK(whole.groups[0].faces == std::vector<Index>{0, 1});
  CHECK(whole.groups[1].name == "box");
  CHECK(whole.groups[1].faces.size() == 12);
  CHECK(whole.faces.face_count() == 14);
  CHECK(whole.faces.texture_coordinates[0] == 0);
  CHECK(whole.faces.texture_coordinates[6] == -1);
}

TEST_CASE("two halves of a sheet welded are the sheet") {
  const Mesh half = grid({.columns = 3, .rows = 5, .size = {1, 2}});
  const Mesh whole = join(std::vector<MeshPart>{{"left", half}, {"right", moved(half, {1, 0, 0})}}, 1e-9);
  const Mesh sheet = grid({.columns = 5, .rows = 5, .size = {2, 2}});
  CHECK(whole.vertex_count() == sheet.vertex_count());
  CHECK(whole.triangles.size() == sheet.triangles.size());
  CHECK(unique_edges(whole).size() == unique_edges(sheet).size());
  CHECK(boundary_edges(whole).size() == boundary_edges(sheet).size());
  CHECK(component_count(whole) == 1);
  CHECK(vertex_group(whole, "left").vertices.size() == 15);
  CHECK(vertex_group(whole, "right").vertices.size() == 15);  // the seam is in both
  CHECK(component_count(join(std::vector<MeshPart>{{"", half}, {"", moved(half, {1, 0, 0})}})) == 2);
}

TEST_CASE("welded vertices are within the distance, and keep the earlier part's place") {
  const Mesh rope = chain({.links = 1, .direction = {1, 0, 0}});
  for (const Real gap : {0.0, 0.0625, 0.0626}) {
    const Mesh whole = join(std::vector<MeshPart>{{"", rope}, {"", moved(rope, {1 + gap, 0, 0})}}, 0.0625);
    CHECK(whole.vertex_count() == (gap <= 0.0625 ? 3 : 4));
    CHECK(row(whole.vertices, 1) == Vec3(1, 0, 0));
  }
}

TEST_CASE("a part's own vertices stay apart, however large the weld") {
  const Mesh post = chain({.links = 1, .length = 0.1, .direction = {0, 0, 1}});
  const Mesh rope = moved(chain({.links = 20, .length = 2, .direction = {1, 0, 0}}), {-1.001, 0, 0});
  const Mesh whole = join(std::vector<MeshPart>{{"post", post}, {"rope", rope}}, 0.5);
  CHECK(whole.vertex_count() == 2 + 21 - 1);  // all of the nearest rope's vertices are nearest to the post's foot
  CHECK(row(whole.vertices, 0) == Vec3(0, 0, 0));
  CHECK_NOTHROW(check_mesh(whole, "whole"));
  CHECK(component_count(whole) == 1);
}

TEST_CASE("welding finds the pairs that comparing all vertices finds") {
  Random random;
  for (int round = 0; round < 20; ++round) {
    std::vector<MeshPart> parts;
    for (int p = 0; p < 4; ++p) {
      Mesh cloud;
      cloud.vertices = random.positions(60, 1);
      if (round % 2 == 0) cloud.vertices = (cloud.vertices * 4).array().round() / 4;  // many at the same place
      parts.push_back({"", std::move(cloud)});
    }
    for (const Real weld : {0.0, 0.1, 0.4, 10.0}) {
      const std::vector<Index> target = slowly_merged(parts, weld);
      Index kept = 0;
      for (std::size_t v = 0; v < target.size(); ++v) kept += target[v] == static_cast<Index>(v) ? 1 : 0;
      CHECK(join(parts, weld).vertex_count() == kept);
    }
  }
}

TEST_CASE("parts of one name are one group; the groups of parts are kept") {
  const Mesh cushion = pillow({.columns = 4, .rows = 4, .size = {1, 1}});
  const Mesh inner = join(std::vector<MeshPart>{{"a", cushion}, {"a", moved(cushion, {0, 5, 0})}});
  CHECK(inner.vertex_groups.size() == 1);
  const Mesh whole = join(std::vector<MeshPart>{{"rope", chain({})}, {"both", inner}});
  CHECK(vertex_group(whole, "a").vertices.size() == 40);
  CHECK(vertex_group(whole, "a").vertices.front() == 11);
  CHECK(vertex_group(whole, "both").vertices == vertex_group(whole, "a").vertices);
  const auto front = std::ranges::find(whole.groups, "front", &FaceGroup::name);
  REQUIRE(front != whole.groups.end());
  CHECK(front->faces.size() == 36);
}

TEST_CASE("vertex maps go along, 0 where a part has none; a shared vertex has the later part's number") {
  Mesh hot = chain({.links = 1, .length = 1, .direction = {1, 0, 0}});
  hot.maps = {{"heat", {5, 6}}};
  Mesh cold = moved(hot, {1, 0, 0});
  cold.maps = {{"heat", {1, 2}}, {"age", {7, 8}}};
  const Mesh whole = join(std::vector<MeshPart>{{"", hot}, {"", chain({.links = 1})}, {"", cold}}, 1e-9);
  REQUIRE(whole.maps.size() == 2);
  CHECK(whole.maps[0].name == "heat");
  CHECK(whole.maps[0].values == std::vector<Real>{5, 1, 0, 2});  // the chain's head is welded to the first vertex
  CHECK(whole.maps[1].values == std::vector<Real>{0, 7, 0, 8});

  Mesh point = mesh_of({{0, 0, 0}});
  for (int i = 0; i < 2000; ++i) point.maps.push_back({std::to_string(i), {1}});
  const std::vector<MeshPart> greedy = {{"", point}, {"", grid({.columns = 100, .rows = 100})}};
  CHECK(contains(error_of([&] { join(greedy); }), "the parts have 2000 vertex maps of different names, for 10001"));
}

TEST_CASE("what joining refuses") {
  constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  const std::vector<MeshPart> ropes = {{"rope", chain({})}};
  CHECK(contains(error_of([&] { join(ropes, -1); }), "weld: -1 is out of range"));
  CHECK(contains(error_of([&] { join(ropes, nan); }), "weld: nan is out of range"));
  std::vector<MeshPart> bad = {{"", chain({})}, {"bad", mesh_of({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 7}})}};
  CHECK(contains(error_of([&] { join(bad, 0); }), "part 'bad': triangle 0"));
  // Every vertex of the one is as far from every vertex of the other: nearest is a matter of rounding, and of hours.
  const std::vector<MeshPart> nested = {{"", sphere({.subdivisions = 6, .radius = 1})},
                                        {"", sphere({.subdivisions = 6, .radius = 1e-9})}};
  CHECK(contains(error_of([&] { join(nested, 2); }), "weld: 2 m reaches too many vertices; give a smaller one"));
  CHECK(join(nested, 1e-12).vertex_count() == 2 * 40962);
  bad[1] = {"", mesh_of({{0, nan, 0}})};
  CHECK(contains(error_of([&] { join(bad, 0); }), "part 1: "));
}

}  // namespace test_join
