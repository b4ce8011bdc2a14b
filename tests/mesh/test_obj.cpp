#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"
#include "pliant_io/mesh/obj.h"
#include "tests/mesh/files.h"

namespace test_obj {

namespace fs = std::filesystem;
using namespace pliant;
using namespace pliant_tests;

namespace {

const std::string four_vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Mesh parsed(const std::string& text) {
  const TemporaryFolder folder;
  return read_mesh(folder.write("a.obj", text));
}

/// The message for a text, without the folder in front of the file's name.
std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a.obj", text);
  const std::string message = error_of([&] { read_mesh(file); });
  const std::string start = folder.prefix();
  return message.starts_with(start) ? message.substr(start.size()) : message;
}

Mesh written_and_read(const Mesh& mesh) {
  return pliant_tests::written_and_read(mesh, "b.obj");
}

}  // namespace

TEST_CASE("every form of a face corner") {
  const std::string rows = four_vertices + "vt 0 0\nvt 1 0\nvt .5 1\nvn 0 0 1\n";
  const std::vector<Triangle> expected{{0, 1, 2}};
  for (const std::string face : {"f 1 2 3", "f 1//1 2//1 3//1", "f -4 -3 -2", "f +1 2 3", "f -4//-1 -3//-1 -2//-1",
                                 "f 1/ 2// 3", "\t f\t1  2\v3 \t"}) {
    CAPTURE(face);
    const Mesh mesh = parsed(rows + face + "\n");
    CHECK(mesh.triangles == expected);
    CHECK(mesh.faces.vertices == std::vector<Index>{0, 1, 2});
    CHECK(mesh.faces.texture_coordinates.empty());
    CHECK(mesh.texture_coordinates.rows() == 3);
  }
  for (const std::string face : {"f 1/3 2/2 3/1", "f 1/3/1 2/2/1 3/1/1", "f -4/-1/-1 -3/-2/1 -2/-3/-1"}) {
    CAPTURE(face);
    const Mesh mesh = parsed(rows + face + "\n");
    CHECK(mesh.triangles == expected);
    CHECK(mesh.faces.texture_coordinates == std::vector<Index>{2, 1, 0});
    CHECK(mesh.texture_coordinates(2, 0) == 0.5);
  }
  CHECK(parsed(rows + "f 1/2 2 3//1\n").faces.texture_coordinates == std::vector<Index>{1, -1, -1});
}

TEST_CASE("polygons are kept, and cut as a fan from their first corner") {
  const Mesh mesh = parsed(four_vertices + "v -1 .5 0\nf 2 3 4 5 1\nf 1 2 3\nf 4 3 2 1\n");
  CHECK(mesh.faces.offsets == std::vector<Index>{0, 5, 8, 12});
  CHECK(mesh.faces.vertices == std::vector<Index>{1, 2, 3, 4, 0, 0, 1, 2, 3, 2, 1, 0});
  CHECK(mesh.triangles == std::vector<Triangle>{{1, 2, 3}, {1, 3, 4}, {1, 4, 0}, {0, 1, 2}, {3, 2, 1}, {3, 1, 0}});
}

TEST_CASE("relative indices count from where they stand, absolute ones may look ahead") {
  const Mesh mesh = parsed("f 1 2 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -3 -2 -1\n");
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 3}, {0, 1, 2}, {1, 2, 3}});
}

TEST_CASE("numbers in every notation, without a word of the locale") {
  const Mesh mesh = parsed(
      "v +1.5 -.25 3.\nv 1e3 1E-3 +1e+2\nv -3.4101800e-003 1e-400 -0\n"
      "v 0.1 123456789012345678901234567890 2.2250738585072014e-308\n");
  CHECK(row(mesh.vertices, 0) == Vec3(1.5, -0.25, 3));
  CHECK(row(mesh.vertices, 1) == Vec3(1000, 0.001, 100));
  CHECK(row(mesh.vertices, 2) == Vec3(-0.00341018, 0, 0));
  CHECK(std::signbit(mesh.vertices(2, 2)));
  CHECK(row(mesh.vertices, 3) == Vec3(0.1, 123456789012345678901234567890.0, std::numeric_limits<Real>::min()));
}

TEST_CASE("weights and a third texture coordinate are dropped") {
  const Mesh mesh = parsed("v 1 2 3 1\nv 4 5 6\nvt .5\nvt .1 .2 .3\n");
  CHECK(mesh.vertices == mesh_of({{1, 2, 3}, {4, 5, 6}}).vertices);
  CHECK(mesh.maps.empty());
  REQUIRE(mesh.texture_coordinates.rows() == 2);
  CHECK(mesh.texture_coordinates(0, 0) == 0.5);
  CHECK(mesh.texture_coordinates(0, 1) == 0);
  CHECK(mesh.texture_coordinates(1, 1) == 0.2);
}

TEST_CASE("colors become maps, white where a vertex has none") {
  const Mesh mesh = parsed("v 1 2 3\nv 4 5 6 .1 .2 .3\nv 7 8 9 .4 .5 .6\n");
  CHECK(mesh.vertices == mesh_of({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}).vertices);
  REQUIRE(mesh.maps.size() == 3);
  CHECK(mesh.maps[0].name == "red");
  CHECK(mesh.maps[0].values == std::vector<Real>{1, 0.1, 0.4});
  CHECK(mesh.maps[1].name == "green");
  CHECK(mesh.maps[1].values == std::vector<Real>{1, 0.2, 0.5});
  CHECK(mesh.maps[2].name == "blue");
  CHECK(mesh.maps[2].values == std::vector<Real>{1, 0.3, 0.6});
  check_same(written_and_read(mesh), mesh);

  const Mesh opaque = parsed("v 1 2 3 .1 .2 .3 .5\nv 4 5 6 .1 .2 .3\n");
  REQUIRE(opaque.maps.size() == 4);
  CHECK(opaque.maps[3].name == "alpha");
  CHECK(opaque.maps[3].values == std::vector<Real>{0.5, 1});
  check_same(written_and_read(opaque), opaque);

  Mesh bytes = mesh_of({{0, 0, 0}, {1, 0, 0}});
  bytes.maps = {{"red", {255, 0}}, {"green", {0, 51}}, {"blue", {0, 0}}};
  CHECK(written_and_read(bytes).maps[1].values == std::vector<Real>{0, 0.2});  // OBJ counts from 0 to 1
}

TEST_CASE("materials and their libraries are kept and written back") {
  const Mesh mesh = parsed(four_vertices +
                           "mtllib a b.mtl\nmtllib c.mtl\nmtllib a b.mtl\nusemtl unused\no shirt\ng left\n"
                           "usemtl red wool\nf 1 2 3\nusemtl\nf 2 3 4\nusemtl red wool\ng right\nf 3 4 1\n");
  CHECK(mesh.material_libraries == std::vector<std::string>{"a b.mtl", "c.mtl"});
  REQUIRE(mesh.groups.size() == 4);
  CHECK(mesh.groups[2].name == "red wool");
  CHECK(mesh.groups[2].kind == FaceGroupKind::material);
  CHECK(mesh.groups[2].faces == std::vector<Index>{0, 2});
  CHECK(mesh.groups[3].name == "right");
  check_same(written_and_read(mesh), mesh);
}

TEST_CASE("statements without which the mesh would be another are refused, points and the like passed over") {
  for (const std::string statement :
       {"surf 0 1 0 1 1 2 3", "curv 0 1 1 2 3", "bzp 1 2 3", "bsp 1 2", "cdp 1 2", "call other.obj", "csh rm x"}) {
    CAPTURE(statement);
    CHECK(refusal(four_vertices + "f 1 2 3\n" + statement + "\n").starts_with("a.obj:6: a "));
  }
  const Mesh mesh = parsed(four_vertices + "cstype bezier\ndeg 3\np 1 2 3\nvp 0 0\ncurv2 1 2\nlod 1\nfo 1 2 3\n");
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("words, line ends and continued lines at the edge of every block") {
  // Lines of growing length, so that the edges of blocks (2^18 bytes) fall on every kind of character.
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text;
    Index count = 0;
    while (text.size() < 1'500'000) {
      const std::string number = std::to_string(count) + ".125";
      text += "# " + std::string(static_cast<std::size_t>(count % 97), 'c') + end + "  v " + number + "\t\\" + end;
      text += " -" + number + std::string(static_cast<std::size_t>(count % 5), ' ') + " 1e-3 # \\" + end;
      ++count;
    }
    const Mesh mesh = parsed(text);
    CHECK(pliant::parse_mesh(text, "a", pliant::require_mesh_format("a.obj")).vertices == mesh.vertices);
    REQUIRE(mesh.vertex_count() == count);
    for (Index v = 0; v < count; ++v) {
      if (row(mesh.vertices, v) != Vec3(v + 0.125, -v - 0.125, 1e-3)) FAIL(v);
    }
    CHECK(refusal(text + "f 1 2 x").starts_with("a.obj:" + std::to_string(3 * count + 1) + ": \"x\""));
  }
}

TEST_CASE("few bytes of names do not take a quadratic amount of memory") {
  std::string names;
  for (int i = 0; i < 5000; ++i) names += " n" + std::to_string(i);
  std::string faces;
  for (int i = 0; i < 10000; ++i) faces += "f 1 2 3\n";
  CHECK(refusal(four_vertices + "g" + names + "\n" + faces).starts_with("a.obj:5: more than 256 groups at once;"));
  names.resize(names.find(" n250"));
  CHECK(contains(refusal(four_vertices + "g" + names + "\n" + faces), ": too many faces in too many groups at once"));
  std::string objects;
  for (int i = 0; i < 120000; ++i) objects += "o " + std::to_string(i) + "\nf 1 2 3\n";
  CHECK(contains(refusal(four_vertices + objects), " groups, objects and materials for a file of this size;"));
  CHECK(contains(refusal(four_vertices + "g " + std::string(300'000, 'a')), "a.obj:5: a word of more than "));
}

TEST_CASE("line ends, comments, continued lines, a byte order mark and keywords of other programs") {
  const Mesh expected = parsed(four_vertices + "f 1 2 3 4\n");
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text = "\xEF\xBB\xBF# C:\\meshes\\" + end + "mtllib" + end + "v 0 0 0 # first" + end;
    text += "v 1 \\" + end + "0 0" + end + "v 1 1 0  " + end + "v 0 1 0 #" + end;
    text += end + "usemtl" + end + "s off" + end + "vp 0 0" + end + "\tunknown \\" + end + "f 9 9" + end;
    text += "f 1 2 3\\" + end + " 4";
    CAPTURE(end.size());
    check_same(parsed(text), expected);
  }
}

TEST_CASE("polylines become edges") {
  const Mesh mesh = parsed(four_vertices + "l 1 2 3 1\nl -1/1 2\n");
  CHECK(mesh.edges == std::vector<Edge>{{0, 1}, {1, 2}, {2, 0}, {3, 1}});
  CHECK(mesh.triangles.empty());
  CHECK(mesh.faces.face_count() == 0);
  CHECK(mesh.faces.offsets.empty());
}

TEST_CASE("groups and objects hold their faces") {
  const Mesh mesh = parsed(four_vertices +
                           "g unused\no the shirt\ng left front\nf 1 2 3\ng front front\nf 2 3 4\ng\nf 3 4 1\n"
                           "o\nf 4 1 2\ng left\nf 1 2 4\n");
  REQUIRE(mesh.groups.size() == 3);
  CHECK(mesh.groups[0].name == "the shirt");
  CHECK(mesh.groups[0].kind == FaceGroupKind::object);
  CHECK(mesh.groups[0].faces == std::vector<Index>{0, 1, 2});
  CHECK(mesh.groups[1].name == "left");
  CHECK(mesh.groups[1].kind == FaceGroupKind::group);
  CHECK(mesh.groups[1].faces == std::vector<Index>{0, 4});
  CHECK(mesh.groups[2].name == "front");
  CHECK(mesh.groups[2].faces == std::vector<Index>{0, 1});
  check_same(written_and_read(mesh), mesh);
}

TEST_CASE("a malformed file is refused with file, line and what is wrong") {
  const auto check = [](const std::string& text, const std::string& start) {
    const std::string message = refusal(text);
    CAPTURE(message);
    CHECK(message.starts_with(start));
    CHECK(message.find("; ") != std::string::npos);  // the remedy
  };
  SUBCASE("numbers") {
    check("v 0 0 0\nv 1 x 0\n", "a.obj:2: \"x\" is not a number;");
    check("v 1,5 0 0\n", "a.obj:1: \"1,5\" is not a number;");
    check("v 1.2.3 0 0\n", "a.obj:1: \"1.2.3\" is not a number;");
    check("v 1d3 0 0\n", "a.obj:1: \"1d3\" is not a number;");
    check("v +-1 0 0\n", "a.obj:1: \"+-1\" is not a number;");
    check("v + 0 0\n", "a.obj:1: \"+\" is not a number;");
    check("v 0x10 0 0\n", "a.obj:1: \"0x10\" is not a number;");
    check("v 0 0 0 red\n", "a.obj:1: \"red\" is not a number;");
    check("\n\n# c\nv 0 \\\n 0 1e999\n", "a.obj:5: \"1e999\" is not finite;");
    check("v 0 0 -0.01e999\n", "a.obj:1: \"-0.01e999\" is not finite;");
    check("v nan 0 0\n", "a.obj:1: \"nan\" is not finite;");
    check("v 0 -inf 0\n", "a.obj:1: \"-inf\" is not finite;");
    check("vt nan 0\n", "a.obj:1: \"nan\" is not finite;");
    check("v " + std::string(500, '7') + "z 0 0\n", "a.obj:1: \"" + std::string(40, '7') + "...\" is not a number;");
    check("v " + std::string(400, '7') + " 0 0\n", "a.obj:1: \"" + std::string(40, '7') + "...\" is not finite;");
    check("v \x1b[31m 0 0\n", "a.obj:1: \" [31m\" is not a number;");
    check("v \x9b[31m 0 0\n", "a.obj:1: \"?[31m\" is not a number;");
    check("v \u009b31m\u202e\u061cä 0 0\n", "a.obj:1: \" 31m  ä\" is not a number;");
  }
  SUBCASE("counts of coordinates") {
    check("v 0 0\n", "a.obj:1: 2 of the 3 coordinates of a vertex;");
    check("v\r\n", "a.obj:1: 0 of the 3 coordinates of a vertex;");
    check("v 1 2 3 4 5\n", "a.obj:1: 5 coordinates for a vertex;");
    check("v 1 2 3 4 5 6 7 8\n", "a.obj:1: too many coordinates for a vertex;");
    check("vt 1 2 3 4\n", "a.obj:1: too many coordinates for a texture coordinate;");
    check("vt\n", "a.obj:1: 0 of the 1 coordinates of a texture coordinate;");
  }
  SUBCASE("indices") {
    const auto check_face = [&](const std::string& line, const std::string& what) {
      check(four_vertices + "vt 0 0\nvn 0 0 1\n" + line, "a.obj:7: " + what);
    };
    check_face("f 0 1 2", "index 0 of a vertex;");
    check_face("f 1/0 2/1 3/1", "index 0 of a texture coordinate;");
    check_face("f 1//0 2//1 3//1", "index 0 of a normal;");
    check_face("f 1 2 5", "vertex 5 is out of range, since the file has 4;");
    check_face("f 1 2 -5", "vertex -5 is out of range, since there are 4 above;");
    check_face("f 1/2 2/1 3/1", "texture coordinate 2 is out of range, since the file has 1;");
    check_face("f 1//1 2//1 3//2", "normal 2 is out of range, since the file has 1;");
    check_face("f 1 2 99999999999", "vertex 99999999999 is out of range,");
    check_face("f 1 2 99999999999999999999", "index \"99999999999999999999\" is out of range;");
    check_face("f 1 2 -9223372036854775808", "vertex -9223372036854775808 is out of range,");
    check_face("f 1 2 3.5", "\"3.5\" is not an index;");
    check_face("f 1 2 x", "\"x\" is not an index;");
    check_face("f 1 2 /1", "\"\" is not an index;");
    check_face("f 1 2 1/1/1/1", "\"1/1/1/1\" is not a face corner;");
    check_face("l 1 9", "vertex 9 is out of range,");
    check("v 0 0 0\nf -1 -2 -3\n", "a.obj:2: vertex -2 is out of range, since there are 1 above;");
  }
  SUBCASE("faces and lines") {
    check(four_vertices + "f 1 2\n", "a.obj:5: a face with 2 corners;");
    check(four_vertices + "f\n", "a.obj:5: a face with 0 corners;");
    check(four_vertices + "f 1 \\\n 2\n", "a.obj:5: a face with 2 corners;");
    check(four_vertices + "f 1 2 3 2\n", "a.obj:5: a face with vertex 2 at two corners;");
    check(four_vertices + "f 1 2 -3\n", "a.obj:5: a face with vertex 2 at two corners;");
    check(four_vertices + "l 1\n", "a.obj:5: a line with 1 vertices;");
    check(four_vertices + "l 1 2 2 3\n", "a.obj:5: vertex \"2\" twice in a row in a line;");
  }
  SUBCASE("whole files") {
    check("", "a.obj: no vertices;");
    check("# nothing\n\n", "a.obj: no vertices;");
    check(four_vertices + std::string("f 1 2\0 3\n", 9), "a.obj:5: a NUL byte;");
    check(std::string("\xFF\xFEv\0 \0", 6), "a.obj:1: a NUL byte;");
  }
}

TEST_CASE("what is no regular file is refused with its path") {
  const TemporaryFolder folder;
  const auto message_for = [](const fs::path& path) { return error_of([&] { read_mesh(path); }); };
  CHECK(message_for(folder.path() / "b.obj") == (folder.path() / "b.obj").string() + ": no such file; check the path");
  fs::create_directory(folder.path() / "folder.obj");
  CHECK(contains(message_for(folder.path() / "folder.obj"), ": is a directory;"));
  CHECK(contains(message_for(folder.write("file", "") / "b.obj"), ": no such file;"));
}

TEST_CASE("reading, writing and reading again gives the same mesh") {
  const Mesh mesh = parsed(
      "v 0.1 -0 1e-320\nv 1e308 2 3.3333333333333335\nv 4 5e-5 123456.789\nv 1 1 1\nv 7 7 7\n"
      "vt .1 .7\nvt 0 1\no thing\nf -5/1 -4/2 3/1 4/2\ng a\nf 1 2/2 4\nl 1 3 5\n");
  check_same(written_and_read(mesh), mesh);
  const Mesh strip = moebius_strip(9);
  const Mesh reread = written_and_read(strip);
  CHECK(reread.triangles == strip.triangles);
  check_same(written_and_read(reread), reread);
  const Mesh sheet = grid({.columns = 4, .rows = 3, .diagonals = Diagonals::crossed});
  check_same(written_and_read(sheet), sheet);
  const Mesh rope = chain({});
  check_same(written_and_read(rope), rope);
}

TEST_CASE("the positions given are written, not the rest positions") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "frame.obj";
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Positions moved = mesh.vertices.array() + 0.5;
  write_obj(file, mesh, moved);
  CHECK(TemporaryFolder::read(file) == "# Pliant\nv 0.5 0.5 0.5\nv 1.5 0.5 0.5\nv 0.5 1.5 0.5\nf 1 2 3\n");
}

TEST_CASE("of tetrahedra the surface is written, with every vertex") {
  const Mesh box = bar({.cells = {2, 2, 2}});
  const Mesh reread = written_and_read(box);
  CHECK(reread.vertices == box.vertices);
  CHECK(reread.triangles == boundary_triangles(box.tetrahedra));
}

TEST_CASE("names that would not read back are mended") {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  mesh.triangles = {{0, 1, 2}};
  mesh.faces.offsets = {0, 3};
  mesh.faces.vertices = {0, 1, 2};
  mesh.groups = {
      {"two words\n#3\\", FaceGroupKind::object, {0}}, {"two words", {}, {0}}, {"#1", {}, {0}}, {"", {}, {0}}};
  const Mesh reread = written_and_read(mesh);
  REQUIRE(reread.groups.size() == 4);
  CHECK(reread.groups[0].name == "two words_#3_");
  CHECK(reread.groups[1].name == "two_words");
  CHECK(reread.groups[2].name == "_1");
  CHECK(reread.groups[3].name == "_");
}

TEST_CASE("what cannot be written leaves no file behind") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a.obj", "as it was");
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}});
  CHECK(contains(error_of([&] { write_obj(file, mesh, Positions::Zero(3, 3)); }), "3 positions for a mesh of 2"));
  Positions positions = mesh.vertices;
  positions(1, 2) = std::numeric_limits<Real>::quiet_NaN();
  CHECK(contains(error_of([&] { write_obj(file, mesh, positions); }), "the position of vertex 1 is not finite;"));
  CHECK(TemporaryFolder::read(file) == "as it was");
  const fs::path absent = folder.path() / "absent" / "a.obj";
  CHECK(contains(error_of([&] { write_obj(absent, mesh, mesh.vertices); }, ErrorKind::output), absent.string()));
  CHECK(folder.file_count() == 1);
}

}  // namespace test_obj
