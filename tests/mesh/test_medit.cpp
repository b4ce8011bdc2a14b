#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "tests/mesh/files.h"

namespace test_medit {

using namespace pliant;
using namespace pliant_tests;

namespace {

const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
const std::string vertices = "Vertices\n4\n0 0 0 5\n1 0 0 0\n0 1 0 5\n0 0 1 -2\n";

Mesh medit(const std::string& text) {
  return parse_mesh(text, "a", require_mesh_format("a.mesh"));
}

const VertexGroup& group_of(const Mesh& mesh, std::string_view name) {
  const auto found = std::ranges::find(mesh.vertex_groups, name, &VertexGroup::name);
  REQUIRE(found != mesh.vertex_groups.end());
  return *found;
}

}  // namespace

TEST_CASE("faces of MEDIT in the file's order, their references as groups, without their borders") {
  const Mesh mesh =
      medit(head + vertices + "Quadrilaterals\n1\n1 2 3 4 7\nTriangles\n2\n1 2 3 0\n2 3 4 7\nEdges\n1\n1 2 3\nEnd\n");
  CHECK(mesh.vertices == mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).vertices);
  CHECK(mesh.faces.offsets == std::vector<Index>{0, 4, 7, 10});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {1, 2, 3}});
  CHECK(mesh.edges.empty());
  REQUIRE(mesh.groups.size() == 1);
  CHECK(mesh.groups[0].name == "faces 7");
  CHECK(mesh.groups[0].faces == std::vector<Index>{0, 2});
  CHECK(mesh.vertex_groups.size() == 3);
  CHECK(group_of(mesh, "vertices 5").vertices == std::vector<Index>{0, 2});
  CHECK(group_of(mesh, "vertices -2").vertices == std::vector<Index>{3});
  CHECK(group_of(mesh, "edges 3").vertices == std::vector<Index>{0, 1});
}

TEST_CASE("tetrahedra of MEDIT, turned to a positive volume; references of their surface are groups of vertices") {
  const Mesh mesh = medit(head + vertices + "Triangles 2\n1 2 3 9 1 2 4 9\nTetrahedra 2\n1 2 3 4 0\n1 2 4 3 6\nEnd");
  CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}, {0, 1, 2, 3}});
  CHECK(mesh.triangles.empty());
  CHECK(mesh.faces.face_count() == 0);
  CHECK(mesh.groups.empty());
  CHECK(group_of(mesh, "faces 9").vertices == std::vector<Index>{0, 1, 2, 3});
  CHECK(group_of(mesh, "tetrahedra 6").vertices == std::vector<Index>{0, 1, 2, 3});
  check_mesh(mesh, "a");
}

TEST_CASE("MEDIT's words stand on any line, of the plane too, and unknown sections are passed over") {
  const Mesh mesh = medit(
      "MeshVersionFormatted\n1 # a comment\nDimension 2 Vertices 3 0 0 0 1\n0 0 0 2 0\nCorners 2\n1 3\nHexahedra 0\n"
      "Edges 2 1 2 0 2 3 0 RequiredVertices 1 2 End\nwhat follows does not count\n");
  CHECK(mesh.vertices == mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}).vertices);
  CHECK(mesh.edges == std::vector<Edge>{{0, 1}, {1, 2}});
  CHECK(mesh.vertex_groups.empty());
}

TEST_CASE("what MEDIT holds is written and read back, references as well") {
  const Mesh quadrilaterals =
      medit(head + vertices + "Quadrilaterals\n1\n1 2 3 4 7\nTriangles\n2\n1 2 3 0\n2 3 4 -1\nEnd\n");
  for (const Mesh& mesh : {quadrilaterals, bar({.cells = {2, 1, 1}}), grid({}), chain({})}) {
    const Mesh once = written_and_read(mesh, "b.mesh");
    check_same_elements(once, mesh);
    check_same(written_and_read(once, "b.mesh"), once);
  }
  const Mesh again = written_and_read(quadrilaterals, "b.mesh");
  check_same(again, quadrilaterals);
  CHECK(group_of(again, "vertices 5").vertices == std::vector<Index>{0, 2});
  CHECK(group_of(again, "vertices -2").vertices == std::vector<Index>{3});
}

TEST_CASE("groups of other formats become references that no other group has") {
  const Mesh mesh = parse_mesh(
      "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\ng front\nf 1 2 3 4 5\ng faces_1\nf 1 3 2\ng back\nf 1 4 2\n", "a",
      require_mesh_format("a.obj"));
  const Mesh once = written_and_read(mesh, "b.mesh");
  CHECK(once.triangles == mesh.triangles);  // the pentagon as its fan
  REQUIRE(once.groups.size() == 3);
  CHECK(once.groups[0].name == "faces 1");
  CHECK(once.groups[0].faces == std::vector<Index>{0, 1, 2});
  CHECK(once.groups[2].name == "faces 3");
  CHECK(once.groups[2].faces == std::vector<Index>{4});
  Mesh named = grid({.columns = 2, .rows = 2});
  named.vertex_groups = {{"seam", {1}}, {"vertices 1", {0, 1}}};
  const Mesh read = written_and_read(named, "b.mesh");
  CHECK(group_of(read, "vertices 1").vertices == std::vector<Index>{0});
  CHECK(group_of(read, "vertices 2").vertices == std::vector<Index>{1});
}

TEST_CASE("a malformed .mesh file is refused with its place") {
  const auto check = [](const std::string& text, const std::string& start) {
    const std::string message = refusal_of(text, require_mesh_format("a.mesh"));
    CAPTURE(message);
    CHECK(message.starts_with(start));
    CHECK(message.find("; ") != std::string::npos);
  };
  check("", "a: not MEDIT's text;");
  check("OFF\n", "a: not MEDIT's text;");
  check("MeshVersionFormatted 9\n", "a:1: version 9;");
  check("MeshVersionFormatted\n", "a:2: the file ends within a section;");
  check("MeshVersionFormatted 2\nDimension 4\n", "a:2: dimension 4;");
  check("MeshVersionFormatted 2\nVertices 1\n0 0 0 0\nEnd\n", "a:2: no Dimension before Vertices;");
  check(head + "End\n", "a: no Vertices;");
  check(head + vertices, "a:9: the file ends before its End;");
  check(head + vertices + vertices + "End\n", "a:9: Vertices twice;");
  check(head + vertices + "1\nEnd\n", "a:9: \"1\" in place of a keyword;");
  check(head + "Vertices\n2000000000\n0 0 0 0\nEnd\n", "a:4: a count of 2000000000,");
  check(head + "Vertices\n-1\nEnd\n", "a:4: a count of -1,");
  check(head + "Vertices\n1\n0 0 nan 0\nEnd\n", "a:5: \"nan\" is not finite;");
  check(head + "Vertices\n2\n0 0 1 0\nEnd\n", "a:6: \"End\" is not a number;");
  check(head + "Triangles 1\n1 2 3 0\nEnd\n", "a:3: Triangles before the Vertices;");
  check(head + vertices + "Tetrahedra 1\n1 2 3 5 0\nEnd\n", "a:10: vertex 5 is out of range; use 1 to 4");
  check(head + vertices + "Tetrahedra 1\n1 2 3 0 0\nEnd\n", "a:10: vertex 0 is out of range;");
  check(head + vertices + "Tetrahedra 1\n1 2 3 3 0\nEnd\n", "a:10: a tetrahedron with point 3 at two corners;");
  check(head + vertices + "Triangles 1\n1 2 2 0\nEnd\n", "a:10: a face with vertex 2 at two corners;");
  check(head + vertices + "Edges 1\n1 1 0\nEnd\n", "a:10: an edge from vertex 1 to itself;");
  check(head + vertices + "Hexahedra 1\n1 2 3 4 1 2 3 4 0\nEnd\n", "a:9: Hexahedra;");
}

}  // namespace test_medit
