#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "tests/mesh/files.h"

namespace test_tetrahedron_files {

using namespace pliant;
using namespace pliant_tests;

namespace {

const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string format_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string points = "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";

std::string elements(const std::string& rows, int count) {
  return "$Elements\n" + std::to_string(count) + "\n" + rows + "$EndElements\n";
}

Mesh gmsh(const std::string& text) {
  return parse_mesh(text, "a", require_mesh_format("x.msh"));
}

Mesh tetgen(const std::string& text) {
  return parse_mesh(text, "a", require_mesh_format("x.ele"));
}

}  // namespace

TEST_CASE("tetrahedra of Gmsh, turned to a positive volume, without the elements of their surface") {
  const std::string rows = "1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 2 2 0 1 1 2 3\n4 4 2 7 1 1 2 3 4\n5 4 0 1 2 4 3\n";
  const Mesh mesh =
      gmsh(format + "$PhysicalNames\n1\n3 7 \"bunny $Nodes\"\n$EndPhysicalNames\n" + nodes + elements(rows, 5));
  CHECK(mesh.vertices == mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).vertices);
  CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}, {0, 1, 2, 3}});
  CHECK(mesh.triangles.empty());
  CHECK(mesh.edges.empty());
  CHECK(mesh.faces.face_count() == 0);
  check_mesh(mesh, "a");
}

TEST_CASE("version 4.1, in blocks, with tags in any order") {
  const std::string four =
      "$Nodes\n4 4 10 99\n0 1 0 1\n99\n0 0 0\n1 1 0 0\n2 1 1 2\n10\n50\n1 0 0 .1 .2\n0 1 0 .1 .2\n"
      "3 1 0 1\n11\n0 0 1\n$EndNodes\n";
  const Mesh solid = gmsh(format_4 + "$Entities\n0 0 0 0\n$EndEntities\n" + four +
                          "$Elements\n2 2 1 2\n2 1 2 1\n1 99 10 50\n3 1 4 1\n2 99 10 50 11\n$EndElements\n");
  CHECK(solid.vertices == mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).vertices);
  CHECK(solid.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}});
  const Mesh surface =
      gmsh(format_4 + four + "$Elements\n2 3 1 3\n1 1 1 1\n3 99 10\n2 1 3 1\n1 99 10 50 11\n$EndElements\n");
  CHECK(surface.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(surface.faces.offsets == std::vector<Index>{0, 4});
  CHECK(surface.edges.empty());
  CHECK(gmsh(format_4 + four + "$Elements\n1 1 1 1\n1 1 1 1\n3 99 10\n$EndElements\n").edges ==
        std::vector<Edge>{{0, 1}});
}

TEST_CASE("tags of nodes at both ends of what a number holds") {
  for (const auto& [first, second] : {std::pair{"9223372036854775807", "-9223372036854775808"},
                                      std::pair{"-9223372036854775808", "9223372036854775807"},
                                      std::pair{"9223372036854775806", "9223372036854775807"}}) {
    const std::string two = fmt::format("$Nodes\n2\n{} 0 0 0\n{} 1 0 0\n$EndNodes\n", first, second);
    const Mesh mesh = gmsh(format + two + elements(fmt::format("1 1 0 {} {}\n", second, first), 1));
    CHECK(mesh.edges == std::vector<Edge>{{1, 0}});
  }
}

TEST_CASE("a tetrahedron that rounding makes inverted in either order keeps the order of the file") {
  const std::string flat = "4 3 0 0\n0 11 5475807 0\n1 1 0 0\n2 1 1 12147483647e8\n3 1 0 1\n";
  const Mesh mesh = tetgen(flat + "1 4 0\n0 0 3 1 2\n");
  CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 3, 1, 2}});
  check_same_elements(written_and_read(mesh, "b.msh"), mesh);
}

TEST_CASE("what Gmsh holds is written and read back") {
  for (const Mesh& mesh : {bar({.cells = {2, 1, 1}}), grid({}), chain({})}) {
    const Mesh once = written_and_read(mesh, "b.msh");
    check_same_elements(once, mesh);
    check_same(written_and_read(once, "b.msh"), once);
  }
  const Mesh pentagon =
      parse_mesh("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n", "a", require_mesh_format("x.obj"));
  CHECK(written_and_read(pentagon, "b.msh").triangles == pentagon.triangles);
}

TEST_CASE("a malformed .msh file is refused with its place") {
  const auto check = [](const std::string& text, const std::string& start) {
    const std::string message = refusal_of(text, require_mesh_format("x.msh"));
    CAPTURE(message);
    CHECK(message.starts_with(start));
    CHECK(message.find("; ") != std::string::npos);
  };
  check("", "a: no $Nodes;");
  check("OFF\n", "a:1: \"OFF\" in place of a section;");
  check(nodes, "a:2: no $MeshFormat before this section;");
  check("$MeshFormat\n3 0 8\n$EndMeshFormat\n", "a:2: version \"3\";");
  check("$MeshFormat\n4.1 1 8\n$EndMeshFormat\n", "a:2: binary .msh;");
  check("$MeshFormat\n2.2 0 8\n", "a:3: the file ends within a section;");
  check(format + "$Comments\nx\n", "a:6: the file ends within a section;");
  check(format + nodes, "a: no $Elements;");
  check(format + nodes + nodes, "a:11: $Nodes twice;");
  check(format + "$Nodes\n2000000000\n1 0 0 0\n$EndNodes\n", "a:5: a count of 2000000000,");
  check(format + "$Nodes\n-1\n$EndNodes\n", "a:5: a count of -1,");
  check(format + "$Nodes\n2\n1 0 0 0\n1 0 0 1\n$EndNodes\n", "a:7: node 1 twice;");
  check(format + "$Nodes\n1\n1 0 0\n$EndNodes\n", "a:6: \"\" is not a number;");
  check(format + "$Nodes\n1\n1 0 0 nan\n$EndNodes\n", "a:6: \"nan\" is not finite;");
  check(format + "$Nodes\n1\n1 0 0 0\n2 0 0 0\n$EndNodes\n", "a:7: \"2\" in place of the end of $Nodes;");
  check(format + nodes + elements("1 4 0 1 2 3 5\n", 1), "a:13: node 5 is not among the nodes above;");
  check(format + nodes + elements("1 4 0 1 2 3 3\n", 1), "a:13: a tetrahedron with point 2 at two corners;");
  check(format + nodes + elements("1 2 0 1 2 2\n", 1), "a:13: a face with vertex 1 at two corners;");
  check(format + nodes + elements("1 1 0 1 1\n", 1), "a:13: a line from vertex 0 to itself;");
  check(format + nodes + elements("1 5 0 1 2 3 4 1 2 3 4\n", 1), "a:13: an element of type 5;");
  check(format + nodes + elements("1 4 9 1 2\n", 1), "a:13: an element that ends within its tags;");
  check(format + nodes + elements("1 4 0 1 2 3\n", 1), "a:13: \"\" is not an index;");
}

TEST_CASE("TetGen's files, numbered from 0 or from 1, in two files or one text") {
  const Mesh mesh = tetgen("# points\n" + points + "# tetrahedra\n2 4 1\n0 0 1 2 3 7\n1 0 1 3 2 7\n");
  CHECK(mesh.vertices == mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).vertices);
  CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}, {0, 1, 2, 3}});
  CHECK(mesh.maps.empty());
  const std::string from_one = "4 3 2 1\n1 0 0 0 .1 .2 5\n2 1 0 0 0 0 0\n3 0 1 0 0 0 0\n4 0 0 1 0 0 0\n";
  const std::string element = "1 4 0\n1 1 2 3 4\n";
  const Mesh other = tetgen(from_one + element);
  CHECK(other.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}});
  REQUIRE(other.maps.size() == 3);
  CHECK(other.maps[1].name == "attribute2");
  CHECK(other.maps[1].values[0] == 0.2);
  CHECK(other.maps[2].name == "marker");
  CHECK(other.maps[2].values[0] == 5);

  const TemporaryFolder folder;
  folder.write("a.1.node", from_one);
  folder.write("a.1.ele", element);
  check_same(read_mesh(folder.path() / "a.1.node"), other);
  check_same(read_mesh(folder.path() / "a.1.ele"), other);
  folder.write("b.node", from_one);
  CHECK(contains(error_of([&] { read_mesh(folder.path() / "b.node"); }), "b.ele: no such file;"));
  CHECK(contains(error_of([&] { write_mesh(folder.path() / "c.node", mesh, mesh.vertices); }),
                 "tetgen files are read, not written; write .obj"));
}

TEST_CASE("malformed TetGen files are refused with their place") {
  const auto check = [](const std::string& text, const std::string& start) {
    const std::string message = refusal_of(text, require_mesh_format("x.ele"));
    CAPTURE(message);
    CHECK(message.starts_with(start));
    CHECK(message.find("; ") != std::string::npos);
  };
  check("", "a:1: the file ends before its last points;");
  check("0 3 0 0\n", "a:1: 0 points, but");
  check("2000000000 3 0 0\n0 0 0 0\n", "a:1: 2000000000 points, but");
  check("1 2 0 0\n0 0 0\n", "a:1: points of dimension 2;");
  check("1 3 1000 0\n0 0 0 0\n", "a:1: 1000 attributes of a point;");
  check("1 3 0 0\n5 0 0 0\n", "a:2: point 5 in place of 0;");
  check("2 3 0 0\n1 0 0 0\n3 0 0 0\n", "a:3: point 3 in place of 2;");
  check("1 3 0 0\n0 0 0 x\n", "a:2: \"x\" is not a number;");
  check("1 3 0 0\n0 0 0\n", "a:2: \"\" is not a number;");
  check(points, "a:6: the file ends before its last tetrahedra;");
  check(points + "1 10 0\n0 0 1 2 3 0 1 2 3 0 1\n", "a:6: tetrahedra of 10 points;");
  check(points + "1 4 0\n0 0 1 2 4\n", "a:7: point 4 is out of range; use 0 to 3");
  check(points + "1 4 0\n0 0 1 2 -1\n", "a:7: point -1 is out of range;");
  check(points + "1 4 0\n0 0 1 2 2\n", "a:7: a tetrahedron with point 2 at two corners;");
  check(points + "1 4 0\n0 0 1 2 3\n1 0 1 2 3\n", "a:8: more rows than the first line counts;");
  check(points + "3 4 0\n0 0 1 2 3 # and two more\n", "a:8: the file ends before its last tetrahedra;");
}

}  // namespace test_tetrahedron_files
