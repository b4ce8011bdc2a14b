#include <doctest/doctest.h>

#include "pliant/mesh/loose.h"

namespace test_loose {

using namespace pliant;

TEST_CASE("a vertex is loose when no element of any kind has it") {
  Mesh mesh;
  mesh.vertices = Positions::Zero(9, 3);
  CHECK(loose_vertices(mesh).size() == 9);
  mesh.edges = {{8, 1}};
  mesh.triangles = {{1, 2, 4}};
  mesh.tetrahedra = {{1, 2, 4, 6}};
  CHECK(loose_vertices(mesh) == std::vector<Index>{0, 3, 5, 7});
  mesh.faces = {{0, 3}, {3, 1, 2}, {}};
  CHECK(loose_vertices(mesh) == std::vector<Index>{0, 5, 7});
}

TEST_CASE("loose vertices are dropped, and all that refers to the others follows") {
  Mesh mesh;
  mesh.vertices.resize(6, 3);
  for (Index v = 0; v < 6; ++v) mesh.vertices.row(v).setConstant(v);
  mesh.triangles = {{1, 3, 4}};
  mesh.edges = {{4, 1}};
  mesh.faces = {{0, 3}, {1, 3, 4}, {}};
  mesh.vertex_groups = {{"all", {0, 1, 2, 3, 4, 5}}, {"loose", {2}}};
  mesh.maps = {{"own", {0, 10, 20, 30, 40, 50}}};
  CHECK(drop_loose_vertices(mesh) == 3);
  REQUIRE(mesh.vertex_count() == 3);
  CHECK(mesh.vertices.col(2) == Eigen::Vector3d(1, 3, 4));
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(mesh.edges == std::vector<Edge>{{2, 0}});
  CHECK(mesh.faces.vertices == std::vector<Index>{0, 1, 2});
  CHECK(mesh.vertex_groups[0].vertices == std::vector<Index>{0, 1, 2});
  CHECK(mesh.vertex_groups[1].vertices.empty());
  CHECK(mesh.maps[0].values == std::vector<Real>{10, 30, 40});
  CHECK(drop_loose_vertices(mesh) == 0);
  CHECK(mesh.vertex_count() == 3);
}

}  // namespace test_loose
