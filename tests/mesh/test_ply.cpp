#include <algorithm>
#include <bit>
#include <string>

#include <doctest/doctest.h>

#include "pliant/mesh/shapes.h"
#include "pliant_io/mesh/ply.h"
#include "tests/mesh/files.h"

namespace test_ply {

namespace fs = std::filesystem;
using namespace pliant;
using namespace pliant_tests;

namespace {

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string face_list = "property list uchar int vertex_indices\n";
const std::string quad = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

std::string ascii(const std::string& elements, const std::string& rows) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + rows;
}

std::string of_faces(Index count) {
  return "element vertex 4\n" + xyz + "element face " + std::to_string(count) + "\n" + face_list;
}

Mesh parsed(const std::string& text) {
  return parse_mesh(text, "a", require_mesh_format("x.ply"));
}

std::string refusal(const std::string& text) {
  return refusal_of(text, require_mesh_format("x.ply"));
}

/// Numbers as their bytes, in either order.
class Bytes {
 public:
  explicit Bytes(std::endian order) : order_(order) {}

  template <class Number>
  Bytes& operator<<(Number number) {
    std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
    if (order_ != std::endian::native) std::ranges::reverse(bytes);
    text += bytes;
    return *this;
  }

  std::string text;

 private:
  std::endian order_;
};

}  // namespace

TEST_CASE("polygons, their fans, and both names of the list") {
  for (const std::string list : {"vertex_indices", "vertex_index"}) {
    const std::string header = "element vertex 4\n" + xyz + "element face 3\nproperty list uchar int " + list + "\n";
    const Mesh mesh = parsed(ascii(header, quad + "4 0 1 2 3\n3 2 1 0\n3 0 2 3\n"));
    CHECK(mesh.vertices == mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).vertices);
    CHECK(mesh.faces.offsets == std::vector<Index>{0, 4, 7, 10});
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {0, 2, 3}});
    CHECK(mesh.maps.empty());
  }
}

TEST_CASE("every type, in text and in both orders of bytes") {
  const std::string header =
      "element vertex 3\nproperty char a\nproperty uint8 b\nproperty short c\nproperty uint16 d\nproperty int32 e\n"
      "property uint f\nproperty float32 x\nproperty double y\nproperty float z\n"
      "element face 1\nproperty list uint8 uint32 vertex_indices\n";
  const auto check = [](const Mesh& mesh) {
    CHECK(mesh.vertices == mesh_of({{0.5, 0.1, 0}, {-1, 2, 3}, {0, 0, 1}}).vertices);
    REQUIRE(mesh.maps.size() == 6);
    const std::vector<Real> expected = {-100, 200, -30000, 60000, -2000000000, 4000000000};
    for (std::size_t m = 0; m < 6; ++m) {
      CHECK(mesh.maps[m].name == std::string(1, static_cast<char>('a' + m)));
      CHECK(mesh.maps[m].values == std::vector<Real>{expected[m], 0, expected[m]});
    }
    CHECK(mesh.triangles == std::vector<Triangle>{{2, 0, 1}});
  };
  const std::string numbers = "-100 200 -30000 60000 -2000000000 4000000000 ";
  check(parsed(ascii(header, numbers + ".5 .1 0\n0 0 0 0 0 0 -1 2 3\n" + numbers + "0 0 1\n3 2 0 1\n")));
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    Bytes rows(order);
    const auto add = [&](bool has_numbers, float x, double y, float z) {
      const int one = has_numbers ? 1 : 0;
      rows << static_cast<std::int8_t>(-100 * one) << static_cast<std::uint8_t>(200 * one);
      rows << static_cast<std::int16_t>(-30000 * one) << static_cast<std::uint16_t>(60000 * one);
      rows << std::int32_t{-2000000000 * one} << (one == 1 ? 4000000000u : 0u) << x << y << z;
    };
    add(true, 0.5f, 0.1, 0);
    add(false, -1, 2, 3);
    add(true, 0, 0, 1);
    rows << std::uint8_t{3} << 2u << 0u << 1u;
    const std::string name = order == std::endian::little ? "little" : "big";
    const std::string text = "ply\nformat binary_" + name + "_endian 1.0\n" + header + "end_header\n" + rows.text;
    check(parsed(text));
    check(parsed(text + "\n"));  // which some programs append
    CHECK(contains(refusal(text + "\n\n\n"), "a: 3 bytes follow the rows that the header counts;"));
    CHECK(contains(refusal(text.substr(0, text.size() - 1)), "may be cut short"));
  }
}

TEST_CASE("line ends of every kind; the first byte of the data may look like one") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string header = "ply\ncomment end_header\nobj_info x\nformat binary_little_endian 1.0\nelement vertex 1\n";
    header += "property uchar x\nproperty uchar y\nproperty uchar z\nend_header\n";
    for (std::size_t at = 0; (at = header.find('\n', at)) != std::string::npos; at += end.size()) {
      header.replace(at, 1, end);
    }
    for (const char first : {'\n', '\r', '\0'}) {
      CHECK(parsed(header + first + "\n\r").vertices == mesh_of({{Real(first), 10, 13}}).vertices);
    }
  }
  std::string text = "\xEF\xBB\xBF" + ascii(of_faces(1), quad + "\n 3\t0 1 2 \n\n");
  for (const std::string end : {"\r\n", "\r"}) {
    std::string other = text;
    for (std::size_t at = 0; (at = other.find('\n', at)) != std::string::npos; at += end.size()) {
      other.replace(at, 1, end);
    }
    check_same(parsed(other), parsed(text));
  }
}

TEST_CASE("other elements and lists are passed over, in any order") {
  const std::string header =
      "element material 2\nproperty list uchar float weights\nproperty uchar kind\nelement nothing 999999999999\n"
      "element face 1\nproperty uchar flags\n" +
      face_list +
      "property list int short more\n"
      "element vertex 4\nproperty list uchar uchar links\n" +
      xyz + "element camera 1\nproperty float fov\n";
  const std::string rows = "2 .1 .2 7\n0 8\n9 3 0 1 2 1 5\n";
  const Mesh mesh = parsed(ascii(header, rows + "0 0 0 0\n3 1 2 3 1 0 0\n1 9 1 1 0\n0 0 1 0\nnan\n"));
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(mesh.maps.empty());
  CHECK(row(mesh.vertices, 2) == Vec3(1, 1, 0));
  // The same in binary.
  Bytes bytes(std::endian::little);
  bytes << std::uint8_t{2} << 0.1f << 0.2f << std::uint8_t{7} << std::uint8_t{0} << std::uint8_t{8};
  bytes << std::uint8_t{9} << std::uint8_t{3} << 0 << 1 << 2 << 1 << std::int16_t{5};
  for (Index v = 0; v < 4; ++v) {
    bytes << std::uint8_t{1} << std::uint8_t{9};
    for (Index k = 0; k < 3; ++k) bytes << static_cast<float>(mesh.vertices(v, k));
  }
  bytes << 1.0f;
  check_same(parsed("ply\nformat binary_little_endian 1.0\n" + header + "end_header\n" + bytes.text), mesh);
}

TEST_CASE("edges and triangle strips") {
  const std::string header = "element vertex 4\n" + xyz +
                             "element edge 2\nproperty int vertex1\nproperty uchar red\nproperty int vertex2\n"
                             "element tristrips 1\nproperty list int int vertex_indices\n";
  // Turned around by a repeated vertex, then a second strip.
  const Mesh mesh = parsed(ascii(header, quad + "0 255 2\n3 0 1\n11 0 1 2 3 3 1 -1 3 2 1 0\n"));
  CHECK(mesh.edges == std::vector<Edge>{{0, 2}, {3, 1}});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 2, 1}, {1, 2, 0}});
  CHECK(contains(refusal(ascii(header, quad + "0 0 0\n1 0 2\n0\n")), "a:18: an edge from vertex 0 to itself;"));
}

TEST_CASE("numbers of vertices become maps, normals do not, and what is not finite is left out") {
  const std::string header = "element vertex 2\n" + xyz +
                             "property float nx\nproperty float ny\nproperty float nz\nproperty float quality\n"
                             "property uchar red\nproperty float curvature\n";
  const Mesh mesh = parsed(ascii(header, "0 0 0 nan nan nan .25 255 nan\n1 0 0 0 0 1 -1e-3 7 1\n"));
  REQUIRE(mesh.maps.size() == 2);
  CHECK(mesh.maps[0].name == "quality");
  CHECK(mesh.maps[0].values == std::vector<Real>{0.25, -1e-3});
  CHECK(mesh.maps[1].values == std::vector<Real>{255, 7});
}

TEST_CASE("texture coordinates of vertices and of corners") {
  for (const auto& [s, t] : {std::pair{"s", "t"}, std::pair{"u", "v"}, std::pair{"texture_u", "texture_v"}}) {
    const std::string header =
        "element vertex 4\n" + xyz + "property float " + s + "\nproperty float " + t + "\nelement face 1\n" + face_list;
    const Mesh mesh = parsed(ascii(header, "0 0 0 .1 .2\n1 0 0 .3 .4\n1 1 0 .5 .6\n0 1 0 .7 .8\n3 3 1 2\n"));
    CHECK(mesh.maps.empty());
    CHECK(mesh.faces.texture_coordinates == std::vector<Index>{3, 1, 2});
    CHECK(mesh.texture_coordinates(3, 1) == 0.8);
    check_same(written_and_read(mesh, "b.ply"), mesh);
  }
  const std::string header = "element vertex 4\n" + xyz + "property float s\nproperty float t\nelement face 3\n" +
                             face_list + "property list uchar float texcoord\n";
  const std::string rows = "0 0 0 9 9\n1 0 0 9 9\n1 1 0 9 9\n0 1 0 9 9\n";
  const Mesh mesh = parsed(ascii(header, rows + "3 0 1 2 0\n3 0 1 2 6 1 2 3 4 5 6\n3 0 2 3 0\n"));
  CHECK(mesh.faces.texture_coordinates == std::vector<Index>{-1, -1, -1, 0, 1, 2, -1, -1, -1});
  REQUIRE(mesh.texture_coordinates.rows() == 3);
  CHECK(mesh.texture_coordinates(2, 0) == 5);
  CHECK(mesh.maps.size() == 2);  // of the vertices' own, the ones that nothing refers to
  CHECK(contains(refusal(ascii(header, rows + "3 0 1 2 2 1 2\n")), "2 texture coordinates for 3 corners;"));
}

TEST_CASE("what is written as PLY reads back, in binary and in text") {
  Mesh mesh = parse_mesh(
      "v 0.1 -0 1e-320\nv 1e308 2 3.3333333333333335\nv 4 5e-5 123456.789\nv 1 1 1\nv 7 7 7\n"
      "vt .1 .7\nvt 0 1\nf -5/1 -4/2 3/1 4/2\nf 1/1 2/2 4/1\nl 1 3 5\n",
      "a", require_mesh_format("x.obj"));
  mesh.maps = {{"a b", {1, 2, 3, 4, 0.1}}, {"x", {1, 1, 1, 1, 1}}, {"a_b", {0, 0, 0, 0, 0}}, {"short", {1}}};
  Mesh colors = torus({.major_segments = 3, .minor_segments = 3});
  for (const std::string name : {"red", "green", "blue"}) {
    colors.maps.push_back({name, std::vector<Real>(9, name == "red" ? 255 : 3)});
  }
  Mesh large = mesh_of(std::vector<std::array<Real, 3>>(300, {1, 2, 3}));
  for (Index v = 0; v < 300; ++v) large.faces.vertices.push_back(v);
  large.faces.offsets = {0, 300};
  const TemporaryFolder folder;
  for (const PlyNumbers numbers : {PlyNumbers::binary, PlyNumbers::ascii}) {
    for (const Mesh& source : {mesh, colors, large}) {
      write_ply(folder.path() / "a.ply", source, source.vertices, numbers);
      const Mesh once = read_mesh(folder.path() / "a.ply");
      CHECK(once.vertices == source.vertices);
      CHECK(once.edges == source.edges);
      write_ply(folder.path() / "b.ply", once, once.vertices, numbers);
      check_same(read_mesh(folder.path() / "b.ply"), once);
    }
  }
  write_ply(folder.path() / "a.ply", mesh, mesh.vertices);
  const Mesh once = read_mesh(folder.path() / "a.ply");
  CHECK(once.faces.offsets == mesh.faces.offsets);
  REQUIRE(once.maps.size() == 3);  // one of another length is none of the vertices'
  CHECK(once.maps[0].name == "a_b");
  CHECK(once.maps[0].values == mesh.maps[0].values);
  CHECK(once.maps[1].name == "x_");
  CHECK(once.maps[2].name == "a_b_");
  write_ply(folder.path() / "c.ply", colors, colors.vertices);
  CHECK(contains(TemporaryFolder::read(folder.path() / "c.ply"), "property uchar red\n"));
}

TEST_CASE("a malformed PLY file is refused with its place") {
  const auto check = [](const std::string& text, const std::string& start) {
    const std::string message = refusal(text);
    CAPTURE(message);
    CHECK(message.starts_with(start));
    CHECK(message.find("; ") != std::string::npos);
  };
  SUBCASE("headers") {
    check("", "a: does not start with \"ply\";");
    check("OFF\n", "a: does not start with \"ply\";");
    check("ply\nformat ascii 1.0\n", "a: the header has no line \"end_header\"");
    check("ply\nend_header\n", "a:3: the header has no line \"format\";");
    check("ply\nformat binary 1.0\nend_header\n", "a:2: format \"binary\"; known: ascii,");
    check(ascii("element vertex -1\n", ""), "a:3: element \"vertex\" counts -1;");
    check(ascii("element vertex x\n", ""), "a:3: \"x\" is not an index;");
    check(ascii("element vertex 1\nelement vertex 1\n", ""), "a:4: element \"vertex\" twice;");
    check(ascii("property float x\n", ""), "a:3: a property before the first element;");
    check(ascii("element vertex 1\nproperty real x\n", ""), "a:4: unknown type \"real\"");
    check(ascii("element vertex 1\nproperty float\n", ""), "a:4: a property without a name;");
    check(ascii("element vertex 1\nproperty float x\nproperty int x\n", ""), "a:5: property \"x\" twice");
    check(ascii("element vertex 1\nproperty list float int x\n", ""), "a:4: a list that counts in fractions;");
    check(ascii("vertex 1\n", ""), "a:3: unknown statement \"vertex\"");
    check(ascii("element vertex 1 2\n", ""), "a:3: \"2\" too much in a header line;");
    check(ascii("element vertex 0\n" + xyz, ""), "a: no vertices;");
    check(ascii("element face 0\n" + face_list, ""), "a: no vertices;");
    check(ascii("element vertex 3000000000\n" + xyz, ""), "a: more than 2147483647 vertices;");
    check(ascii("element vertex 1\nproperty float x\nproperty float z\n", "0 0\n"),
          "a: element \"vertex\" has no property y;");
    check(ascii("element vertex 3\nelement face 1\n" + face_list, "3 0 1 2\n"),
          "a: element \"vertex\" has no properties;");
    check(ascii("element vertex 3\n" + xyz + "element edge 2\nproperty int vertex1\n", "0 0 0\n1 0 0\n0 1 0\n1\n2\n"),
          "a: element \"edge\" has one of vertex1 and vertex2;");
    check(ascii("element vertex 2000000000\n" + xyz, "0 0 0\n"), "a: the header counts 2000000000 rows of element");
    check(std::string("ply\nformat ascii 1.0\n\0\nend_header\n", 33), "a:3: a NUL byte;");
  }
  SUBCASE("rows") {
    check(ascii(of_faces(1), "0 0 0\n1 0\n1 1 0\n0 1 0\n3 0 1 2\n"),
          "a:11: a row of element \"vertex\" that ends too early;");
    check(ascii(of_faces(1), "0 0 0\n1 0 0 1\n1 1 0\n0 1 0\n3 0 1 2\n"), "a:11: \"1\" follows the last property");
    check(ascii(of_faces(1), "0 0 0\n1 0 x\n1 1 0\n0 1 0\n3 0 1 2\n"), "a:11: \"x\" is not a number;");
    check(ascii(of_faces(1), "0 0 0\n1 0 inf\n1 1 0\n0 1 0\n3 0 1 2\n"),
          "a:11: coordinate z of vertex 1 is not finite;");
    check(ascii(of_faces(1), "0 0 0\n1 1e999 0\n1 1 0\n0 1 0\n3 0 1 2\n"),
          "a:11: coordinate y of vertex 1 is not finite;");
    check(ascii(of_faces(3), quad + "3 0 1 2\n3 0 1 2\n"),
          "a:16: the file ends after 2 of 3 rows of element \"face\";");
    check(ascii(of_faces(1), quad + "3 0 1 2\n3 0 1 2\n"), "a:15: more rows than the header counts;");
    check(ascii(of_faces(1), quad + "3 0 1 4\n"), "a:14: vertex 4 is out of range, since the file has 4;");
    check(ascii(of_faces(1), quad + "3 0 1 -1\n"), "a:14: vertex -1 is out of range,");
    check(ascii(of_faces(1), quad + "3 0 1 1.5\n"), "a:14: vertex 1.5 is out of range,");
    check(ascii(of_faces(1), quad + "3 0 1 nan\n"), "a:14: vertex nan is out of range,");
    check(ascii(of_faces(1), quad + "3 0 1 1\n"), "a:14: a face with vertex 1 at two corners;");
    check(ascii(of_faces(1), quad + "2 0 1\n"), "a:14: a face with 2 corners;");
    check(ascii(of_faces(1), quad + "-3 0 1 2\n"), "a:14: a list of -3 numbers,");
    check(ascii(of_faces(1), quad + "1e30 0 1 2\n"), "a:14: a list of 1e+30 numbers,");
    check(ascii(of_faces(1), quad + "4 0 1 2\n"), "a:14: a row of element \"face\" that ends too early;");
  }
  SUBCASE("binary rows") {
    Bytes rows(std::endian::little);
    for (int i = 0; i < 12; ++i) rows << static_cast<float>(i);
    const std::string start = "ply\nformat binary_little_endian 1.0\n" + of_faces(1) + "end_header\n" + rows.text;
    check(start + std::string("\xFF\x01\x02\x03\x04", 5), "a: row 0 of element \"face\": a list of 255 numbers,");
    check(start + "\x03" + std::string(8, '\0') + std::string("\x04\0\0\0", 4),
          "a: row 0 of element \"face\": vertex 4 is");
    check(start + "\x03" + std::string(8, '\0') + "\xFF\xFF\xFF\xFF", "a: row 0 of element \"face\": vertex -1 is");
    check(start + "\x03" + std::string(12, '\0'), "a: row 0 of element \"face\": a face with vertex 0 at two corners;");
  }
}

}  // namespace test_ply
