#include <string>

#include <doctest/doctest.h>

#include "tests/mesh/files.h"

namespace test_off {

using namespace pliant;
using namespace pliant_tests;

namespace {

const std::string quad = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

Mesh parsed(const std::string& text) {
  return parse_mesh(text, "a", require_mesh_format("x.off"));
}

std::string refusal(const std::string& text) {
  return refusal_of(text, require_mesh_format("x.off"));
}

}  // namespace

TEST_CASE("every form of the head of an OFF file") {
  const Mesh expected = parsed("OFF\n4 1 0\n" + quad + "4 0 1 2 3\n");
  CHECK(expected.vertices == mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).vertices);
  CHECK(expected.faces.offsets == std::vector<Index>{0, 4});
  CHECK(expected.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  for (const std::string head : {"OFF 4 1 0\n", "OFF # one\n\n# two\n4 1\n", "4 1 5\n", "\n  OFF\r\n\r\n4 1 0\r\n",
                                 "\xEF\xBB\xBFOFF\r4 1 0\r"}) {
    CAPTURE(head);
    check_same(parsed(head + quad + "4 0 1 2 3\n"), expected);
    check_same(parsed(head + "# c\n" + quad + "\n 4\t0 1 2 3 # c\n# the end"), expected);
  }
}

TEST_CASE("colors of faces are dropped, two corners make an edge, one makes nothing") {
  const Mesh mesh =
      parsed("OFF\n4 6 0\n" + quad + "3 0 1 2 255 0 0\n3 0 2 3 0.1 0.2 0.3 1\n3 1 2 3 7\n2 0 2\n1 3\n2 3 1 0\n");
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {1, 2, 3}});
  CHECK(mesh.edges == std::vector<Edge>{{0, 2}, {3, 1}});
  check_same(written_and_read(mesh, "b.off"), mesh);
}

TEST_CASE("normals are dropped, colors and texture coordinates kept") {
  const Mesh normals = parsed("NOFF\n1 0 0\n1 2 3 0 0 1\n");
  CHECK(normals.vertices == mesh_of({{1, 2, 3}}).vertices);
  CHECK(normals.maps.empty());

  const Mesh colors = parsed("COFF\n3 1 0\n1 2 3 255 7 0\n4 5 6 0 0 0\n0 0 0 1 1 1\n3 0 1 2\n");
  REQUIRE(colors.maps.size() == 3);
  CHECK(colors.maps[0].name == "red");
  CHECK(colors.maps[0].values == std::vector<Real>{255, 0, 1});
  CHECK(colors.maps[1].values == std::vector<Real>{7, 0, 1});
  check_same(written_and_read(colors, "b.off"), colors);
  // Bytes in PLY as well; in OBJ from 0 to 1.
  check_same(written_and_read(colors, "b.ply"), colors);

  const Mesh all = parsed(
      "STCNOFF\n3 1 0\n1 2 3 0 0 1 .1 .2 .3 .4 .5 .6\n4 5 6 0 0 1 1 1 1 1 1 1\n"
      "7 8 9 0 0 1 0 0 0 0 0 0\n3 0 1 2\n");
  REQUIRE(all.maps.size() == 4);
  CHECK(all.maps[3].name == "alpha");
  CHECK(all.maps[3].values == std::vector<Real>{0.4, 1, 0});
  CHECK(all.texture_coordinates(0, 0) == 0.5);
  CHECK(all.faces.texture_coordinates == std::vector<Index>{0, 1, 2});
  check_same(written_and_read(all, "b.off"), all);
}

TEST_CASE("a malformed OFF file is refused with its place") {
  const auto check = [](const std::string& text, const std::string& start) {
    const std::string message = refusal(text);
    CAPTURE(message);
    CHECK(message.starts_with(start));
    CHECK(message.find("; ") != std::string::npos);
  };
  check("", "a:1: the file ends before its counts;");
  check("OFF\n", "a:2: the file ends before its counts;");
  check("solid x\n", "a:1: starts with \"solid\", not with \"OFF\";");
  check("OFF BINARY\n", "a:1: binary OFF;");
  check("4OFF\n4 1 0\n", "a:1: \"4OFF\": vertices of another dimension than 3;");
  check("nOFF\n4\n4 1 0\n", "a:1: \"nOFF\": vertices");
  check("OFF\n4\n", "a:2: no count of faces;");
  check("OFF\n-4 1 0\n", "a:2: -4 vertices;");
  check("OFF\n4.5 1 0\n", "a:2: \"4.5\" is not an index;");
  check("OFF\n0 0 0\n", "a:2: no vertices;");
  check("OFF\n2000000000 1 0\n" + quad, "a:2: 2000000000 vertices and 1 faces are more than");
  check("OFF\n4 2000000000 0\n" + quad, "a:2: 4 vertices and 2000000000 faces are more than");
  check("OFF\n5 0 0\n" + quad, "a:7: the file ends before its last vertex;");
  check("OFF\n4 2 0\n" + quad + "3 0 1 2\n", "a:8: the file ends before its last face;");
  check("OFF\n4 0 0\n" + quad + "3 0 1 2\n", "a:7: more lines than the counts at the top say;");
  check("OFF\n3 0 0\n0 0 0\n0 0\n0 0 0\n", "a:4: 2 numbers for a vertex, which has 3 here;");
  check("OFF\n3 0 0\n0 0 0\n0 0 0 0\n0 0 0\n", "a:4: 4 numbers for a vertex, which has 3 here;");
  check("COFF\n1 0 0\n0 0 0\n", "a:3: 3 numbers for a vertex, which has 6 here;");
  check("COFF\n1 0 0\n0 0 0" + std::string(20, ' ') + "1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1\n", "a:3: too many numbers");
  check("OFF\n1 0 0\n0 nan 0\n", "a:3: \"nan\" is not finite;");
  check("OFF\n4 1 0\n" + quad + "3 0 1 4\n", "a:7: vertex 4 is out of range, since the file has 4;");
  check("OFF\n4 1 0\n" + quad + "3 0 1 -1\n", "a:7: vertex -1 is out of range,");
  check("OFF\n4 1 0\n" + quad + "3 0 1\n", "a:7: 2 of the 3 corners of a face;");
  check("OFF\n4 1 0\n" + quad + "3 0 1 1\n", "a:7: a face with vertex 1 at two corners;");
  check("OFF\n4 1 0\n" + quad + "0\n", "a:7: a face with 0 corners;");
  check("OFF\n4 1 0\n" + quad + "2 1 1\n", "a:7: an edge from vertex 1 to itself;");
  check(std::string("OFF\n4 1 0\n0 \0 0\n", 16), "a:");
}

}  // namespace test_off
