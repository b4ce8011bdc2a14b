// VTK's legacy files; test_vtu.cpp has those of XML.
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant/mesh/geometry.h"
#include "tests/mesh/files.h"

namespace test_vtk {

using namespace pliant;
using namespace pliant_tests;

namespace {

const std::string ascii = "# vtk DataFile Version 3.0\na title\nASCII\n";
const std::string grid_head = ascii + "DATASET UNSTRUCTURED_GRID\n";
const std::string surface_head = ascii + "DATASET POLYDATA\n";
const std::string points = "POINTS 5 float\n0 0 0 1 0 0\n0 1 0\n0 0 1 1 1 1\n";

Mesh vtk(const std::string& text) {
  return parse_mesh(text, "a", require_mesh_format("a.vtk"));
}

const Positions five = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}).vertices;

/// The bytes of numbers, the highest first.
template <class Number>
std::string big_endian(const std::vector<Number>& numbers) {
  std::string bytes;
  for (const Number number : numbers) {
    const char* raw = reinterpret_cast<const char*>(&number);
    for (std::size_t i = sizeof number; i > 0; --i) bytes += raw[i - 1];
  }
  return bytes;
}

}  // namespace

TEST_CASE("cells of a legacy grid in the file's order") {
  const Mesh mesh =
      vtk(grid_head + points +
          "CELLS 6 24\n3 0 1 2\n4 0 1 2 4\n4 0 1 2 3\n3 1 2 4\n1 0\n3 3 4 0\n"
          "CELL_TYPES 6\n5\n9\n8\n7\n1\n4\nPOINT_DATA 5\nSCALARS a float\nLOOKUP_TABLE default\n1 2 3 4 5\n");
  CHECK(mesh.vertices == five);
  CHECK(mesh.faces.offsets == std::vector<Index>{0, 3, 7, 11, 14});
  CHECK(mesh.faces.vertices == std::vector<Index>{0, 1, 2, 0, 1, 2, 4, 0, 1, 3, 2, 1, 2, 4});
  CHECK(mesh.triangles.size() == 6);
  CHECK(mesh.edges == std::vector<Edge>{{3, 4}});  // that from 4 to 0 is an edge of a face
  CHECK(mesh.tetrahedra.empty());
}

TEST_CASE("tetrahedra of a legacy grid are turned to a positive volume, and stay without their borders") {
  const Mesh mesh =
      vtk(grid_head + points + "CELLS 4 18\n4 0 1 2 3\n4 0 1 3 2\n3 0 1 2\n3 0 1 4\nCELL_TYPES 4\n10 10 5 4\n");
  CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}, {0, 1, 2, 3}});
  CHECK(mesh.triangles.empty());
  CHECK(mesh.faces.face_count() == 0);
  CHECK(mesh.edges == std::vector<Edge>{{1, 4}});
}

TEST_CASE("POLYDATA: vertices, polylines, polygons and strips") {
  const Mesh mesh = vtk(surface_head + points +
                        "METADATA\nINFORMATION 1\nNAME a LOCATION b\nDATA 1\n \nVERTICES 1 2\n1 4\n"
                        "LINES 1 4\n3 3 4 2\nPOLYGONS 1 5\n4 0 1 4 2\nTRIANGLE_STRIPS 1 6\n5 0 1 2 2 3\nCELL_DATA 3\n");
  CHECK(mesh.vertices == five);
  CHECK(mesh.edges == std::vector<Edge>{{3, 4}});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 4}, {0, 4, 2}, {0, 1, 2}});
}

TEST_CASE("words of a legacy file stand on any line, in either case, and fields are passed over") {
  const Mesh mesh = vtk(
      "\xEF\xBB\xBF#  vtk\tDataFile  Version 2.0 \r\n\r\nascii\r\ndataset\r\npolydata\r\nField FieldData 2\r\n"
      "TIME 1 1 double 0.5\r\nb 2 2 int 1 2 3 4\r\npoints 3 Double 0 0 0\r\n1 0 0 0 1 0 polygons 1\r\n4 3 0 1\r\n2");
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("version 5.1 has offsets and connectivity") {
  const std::string head = "# vtk DataFile Version 5.1\n\nASCII\nDATASET UNSTRUCTURED_GRID\n" + points;
  const std::string cells = "CELLS 3 7\nOFFSETS vtktypeint64\n0 3 7 \nCONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3\n";
  CHECK(vtk(head + cells + "CELL_TYPES 2\n5\n10\n").tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}});
  const std::string message =
      refusal_of(head + "CELLS 3 7\nOFFSETS vtktypeint64\n0 3 2 \nCONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3\n",
                 require_mesh_format("a.vtk"));
  CHECK(message.starts_with("a:11: offset 2 is 2, behind 3 and for 7 vertices;"));
}

TEST_CASE("binary legacy files, of every type of numbers, the highest byte first") {
  const std::string head = "# vtk DataFile Version 4.2\na\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 ";
  const std::string cells = "\nCELLS 1 5\n" + big_endian<std::int32_t>({4, 0, 1, 2, 3}) + "\nCELL_TYPES 1\n" +
                            big_endian<std::int32_t>({10}) + "\n";
  const auto check = [&](const std::string& type, const std::string& coordinates) {
    CAPTURE(type);
    const Mesh mesh = vtk(head + type + "\n" + coordinates + cells);
    CHECK(mesh.vertices == five.topRows(4));
    CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}});
  };
  check("char", big_endian<std::int8_t>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
  check("unsigned_short", big_endian<std::uint16_t>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
  check("long", big_endian<std::int64_t>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
  check("float", big_endian<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
  check("double", big_endian<double>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
  const std::string whole = head + "char\n" + big_endian<std::int8_t>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + cells;
  for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
    CAPTURE(length);
    CHECK(refusal_of(whole.substr(0, length), require_mesh_format("a.vtk")) != "");
  }
}

TEST_CASE("a malformed legacy file is refused with its place") {
  const auto check = [](const std::string& text, const std::string& start) {
    const std::string message = refusal_of(text, require_mesh_format("a.vtk"));
    CAPTURE(message);
    CHECK(message.starts_with(start));
    CHECK(message.find("; ") != std::string::npos);
  };
  check("", "a:1: \"\" in place of #;");
  check("OFF\n", "a:1: \"OFF\" in place of #;");
  check("# vtk DataFile Version 6.0\n\nASCII\n", "a:1: version \"6.0\";");
  check("# vtk DataFile Version 3.0\n\nTEXT\n", "a:3: \"TEXT\" in place of ASCII or BINARY;");
  check(ascii + "DATASET STRUCTURED_GRID\n", "a:4: dataset \"STRUCTURED_GRID\"; save an UNSTRUCTURED_GRID or POLYDATA");
  check(grid_head, "a: no POINTS;");
  check(grid_head + points, "a: no CELLS;");
  check(grid_head + "POINTS 2000000000 float\n0 0 0\n",
        "a:5: a count of 2000000000, where the file has room for at most");
  check(grid_head + "POINTS -1 float\n", "a:5: a count of -1;");
  check(grid_head + "POINTS 1 bit\n0 0 0\n", "a:5: numbers of type \"bit\";");
  check(grid_head + "POINTS 1 float\n0 0 nan\n", "a:6: a coordinate of vertex 0 is not finite;");
  check(grid_head + "POINTS 1 float\n0 0 x\n", "a:6: \"x\" is not a number;");
  check(grid_head + points + points, "a:9: POINTS twice;");
  check(grid_head + "CELLS 1 2\n1 0\n" + points, "a:6: cells before any POINTS;");
  check(grid_head + points + "LINES 1 3\n2 0 1\n", "a:9: \"LINES\" in place of a section;");
  const std::string cells = grid_head + points + "CELLS 1 5\n";
  check(cells + "4 0 1 2 5\n", "a:10: vertex 5 is out of range, since the file has 5; use 0 to 4");
  check(cells + "4 0 1 2 -1\n", "a:10: vertex -1 is out of range,");
  check(cells + "5 0 1 2 3\n", "a:10: cell 0 of 5 vertices, more than the section counts;");
  check(cells + "3 0 1 2 9\n", "a:10: 4 numbers in the cells, where the section counts 5;");
  check(cells + "4 0 1 2 3\n", "a: 0 CELL_TYPES for 1 cells;");
  check(cells + "4 0 1 2 3\nCELL_TYPES 1\n5\n", "a: cell 0: 4 corners for a cell of type 5, which has 3;");
  check(cells + "4 0 1 2 2\nCELL_TYPES 1\n10\n", "a: cell 0: a tetrahedron with point 2 at two corners;");
  check(cells + "4 0 1 2 2\nCELL_TYPES 1\n9\n", "a: cell 0: a face with vertex 2 at two corners;");
  check(cells + "4 0 1 2 2\nCELL_TYPES 1\n4\n", "a: cell 0: a line from vertex 2 to itself;");
  check(cells + "4 0 1 2 3\nCELL_TYPES 1\n12\n", "a: cell 0: a hexahedron (type 12); save lines,");
  check(cells + "4 0 1 2 3\nCELL_TYPES 1\n-7\n", "a: cell 0: a cell (type 255);");
  check(std::string("# vtk DataFile Version 3.0\n\0\n", 29), "a:2: a NUL byte;");
}

}  // namespace test_vtk
