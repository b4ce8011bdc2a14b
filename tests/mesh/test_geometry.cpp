#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "tests/mesh/meshes.h"

namespace test_geometry {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real not_a_number = std::numeric_limits<Real>::quiet_NaN();
constexpr Real infinity = std::numeric_limits<Real>::infinity();

std::string refusal(const Mesh& mesh) {
  return error_of([&] { check_mesh(mesh, "flag"); });
}

Mesh corner() {
  return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}

}  // namespace

TEST_CASE("areas, volumes, lengths and normals of known elements") {
  const Mesh mesh = mesh_of({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, 2}}, {{0, 1, 2}, {0, 2, 1}, {0, 1, 1}});
  CHECK(triangle_areas(mesh.vertices, mesh.triangles) == std::vector<Real>{6, 6, 0});
  CHECK(vertex_areas(mesh.vertices, mesh.triangles) == std::vector<Real>{4, 4, 4, 0});
  const Positions normals = triangle_normals(mesh.vertices, mesh.triangles);
  CHECK(row(normals, 0) == Vec3(0, 0, 1));
  CHECK(row(normals, 1) == Vec3(0, 0, -1));
  CHECK(row(normals, 2) == Vec3(0, 0, 0));
  const std::vector<Tetrahedron> tetrahedra{{0, 1, 2, 3}, {1, 0, 2, 3}};
  CHECK(tetrahedron_volumes(mesh.vertices, tetrahedra) == std::vector<Real>{4, -4});
  const std::vector<Edge> edges{{1, 2}, {0, 3}};
  CHECK(edge_lengths(mesh.vertices, edges) == std::vector<Real>{5, 2});
}

TEST_CASE("areas and volumes do not change with a rotation, and scale with their power") {
  const Vec3 a(0.1, 0.2, 0.3), b(1.1, -0.4, 0.9), c(-0.3, 0.8, 2.1), d(0.7, 1.3, -0.2);
  const Mat3 turn = Eigen::AngleAxis<Real>(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Vec3 shift(5, -7, 2);
  const auto moved = [&](const Vec3& x) -> Vec3 { return turn * x * 3 + shift; };
  CHECK(triangle_area(moved(a), moved(b), moved(c)) == doctest::Approx(9 * triangle_area(a, b, c)).epsilon(1e-14));
  CHECK(tetrahedron_volume(moved(a), moved(b), moved(c), moved(d)) ==
        doctest::Approx(27 * tetrahedron_volume(a, b, c, d)).epsilon(1e-14));
}

TEST_CASE("the bounding box and its diagonal") {
  const BoundingBox box = bounding_box(mesh_of({{1, -2, 3}, {-1, 0, 5}, {0, 4, 4}}).vertices);
  CHECK(box.min == Vec3(-1, -2, 3));
  CHECK(box.max == Vec3(1, 4, 5));
  CHECK(box.diagonal() == doctest::Approx(std::sqrt(4 + 36 + 4)).epsilon(1e-15));
  CHECK(bounding_box(Positions(0, 3)).diagonal() == 0);
}

TEST_CASE("meshes that look odd but can be simulated are accepted") {
  CHECK(refusal(moebius_strip(9)) == "");
  CHECK(refusal(book_of_three_pages()) == "");
  CHECK(refusal(joined(book_of_three_pages(), chain({}))) == "");
  CHECK(refusal(corner()) == "");
  for (const Real scale : {1e-100, 1e-9, 1e9, 1e99}) {
    Mesh bar_of_six = bar({.cells = {1, 1, 1}, .size = {scale, scale, scale}});
    CHECK(refusal(bar_of_six) == "");
  }
  // Long, but with area: 1e-10 of its length.
  CHECK(refusal(mesh_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1e-10, 0}}, {{0, 1, 2}})) == "");
}

TEST_CASE("an empty mesh and vertices that are nowhere are refused by name") {
  CHECK(refusal(Mesh{}) == "flag: the mesh has no vertices; give at least one");
  for (const Real bad : {not_a_number, infinity, -infinity}) {
    Mesh mesh = corner();
    mesh.vertices(2, 1) = bad;
    CHECK(contains(refusal(mesh), "flag: vertex 2 is not finite: (0, "));
  }
  Mesh mesh = corner();
  mesh.vertices(3, 0) = -1e101;
  CHECK(contains(refusal(mesh), "flag: vertex 3 lies too far out"));
}

TEST_CASE("a bad index names the element, the vertex and the count") {
  Mesh mesh = corner();
  SUBCASE("triangle, past the end") {
    mesh.triangles = {{0, 1, 2}, {1, 2, 4}};
    CHECK(refusal(mesh) ==
          "flag: triangle 1 (vertices 1, 2, 4) refers to vertex 4, but the mesh has 4 vertices; use indices 0 to 3");
  }
  SUBCASE("edge, negative") {
    mesh.edges = {{-1, 2}};
    CHECK(contains(refusal(mesh), "flag: edge 0 (vertices -1, 2) refers to vertex -1"));
  }
  SUBCASE("tetrahedron") {
    mesh.tetrahedra = {{0, 1, 2, 9}};
    CHECK(contains(refusal(mesh), "flag: tetrahedron 0 (vertices 0, 1, 2, 9) refers to vertex 9"));
  }
  SUBCASE("repeated vertices") {
    mesh.triangles = {{0, 1, 2}, {3, 1, 3}};
    CHECK(refusal(mesh) ==
          "flag: triangle 1 (vertices 3, 1, 3) has vertex 3 twice; give it 3 different vertices or remove it");
    mesh.triangles.clear();
    mesh.edges = {{2, 2}};
    CHECK(contains(refusal(mesh), "flag: edge 0 (vertices 2, 2) has vertex 2 twice"));
    mesh.edges.clear();
    mesh.tetrahedra = {{0, 1, 2, 1}};
    CHECK(contains(refusal(mesh), "flag: tetrahedron 0 (vertices 0, 1, 2, 1) has vertex 1 twice"));
  }
  SUBCASE("polygons") {
    mesh.faces.vertices = {0, 1, 2};
    CHECK(contains(refusal(mesh), "do not match"));
    mesh.faces.offsets = {0, 3};
    CHECK(refusal(mesh) == "");
    mesh.faces.texture_coordinates = {-1, 0, -1};
    CHECK(contains(refusal(mesh), "flag: polygon corner 1 refers to texture coordinate 0, but the mesh has 0"));
    mesh.texture_coordinates.resize(1, 2);
    CHECK(refusal(mesh) == "");
    mesh.faces.vertices[2] = 4;
    CHECK(contains(refusal(mesh), "flag: polygon corner 2 refers to vertex 4, but the mesh has 4"));
  }
}

TEST_CASE("elements without extent are refused, relative to their own size") {
  for (const Real scale : {1e-60, 1.0, 1e60}) {
    Mesh mesh = mesh_of({{0, 0, 0}, {scale, 0, 0}, {2 * scale, 0, 0}, {0, scale, 0}, {scale, scale, 0}});
    mesh.triangles = {{0, 1, 3}, {0, 1, 2}};
    CHECK(refusal(mesh) ==
          "flag: triangle 1 (vertices 0, 1, 2) has zero area; move its vertices off one line or remove it");
    mesh.triangles = {{0, 1, 2}};
    mesh.vertices(1, 1) = 1e-13 * scale;
    CHECK(contains(refusal(mesh), "triangle 0 (vertices 0, 1, 2) has zero area"));
    mesh.triangles.clear();
    mesh.tetrahedra = {{0, 1, 3, 4}};
    CHECK(contains(refusal(mesh), "flag: tetrahedron 0 (vertices 0, 1, 3, 4) has zero volume"));
  }
  Mesh mesh = mesh_of({{1, 1, 1}, {2, 1, 1}, {1, 1, 1}, {1 + 1e-16, 1, 1 - 2e-16}});
  mesh.edges = {{0, 1}, {0, 2}};
  CHECK(refusal(mesh) == "flag: edge 1 (vertices 0, 2) has zero length; move its ends apart or remove it");
  mesh.edges[1] = {0, 3};
  CHECK(contains(refusal(mesh), "edge 1 (vertices 0, 3) has zero length"));
}

TEST_CASE("an inverted tetrahedron is told from a flat one") {
  Mesh mesh = corner();
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 3}};
  CHECK(refusal(mesh) ==
        "flag: tetrahedron 1 (vertices 0, 2, 1, 3) is inverted, its volume is -0.167 m^3; swap two of its vertices");
}

}  // namespace test_geometry
