#include <cmath>
#include <numbers>
#include <random>

#include <doctest/doctest.h>

#include "pliant/mesh/diagnosis.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"
#include "tests/mesh/files.h"

namespace test_diagnosis {

using namespace pliant;
using namespace pliant_tests;

namespace {

using Places = std::vector<std::array<Index, 2>>;

/// The indices of a defect, and that its count agrees.
Places places(const Diagnosis& diagnosis, DefectKind kind) {
  const Defect* defect = diagnosis.find(kind);
  if (defect == nullptr) return {};
  CHECK(defect->first.size() == std::min<std::size_t>(Defect::max_listed, static_cast<std::size_t>(defect->count)));
  return defect->first;
}

std::int64_t count(const Diagnosis& diagnosis, DefectKind kind) {
  const Defect* defect = diagnosis.find(kind);
  return defect == nullptr ? 0 : defect->count;
}

}  // namespace

TEST_CASE("a sound closed surface: its measures, and no defect") {
  const TorusOptions options{.major_segments = 200, .minor_segments = 100};
  const Diagnosis d = diagnose(torus(options));
  CHECK(d.defects.empty());
  CHECK(d.vertex_count == 20000);
  CHECK(d.edge_count == 60000);
  CHECK(d.triangle_count == 40000);
  CHECK(d.component_count == 1);
  CHECK(d.is_closed);
  CHECK(d.boundary_loops.empty());
  const Real pi = std::numbers::pi;
  CHECK(d.area == doctest::Approx(4 * pi * pi * 0.5 * 0.2).epsilon(1e-3));
  CHECK(d.volume == doctest::Approx(2 * pi * pi * 0.5 * 0.2 * 0.2).epsilon(2e-3));
  CHECK(d.box.max[0] == doctest::Approx(0.7));
  CHECK(d.edge_length.min <= d.edge_length.mean);
  CHECK(d.edge_length.mean <= d.edge_length.max);

  Mesh inside_out = torus(options);
  for (auto& [a, b, c] : inside_out.triangles) std::swap(a, b);
  CHECK(diagnose(inside_out).volume == doctest::Approx(-d.volume));
  inside_out.vertices.rowwise() += Eigen::RowVector3d(1e6, -1e6, 1e6);
  CHECK(diagnose(inside_out).volume == doctest::Approx(-d.volume).epsilon(1e-6));
}

TEST_CASE("measures of a sheet in closed form, and its border") {
  const Diagnosis d = diagnose(grid({.columns = 4, .rows = 3, .size = {3, 4}, .plane = Plane::xy}));
  CHECK(d.defects.empty());
  CHECK(d.edge_count == 3 * 3 + 4 * 2 + 6);
  CHECK(d.edge_length.min == 1);
  CHECK(d.edge_length.max == doctest::Approx(std::sqrt(5)));
  CHECK(d.edge_length.mean == doctest::Approx((9 * 1 + 8 * 2 + 6 * std::sqrt(5)) / 23));
  CHECK(d.triangle_area.min == 1);
  CHECK(d.triangle_area.max == 1);
  CHECK(d.area == 12);
  CHECK(d.volume == 0);
  CHECK(!d.is_closed);
  REQUIRE(d.boundary_loops.size() == 1);
  CHECK(d.boundary_loops[0].first_vertex == 0);
  CHECK(d.boundary_loops[0].vertex_count == 10);
  CHECK(d.boundary_loops[0].length == 14);

  const Diagnosis pipe = diagnose(cylinder({.segments = 24, .rows = 3}));
  REQUIRE(pipe.boundary_loops.size() == 2);
  CHECK(pipe.boundary_loops[1].first_vertex == 48);
  CHECK(pipe.boundary_loops[1].length == doctest::Approx(24 * 2 * 0.25 * std::sin(std::numbers::pi / 24)));
}

TEST_CASE("tetrahedra, ropes, points and nothing") {
  const Diagnosis block = diagnose(bar({.cells = {2, 2, 2}, .size = {1, 2, 3}}));
  CHECK(block.defects.empty());
  CHECK(block.volume == doctest::Approx(6));
  CHECK(block.area == doctest::Approx(22));
  CHECK(block.edge_count == static_cast<Index>(unique_edges(bar({.cells = {2, 2, 2}})).size()));
  const Diagnosis rope = diagnose(chain({.links = 5, .length = 2}));
  CHECK(rope.defects.empty());
  CHECK(rope.edge_element_count == 5);
  CHECK(rope.edge_length.mean == doctest::Approx(0.4));
  CHECK(rope.boundary_loops.empty());
  const Diagnosis points = diagnose(mesh_of({{0, 0, 0}, {1, 1, 1}}));
  CHECK(points.component_count == 0);
  CHECK(places(points, DefectKind::isolated_vertices) == Places{{0, -1}, {1, -1}});
  CHECK(diagnose(Mesh{}).defects.empty());
}

TEST_CASE("each defect is found with its indices") {
  SUBCASE("vertices") {
    Mesh mesh = joined(grid({.columns = 3, .rows = 3}), mesh_of({{9, 9, 9}, {0, 0, 0}, {-0.0, 0, 0}}));
    const Diagnosis d = diagnose(mesh);
    CHECK(places(d, DefectKind::isolated_vertices) == Places{{9, -1}, {10, -1}, {11, -1}});
    CHECK(places(d, DefectKind::duplicate_vertices) == Places{{10, -1}, {11, -1}});
    CHECK(d.defects.size() == 2);
    CHECK(d.component_count == 1);
  }
  SUBCASE("flat things") {
    Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}}, {{0, 1, 3}, {0, 1, 2}});
    mesh.edges = {{0, 4}};
    mesh.tetrahedra = {{0, 1, 2, 3}, {0, 1, 3, 5}, {1, 0, 3, 5}};
    const Diagnosis d = diagnose(mesh);
    CHECK(places(d, DefectKind::zero_area_triangles) == Places{{1, -1}});
    CHECK(places(d, DefectKind::zero_length_edges) == Places{{0, 4}});
    CHECK(places(d, DefectKind::zero_volume_tetrahedra) == Places{{0, -1}});
    CHECK(places(d, DefectKind::inverted_tetrahedra) == Places{{2, -1}});
  }
  SUBCASE("non-manifold edges and vertices") {
    const Diagnosis book = diagnose(book_of_three_pages());
    CHECK(places(book, DefectKind::nonmanifold_edges) == Places{{0, 1}, {1, 2}});
    CHECK(places(book, DefectKind::nonmanifold_vertices) == Places{{0, -1}, {1, -1}, {2, -1}});
    CHECK(book.boundary_loops.size() >= 1);
    CHECK(!book.is_closed);
    const Diagnosis tie =
        diagnose(mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
    CHECK(places(tie, DefectKind::nonmanifold_vertices) == Places{{0, -1}});
    CHECK(tie.component_count == 1);
  }
  SUBCASE("duplicate triangles, turned or not") {
    Mesh mesh = grid({.columns = 3, .rows = 3});
    mesh.triangles.push_back(mesh.triangles[2]);
    mesh.triangles.push_back({mesh.triangles[2][1], mesh.triangles[2][0], mesh.triangles[2][2]});
    CHECK(places(diagnose(mesh), DefectKind::duplicate_triangles) == Places{{8, -1}, {9, -1}});
  }
  SUBCASE("flipped triangles are the fewer of their sheet") {
    Mesh mesh = joined(torus({}), grid({.columns = 5, .rows = 5}));
    for (const std::size_t t : {7u, 8u, 100u}) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
    const std::size_t first = torus({}).triangles.size();
    for (std::size_t t = first; t < first + 20; ++t) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
    Places expected = {{7, -1}, {8, -1}, {100, -1}};
    for (std::size_t t = first + 20; t < first + 27; ++t) expected.push_back({static_cast<Index>(t), -1});
    const Diagnosis d = diagnose(mesh);
    CHECK(places(d, DefectKind::flipped_triangles) == expected);
    CHECK(count(d, DefectKind::flipped_triangles) == 3 + 12);
    CHECK(d.component_count == 2);
    CHECK(d.volume == 0);  // what is inside is not said
  }
  SUBCASE("a Moebius strip is one-sided, not flipped") {
    const Diagnosis d = diagnose(moebius_strip(9));
    CHECK(places(d, DefectKind::unorientable_sheets) == Places{{0, -1}});
    CHECK(count(d, DefectKind::flipped_triangles) == 0);
    REQUIRE(d.boundary_loops.size() == 1);
    CHECK(d.boundary_loops[0].vertex_count == 18);
  }
  SUBCASE("bent polygons") {
    const Mesh mesh = parse_mesh("v 0 0 0\nv 1 0 0\nv 1 1 0.001\nv 0 1 0\nv 2 0 0\nv 2 1 1\nf 1 2 3 4\nf 2 5 6 3\n",
                                 "a", require_mesh_format("x.obj"));
    const Diagnosis d = diagnose(mesh);
    CHECK(places(d, DefectKind::bent_polygons) == Places{{1, -1}});
    CHECK(d.polygon_count == 2);
    CHECK(d.largest_polygon == 4);
  }
  SUBCASE("what would overflow is not measured") {
    const Diagnosis d = diagnose(mesh_of({{0, 0, 0}, {1e200, 0, 0}, {0, 1e308, 0}}, {{0, 1, 2}}));
    CHECK(places(d, DefectKind::far_vertices) == Places{{1, -1}, {2, -1}});
    CHECK(!d.is_measured);
    CHECK(d.area == 0);
    CHECK(d.boundary_loops.size() == 1);
  }
  SUBCASE("collapsed facets come from the reader") {
    Mesh mesh = torus({});
    mesh.collapsed_face_count = 3;
    CHECK(count(diagnose(mesh), DefectKind::collapsed_facets) == 3);
    CHECK(info_of(DefectKind::collapsed_facets).name == "collapsed_facets");
  }
}

TEST_CASE("check_mesh refuses a mesh exactly when a defect says so") {
  std::mt19937 random(7);
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    // Few places and few vertices, so that everything degenerates now and then.
    Mesh mesh;
    mesh.vertices = Positions::NullaryExpr(6, 3, [&] { return static_cast<Real>(random() % 3); });
    const auto element = [&]<std::size_t n>(std::array<Index, n>& vertices) {
      std::array<Index, 6> order = {0, 1, 2, 3, 4, 5};
      std::ranges::shuffle(order, random);
      std::copy_n(order.begin(), n, vertices.begin());
    };
    mesh.edges.resize(random() % 2);
    mesh.triangles.resize(random() % 3);
    mesh.tetrahedra.resize(random() % 2);
    for (Edge& edge : mesh.edges) element(edge);
    for (Triangle& triangle : mesh.triangles) element(triangle);
    for (Tetrahedron& tetrahedron : mesh.tetrahedra) element(tetrahedron);
    const Diagnosis d = diagnose(mesh);
    bool is_refused = false;
    for (const Defect& defect : d.defects) {
      // Edges of triangles and tetrahedra are judged with their element.
      if (defect.kind == DefectKind::zero_length_edges && mesh.edges.empty()) continue;
      is_refused = is_refused || info_of(defect.kind).effect == DefectEffect::refused;
    }
    const bool check_refuses = !error_of([&] { check_mesh(mesh, "a"); }).empty();
    refused += check_refuses ? 1 : 0;
    if (check_refuses) CHECK(is_refused);
    if (!is_refused) CHECK(!check_refuses);
    CHECK(d.edge_count == static_cast<Index>(unique_edges(mesh).size()));
  }
  CHECK(refused > 50);
  CHECK(refused < 290);
}

TEST_CASE("counts agree with the topology of random triangles, whatever passes they take") {
  std::mt19937 random(3);
  for (const Index vertices : {40, 2000}) {
    Mesh mesh;
    mesh.vertices = Positions::Random(vertices, 3);
    for (int t = 0; t < 500'000 / (vertices == 40 ? 100 : 1); ++t) {
      const auto vertex = [&] { return static_cast<Index>(random() % static_cast<unsigned>(vertices)); };
      const Triangle triangle = {vertex(), vertex(), vertex()};
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[0] == triangle[2]) continue;
      mesh.triangles.push_back(triangle);
    }
    const Diagnosis d = diagnose(mesh);
    CHECK(d.edge_count == static_cast<Index>(unique_edges(mesh).size()));
    CHECK(count(d, DefectKind::nonmanifold_edges) == hinges(mesh).nonmanifold_edge_count);
    std::vector<Triangle> sorted = mesh.triangles;
    for (Triangle& triangle : sorted) std::ranges::sort(triangle);
    std::ranges::sort(sorted);
    const auto different = std::unique(sorted.begin(), sorted.end()) - sorted.begin();
    CHECK(count(d, DefectKind::duplicate_triangles) == static_cast<std::int64_t>(mesh.triangles.size()) - different);
    Index walked = 0;
    for (const BoundaryLoop& loop : d.boundary_loops) walked += loop.vertex_count;
    CHECK(walked == static_cast<Index>(boundary_edges(mesh).size()));
  }
  // Vertices by their link, where no triangle is double.
  for (int trial = 0; trial < 200; ++trial) {
    Mesh mesh = grid({.columns = 5, .rows = 5, .plane = Plane::xy});
    for (int i = 0; i < 12; ++i) {
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(random() % mesh.triangles.size()));
    }
    CHECK(count(diagnose(mesh), DefectKind::nonmanifold_vertices) == vertex_rings(mesh).nonmanifold_vertex_count);
  }
}

}  // namespace test_diagnosis
