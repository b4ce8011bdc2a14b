#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <random>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"
#include "tests/mesh/files.h"

namespace test_stl {

using namespace pliant;
using namespace pliant_tests;

namespace {

using Facet = std::array<std::array<float, 3>, 3>;

std::string binary(std::string header, const std::vector<Facet>& facets) {
  header.resize(80);
  const auto append = [&](const void* data, std::size_t size) { header.append(static_cast<const char*>(data), size); };
  const auto count = static_cast<std::uint32_t>(facets.size());
  append(&count, 4);
  for (const Facet& facet : facets) {
    header.append(12, '\x7f');  // a normal that is no number
    append(&facet, 36);
    header.append("ab");
  }
  return header;
}

std::string text_facet(const std::string& points) {
  return "facet normal 0 0 1\n outer loop\n" + points + " endloop\nendfacet\n";
}

Mesh parsed(const std::string& text) {
  return parse_mesh(text, "a", require_mesh_format("x.stl"));
}

std::string refusal(const std::string& text) {
  return refusal_of(text, require_mesh_format("x.stl"));
}

const std::vector<Facet> two_facets = {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}},
                                       {{{-0.0f, 0, -0.0f}, {1, 1, 0}, {0, 1, 0.1f}}}};

}  // namespace

TEST_CASE("equal points become one vertex, in the order in which they first appear") {
  for (const std::string header : {"", "solid binary all the same", "solid x\nfacet normal 0 0 0"}) {
    const Mesh mesh = parsed(binary(header, two_facets));
    CHECK(mesh.vertices == mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.1f}}).vertices);
    CHECK(!std::signbit(mesh.vertices(0, 0)));
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.faces.face_count() == 0);
    CHECK(mesh.collapsed_face_count == 0);
  }
}

TEST_CASE("text in any layout and letters") {
  const std::string first = text_facet("vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n");
  const std::string second = text_facet("vertex -0 0 0\nvertex 1 1 0\nvertex 0 1 .1\n");
  const Mesh expected = parsed("solid\n" + first + second + "endsolid\n");
  CHECK(expected.vertices == mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.1}}).vertices);
  CHECK(expected.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  check_same(parsed("  SOLID a facet\n" + first + "endsolid a facet\nsolid b\n" + second + "endsolid"), expected);
  std::string other = "solid\n" + first + second + "endsolid\n";
  for (std::size_t at = other.find("normal"); (at = other.find('\n', at)) != std::string::npos;) other[at] = ' ';
  check_same(parsed(other), expected);
  for (char& c : other) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  check_same(parsed("\xEF\xBB\xBF" + other), expected);
  CHECK(
      parsed(
          "solid\nfacet normal nan -inf x outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\nendsolid")
          .triangles.size() == 1);
}

TEST_CASE("facets that collapse are left out and counted") {
  std::vector<Facet> facets = two_facets;
  facets.insert(facets.begin() + 1, {{{{5, 5, 5}, {1, 0, 0}, {5, 5, 5}}}});
  facets.push_back({{{0, 0, 0}, {0, 0, 0}, {-0.0f, 0, 0}}});
  const Mesh mesh = parsed(binary("", facets));
  CHECK(mesh.collapsed_face_count == 2);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 4}});
  CHECK(mesh.vertex_count() == 5);  // the point of the sliver stays, as a vertex without a triangle
}

TEST_CASE("many points merge to the grid that they came from") {
  const Mesh sheet = grid({.columns = 150, .rows = 120, .plane = Plane::xy});
  const TemporaryFolder folder;
  write_mesh(folder.path() / "a.stl", sheet, sheet.vertices);
  const Mesh mesh = read_mesh(folder.path() / "a.stl");
  CHECK(mesh.vertex_count() == sheet.vertex_count());
  CHECK(mesh.triangles.size() == sheet.triangles.size());
  CHECK(boundary_edges(mesh).size() == boundary_edges(sheet).size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 exact = row(sheet.vertices, sheet.triangles[t][i]);
      CHECK(row(mesh.vertices, mesh.triangles[t][i]) == exact.cast<float>().cast<Real>());
    }
  }
  const std::string bytes = TemporaryFolder::read(folder.path() / "a.stl");
  CHECK(bytes.size() == 84 + 50 * sheet.triangles.size());
  float normal[3];
  std::memcpy(normal, bytes.data() + 84, 12);
  CHECK(normal[2] == 1);
}

namespace {

/// Text of points that a fixed hash would send to one slot: 64 bits each, multiplied and shifted, can be turned back.
std::string text_of_colliding_points(int facet_count) {
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15U;
  std::uint64_t inverse = factor;
  for (int i = 0; i < 5; ++i) inverse *= 2 - factor * inverse;  // Newton's method doubles the right bits
  const auto mix = [](std::uint64_t hash, Real x) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * factor;
    return hash ^ hash >> 29U;
  };
  constexpr std::uint64_t wanted = 0x123456789abcdefU;
  const std::uint64_t before = (wanted ^ wanted >> 29U ^ wanted >> 58U) * inverse;
  std::string text = "solid\n";
  Real x = 0;
  for (int i = 0; i < facet_count; ++i) {
    std::string corners;
    for (int k = 0; k < 3; ++k) {
      Real z = 0;
      while (!std::isnormal(z)) z = std::bit_cast<Real>(mix(mix(0, ++x), 0.5) ^ before);
      corners += fmt::format("vertex {} 0.5 {}\n", x, z);
    }
    text += text_facet(corners);
  }
  return text + "endsolid\n";
}

std::string text_of_random_points(int facet_count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<Real> coordinate(-1e5, 1e5);
  std::string text = "solid\n";
  for (int i = 0; i < facet_count; ++i) {
    std::string corners;
    for (int k = 0; k < 3; ++k) corners += fmt::format("vertex {} 0.5 {}\n", coordinate(random), coordinate(random));
    text += text_facet(corners);
  }
  return text + "endsolid\n";
}

double seconds_to_parse(const std::string& text) {
  const auto begin = std::chrono::steady_clock::now();
  CHECK(parsed(text).vertices.rows() > 0);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

TEST_CASE("points chosen to meet in one slot of a table cost no more than others") {
  constexpr int facet_count = 10000;
  const std::string colliding = text_of_colliding_points(facet_count);
  CHECK(parsed(colliding).vertices.rows() == 3 * facet_count);
  CHECK(seconds_to_parse(colliding) < 8 * seconds_to_parse(text_of_random_points(facet_count)));
}

TEST_CASE("what STL does not hold is refused on writing") {
  const TemporaryFolder folder;
  const auto refused = [&](const Mesh& mesh) {
    return error_of([&] { write_mesh(folder.path() / "a.stl", mesh, mesh.vertices); });
  };
  CHECK(contains(refused(chain({})), "the mesh has no triangles, and STL holds nothing else;"));
  CHECK(contains(refused(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1e39, 0}}, {{0, 1, 2}})),
                 "the position of vertex 2 is past"));
  CHECK(folder.file_count() == 0);
}

TEST_CASE("a malformed STL file is refused with its place") {
  const auto check = [](const std::string& text, const std::string& start) {
    const std::string message = refusal(text);
    CAPTURE(message);
    CHECK(message.starts_with(start));
    CHECK(message.find("; ") != std::string::npos);
  };
  const std::string bytes = binary("", two_facets);
  check("", "a: neither starts with \"solid\"");
  check("OFF\n", "a: neither starts with \"solid\"");
  check(bytes.substr(0, 100), "a: the header counts 2 facets, which take 184 bytes, but the file has 100;");
  check(bytes + std::string(50, '\0'), "a: the header counts 2 facets,");
  CHECK(refusal(bytes + "\n") == "");  // too short for a facet
  check(binary("", {}), "a: no facets;");
  check(binary("", {two_facets[0], {{{0, 0, 0}, {1, std::numeric_limits<float>::infinity(), 0}, {0, 1, 0}}}}),
        "a: facet 1 has a coordinate that is not finite;");
  std::string many = bytes;
  many[83] = '\x7f';
  check(many, "a: the header counts 2130706434 facets,");
  check("solid\n", "a:2: the file ends without endsolid;");
  check("solid\nendsolid\n", "a: no facets;");
  check("solid\nfacets\n", "a:2: \"facets\" in place of a facet;");
  check("solid\n" + text_facet("vertex 0 0 0\nvertex 1 0 0\n") + "endsolid\n", "a:6: \"endloop\" in place of vertex;");
  check("solid\n" + text_facet("vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n") + "endsolid\n",
        "a:7: \"vertex\" in place of endloop;");
  check("solid\n" + text_facet("vertex 0 0 0\nvertex 1 x 0\n"), "a:5: \"x\" is not a number;");
  check("solid\n" + text_facet("vertex 0 0 0\nvertex 1 nan 0\n"), "a:5: \"nan\" is not finite;");
  check("solid\n" + text_facet("vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"), "a:9: the file ends without endsolid;");
}

}  // namespace test_stl
