#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include <doctest/doctest.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"
#include "tests/mesh/meshes.h"

namespace test_shapes {

using namespace pliant;
using namespace pliant_tests;

namespace {

Index euler_characteristic(const Mesh& mesh) {
  return mesh.vertex_count() - static_cast<Index>(unique_edges(mesh).size()) +
         static_cast<Index>(mesh.triangles.size());
}

Real area(const Mesh& mesh) {
  const std::vector<Real> areas = triangle_areas(mesh.vertices, mesh.triangles);
  return std::accumulate(areas.begin(), areas.end(), Real{0});
}

/// By the divergence theorem: positive where normals point outward.
Real enclosed_volume(const Mesh& mesh) {
  Real volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += tetrahedron_volume(Vec3::Zero(), row(mesh.vertices, a), row(mesh.vertices, b), row(mesh.vertices, c));
  }
  return volume;
}

/// Each edge is run through once in either direction, where it has two triangles.
bool is_consistently_oriented(const Mesh& mesh) {
  std::map<Edge, int> runs;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      if (++runs[edge] > 1) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("a grid has its vertices in rows, in the plane asked for") {
  const Mesh sheet = grid({.columns = 3, .rows = 4, .size = {2, 6}});
  CHECK(sheet.vertex_count() == 12);
  CHECK(row(sheet.vertices, 0) == Vec3(0, 0, 0));
  CHECK(row(sheet.vertices, 1 * 3 + 2) == Vec3(2, 0, 2));
  CHECK(row(sheet.vertices, 11) == Vec3(2, 0, 6));
  CHECK(row(grid({.columns = 3, .rows = 4, .size = {2, 6}, .plane = Plane::xy}).vertices, 5) == Vec3(2, 2, 0));
  CHECK(row(grid({.columns = 3, .rows = 4, .size = {2, 6}, .plane = Plane::yz}).vertices, 5) == Vec3(0, 2, 2));
  const auto normal = [](Plane plane) {
    const Mesh mesh = grid({.plane = plane});
    return row(triangle_normals(mesh.vertices, mesh.triangles), 7);
  };
  CHECK(normal(Plane::xy) == Vec3(0, 0, 1));
  CHECK(normal(Plane::xz) == Vec3(0, -1, 0));
  CHECK(normal(Plane::yz) == Vec3(1, 0, 0));
}

TEST_CASE("a grid is cut along the diagonals asked for") {
  const auto triangles = [](Diagonals diagonals) {
    return grid({.columns = 3, .rows = 2, .diagonals = diagonals}).triangles;
  };
  CHECK(triangles(Diagonals::forward) == std::vector<Triangle>{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
  CHECK(triangles(Diagonals::backward) == std::vector<Triangle>{{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}});
  CHECK(triangles(Diagonals::alternating) == std::vector<Triangle>{{0, 1, 4}, {0, 4, 3}, {1, 2, 4}, {2, 5, 4}});
  CHECK(triangles(Diagonals::crossed) ==
        std::vector<Triangle>{{0, 1, 6}, {1, 4, 6}, {4, 3, 6}, {3, 0, 6}, {1, 2, 7}, {2, 5, 7}, {5, 4, 7}, {4, 1, 7}});
  for (const Diagonals diagonals :
       {Diagonals::forward, Diagonals::backward, Diagonals::alternating, Diagonals::crossed}) {
    const Mesh sheet = grid({.columns = 6, .rows = 5, .size = {1.5, 0.5}, .diagonals = diagonals});
    CHECK(euler_characteristic(sheet) == 1);
    CHECK(is_consistently_oriented(sheet));
    CHECK(area(sheet) == doctest::Approx(0.75).epsilon(1e-14));
    CHECK_NOTHROW(check_mesh(sheet, "grid"));
  }
}

TEST_CASE("a grid's texture coordinates fill the unit square") {
  const Mesh sheet = grid({.columns = 3, .rows = 2, .size = {4, 4}, .diagonals = Diagonals::crossed});
  CHECK(sheet.faces.face_count() == static_cast<Index>(sheet.triangles.size()));
  for (std::size_t c = 0; c < sheet.faces.vertices.size(); ++c) {
    CHECK(sheet.faces.vertices[c] == sheet.triangles[c / 3][c % 3]);
    const Vec3 x = row(sheet.vertices, sheet.faces.vertices[c]);
    const auto uv = sheet.texture_coordinates.row(sheet.faces.texture_coordinates[c]);
    CHECK(uv[0] == x[0] / 4);
    CHECK(uv[1] == x[2] / 4);
  }
}

TEST_CASE("a net has the grid's vertices, and cords for elements") {
  const Mesh cords = net({.columns = 3, .rows = 2, .size = {4, 1}, .plane = Plane::xy});
  CHECK(cords.vertices == grid({.columns = 3, .rows = 2, .size = {4, 1}, .plane = Plane::xy}).vertices);
  CHECK(cords.edges == std::vector<Edge>{{0, 1}, {1, 2}, {3, 4}, {4, 5}, {0, 3}, {1, 4}, {2, 5}});
  CHECK(cords.triangles.empty());
  const Mesh crossed = net({.columns = 3, .rows = 2, .diagonals = NetDiagonals::both});
  CHECK(std::vector(crossed.edges.begin() + 7, crossed.edges.end()) ==
        std::vector<Edge>{{0, 4}, {1, 3}, {1, 5}, {2, 4}});
  CHECK(net({.columns = 40, .rows = 30}).edges.size() == 39 * 30 + 40 * 29);
  CHECK_NOTHROW(check_mesh(crossed, "net"));
}

TEST_CASE("a pillow is one closed surface, sewn at its border, with nothing double") {
  for (const Plane plane : {Plane::xy, Plane::xz, Plane::yz}) {
    for (const auto& counts : {std::array{3, 3}, {3, 4}, {4, 4}, {4, 7}, {6, 5}, {9, 8}, {17, 17}}) {
      const Index columns = counts[0];
      const Index rows = counts[1];
      CAPTURE(columns);
      CAPTURE(rows);
      const Mesh cushion = pillow({.columns = columns, .rows = rows, .size = {0.6, 0.5}, .plane = plane, .gap = 1e-3});
      CHECK(cushion.vertex_count() == columns * rows + (columns - 2) * (rows - 2));
      CHECK(cushion.triangles.size() == static_cast<std::size_t>(4 * (columns - 1) * (rows - 1)));
      CHECK(euler_characteristic(cushion) == 2);
      CHECK(boundary_edges(cushion).empty());
      CHECK(is_consistently_oriented(cushion));
      CHECK(hinges(cushion).stencils.size() == unique_edges(cushion).size());
      CHECK(vertex_rings(cushion).ring_count() == cushion.vertex_count());
      CHECK_NOTHROW(check_mesh(cushion, "pillow"));
      CHECK(area(cushion) == doctest::Approx(0.6).epsilon(1e-4));
    }
  }
  // The gap over the inner faces, half of it over the cells at the border: a frustum on either side.
  const Mesh cushion = pillow({.columns = 11, .rows = 11, .size = {1, 1}, .plane = Plane::xy, .gap = 0.2});
  CHECK(enclosed_volume(cushion) == doctest::Approx(0.2 * (1 + 0.8 * 0.8 + 0.8) / 3).epsilon(0.01));
  CHECK(cushion.vertices(12, 2) == 0.1);
  CHECK(cushion.vertices(121, 2) == -0.1);
  CHECK(cushion.vertices.row(121).head<2>() == cushion.vertices.row(12).head<2>());
  CHECK(cushion.vertices(5, 2) == 0);
  REQUIRE(cushion.groups.size() == 2);
  CHECK(cushion.groups[0].name == "front");
  CHECK(cushion.groups[1].faces.front() == 200);
  CHECK(cushion.texture_coordinates.row(121) == cushion.texture_coordinates.row(12));
}

TEST_CASE("a torus is one closed surface with a hole") {
  const Mesh ring = torus({.major_segments = 5, .minor_segments = 4, .major_radius = 2, .minor_radius = 1});
  CHECK(ring.vertex_count() == 20);
  CHECK(euler_characteristic(ring) == 0);
  CHECK(is_consistently_oriented(ring));
  CHECK(boundary_edges(ring).empty());
  CHECK(row(ring.vertices, 0) == Vec3(3, 0, 0));
  CHECK(row(ring.vertices, 1) == Vec3(2, 0, 1));
  CHECK(row(ring.vertices, 2) == Vec3(1, 0, 0));
  CHECK(ring.triangles[0] == Triangle{0, 4, 5});
  CHECK(ring.triangles[1] == Triangle{0, 5, 1});
  CHECK_NOTHROW(check_mesh(ring, "torus"));

  constexpr Real pi = std::numbers::pi;
  const Mesh fine = torus({.major_segments = 400, .minor_segments = 200, .major_radius = 0.5, .minor_radius = 0.2});
  CHECK(enclosed_volume(fine) == doctest::Approx(2 * pi * pi * 0.5 * 0.04).epsilon(3e-4));
  CHECK(area(fine) == doctest::Approx(4 * pi * pi * 0.5 * 0.2).epsilon(3e-4));
}

TEST_CASE("a sphere's area and volume converge to the sphere's, four times nearer with each subdivision") {
  constexpr Real pi = std::numbers::pi;
  Real area_error = 0;
  Real volume_error = 0;
  for (Index n = 0; n < 6; ++n) {
    const Mesh ball = sphere({.subdivisions = n, .radius = 2});
    CHECK(ball.vertex_count() == 10 * (1 << 2 * n) + 2);
    CHECK(euler_characteristic(ball) == 2);
    CHECK(is_consistently_oriented(ball));
    CHECK((ball.vertices.rowwise().norm().array() - 2).abs().maxCoeff() < 1e-15);
    const Real finer_area_error = 16 * pi - area(ball);
    const Real finer_volume_error = 32 * pi / 3 - enclosed_volume(ball);
    CHECK(finer_area_error > 0);
    if (n > 1) {
      CHECK(area_error / finer_area_error == doctest::Approx(4).epsilon(0.1));
      CHECK(volume_error / finer_volume_error == doctest::Approx(4).epsilon(0.1));
    }
    area_error = finer_area_error;
    volume_error = finer_volume_error;
  }
  CHECK(area_error / (16 * pi) < 1e-3);
}

TEST_CASE("a cylinder is a prism, open or closed") {
  CylinderOptions options{.segments = 6, .rows = 4, .radius = 2, .height = 3};
  const Real side = 6 * 2.0 * 3;
  const Real lid = 6 * std::sqrt(3.0);
  const Mesh tube = cylinder(options);
  CHECK(euler_characteristic(tube) == 0);
  CHECK(boundary_edges(tube).size() == 12);
  CHECK(area(tube) == doctest::Approx(side).epsilon(1e-14));
  CHECK(row(tube.vertices, 0) == Vec3(2, 0, 0));
  CHECK(tube.vertices(23, 2) == 3);
  CHECK(row(triangle_normals(tube.vertices, tube.triangles), 0)[0] > 0);

  options.caps = Caps::closed;
  const Mesh can = cylinder(options);
  CHECK(can.vertex_count() == tube.vertex_count() + 2);
  CHECK(euler_characteristic(can) == 2);
  CHECK(is_consistently_oriented(can));
  CHECK(area(can) == doctest::Approx(side + 2 * lid).epsilon(1e-14));
  CHECK(enclosed_volume(can) == doctest::Approx(3 * lid).epsilon(1e-14));
}

TEST_CASE("a cylinder with another radius at its top is a blunt cone") {
  const Mesh skirt = cylinder({.segments = 6, .rows = 5, .radius = 2, .height = 3, .top_radius = 1});
  for (Index v = 0; v < skirt.vertex_count(); ++v) {
    const Vec3 x = row(skirt.vertices, v);
    CHECK(x.head<2>().norm() == doctest::Approx(2 - x.z() / 3).epsilon(1e-14));
  }
  // Six trapezoids with sides of 2 and 1; their height has a foot of √3/2 on the floor.
  CHECK(area(skirt) == doctest::Approx(6 * 1.5 * std::hypot(3, std::sqrt(0.75))).epsilon(1e-14));
  const Mesh bucket =
      cylinder({.segments = 6, .rows = 5, .radius = 2, .height = 3, .top_radius = 1, .caps = Caps::closed});
  CHECK(enclosed_volume(bucket) == doctest::Approx((4 + 2 + 1) * 1.5 * std::sqrt(3.0)).epsilon(1e-14));
  CHECK(is_consistently_oriented(bucket));
}

TEST_CASE("a capsule is the hull of two balls, closed, with triangles of one size") {
  for (const Real top_radius : {0.0, 0.04, 0.3, 0.59}) {
    CAPTURE(top_radius);
    const CapsuleOptions options{.segments = 32, .radius = 0.1, .height = 0.5, .top_radius = top_radius};
    const Mesh limb = capsule(options);
    const Real upper = top_radius > 0 ? top_radius : options.radius;
    CHECK(euler_characteristic(limb) == 2);
    CHECK(is_consistently_oriented(limb));
    CHECK(enclosed_volume(limb) > 0);
    check_mesh(limb, "capsule");
    CHECK(limb.vertices.col(2).minCoeff() == -0.1);
    CHECK(limb.vertices.col(2).maxCoeff() == doctest::Approx(0.5 + upper).epsilon(1e-14));
    // On the hull: the distance from the nearest of all balls between both ends is their radius.
    for (Index v = 0; v < limb.vertex_count(); ++v) {
      const Vec3 x = row(limb.vertices, v);
      Real least = 1;
      for (int i = 0; i <= 1000; ++i) {
        const Real share = i / 1000.0;
        least = std::min(least, (x - Vec3(0, 0, 0.5 * share)).norm() - (0.1 + share * (upper - 0.1)));
      }
      CHECK(std::abs(least) < 1e-6);
    }
  }
}

TEST_CASE("a straight tube is a cylinder about its curve, open, with lids, or filled") {
  const std::vector<Vec3> line = {{0, 0, 0}, {0, 0, 1}, {0, 0, 4}};
  const TubeOptions options{.points = line, .segments = 8, .rows = 9, .radius = 0.5};
  const Mesh hose = tube(options);
  CHECK(hose.vertex_count() == 72);
  CHECK(euler_characteristic(hose) == 0);
  CHECK(is_consistently_oriented(hose));
  check_mesh(hose, "tube");
  for (Index v = 0; v < hose.vertex_count(); ++v) {
    const Vec3 x = row(hose.vertices, v);
    CHECK(x.head<2>().norm() == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(x.z() == doctest::Approx(0.5 * (v / 8)).epsilon(1e-3));  // the curve is not run through evenly
  }
  const Real octagon = 8 * 0.5 * 0.25 * std::sqrt(0.5);
  TubeOptions with_lids = options;
  with_lids.ends = TubeEnds::closed;
  const Mesh can = tube(with_lids);
  CHECK(can.vertex_count() == 74);
  CHECK(euler_characteristic(can) == 2);
  CHECK(is_consistently_oriented(can));
  CHECK(enclosed_volume(can) == doctest::Approx(4 * octagon).epsilon(1e-9));
  TubeOptions filled = options;
  filled.inside = TubeInside::solid;
  const Mesh rod = tube(filled);
  CHECK(rod.vertex_count() == 81);
  CHECK(rod.triangles.empty());
  const std::vector<Real> volumes = tetrahedron_volumes(rod.vertices, rod.tetrahedra);
  CHECK(std::ranges::min(volumes) > 0);
  CHECK(std::accumulate(volumes.begin(), volumes.end(), Real{0}) == doctest::Approx(4 * octagon).epsilon(1e-9));
  CHECK(boundary_triangles(rod.tetrahedra).size() == can.triangles.size());
  check_mesh(rod, "tube");
}

TEST_CASE("a tube whose ends are joined is a ring, of a curve out of its plane too") {
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i) {
    const Real angle = 2 * std::numbers::pi * i / 12;
    points.push_back({std::cos(angle), std::sin(angle), 0});
  }
  TubeOptions options{.points = points, .segments = 10, .rows = 60, .radius = 0.1, .ends = TubeEnds::joined};
  const Mesh ring = tube(options);
  CHECK(euler_characteristic(ring) == 0);
  CHECK(is_consistently_oriented(ring));
  const Real section = 10 * 0.5 * 0.01 * std::sin(2 * std::numbers::pi / 10);
  CHECK(enclosed_volume(ring) == doctest::Approx(2 * std::numbers::pi * section).epsilon(0.01));
  for (Index v = 0; v < ring.vertex_count(); ++v) {
    const Vec3 x = row(ring.vertices, v);
    CHECK(std::hypot(x.head<2>().norm() - 1, x.z()) == doctest::Approx(0.1).epsilon(0.05));
  }
  for (std::size_t i = 0; i < points.size(); ++i) points[i].z() = 0.3 * std::sin(1.5 * static_cast<Real>(i));
  options.points = points;
  options.inside = TubeInside::solid;
  const Mesh bent = tube(options);
  CHECK(bent.vertex_count() == 660);
  CHECK(std::ranges::min(tetrahedron_volumes(bent.vertices, bent.tetrahedra)) > 0);
  Mesh skin;
  skin.vertices = bent.vertices.topRows(600);
  skin.triangles = boundary_triangles(bent.tetrahedra);
  CHECK(euler_characteristic(skin) == 0);
  CHECK(is_consistently_oriented(skin));
  // No row is turned against the next: each edge along the tube is about as long as the curve from row to row.
  for (Index v = 0; v < 600; ++v) {
    const Vec3 along = row(bent.vertices, (v + 10) % 600) - row(bent.vertices, v);
    const Vec3 curve = row(bent.vertices, 600 + (v / 10 + 1) % 60) - row(bent.vertices, 600 + v / 10);
    CHECK((along - curve).norm() < 0.07);
  }
}

TEST_CASE("a bar's tetrahedra fill it, meet face to face, and are positive") {
  for (const TetrahedronCut cut : {TetrahedronCut::five, TetrahedronCut::six}) {
    const Mesh box = bar({.cells = {3, 4, 5}, .size = {3, 2, 1.25}, .cut = cut});
    const std::size_t tetrahedra_per_cell = cut == TetrahedronCut::six ? 6 : 5;
    CHECK(box.vertex_count() == 4 * 5 * 6);
    CHECK(box.tetrahedra.size() == 60 * tetrahedra_per_cell);
    // Cells of 1 × 1/2 × 1/4 m: every volume and every sum is exact in binary but for the division by 6.
    const std::vector<Real> volumes = tetrahedron_volumes(box.vertices, box.tetrahedra);
    Real six_fold_sum = 0;
    for (const Real volume : volumes) {
      CHECK(volume > 0);
      six_fold_sum += std::round(6 * volume * 8) / 8;
      CHECK(6 * volume == doctest::Approx(std::round(6 * volume * 8) / 8).epsilon(1e-15));
    }
    CHECK(six_fold_sum == 6 * 3 * 2 * 1.25);

    std::map<Triangle, int> shared;
    for (const Tetrahedron& t : box.tetrahedra) {
      for (Triangle face : {Triangle{t[0], t[1], t[2]}, Triangle{t[0], t[1], t[3]}, Triangle{t[0], t[2], t[3]},
                            Triangle{t[1], t[2], t[3]}}) {
        std::ranges::sort(face);
        ++shared[face];
      }
    }
    const auto count = [&](int times) {
      return std::ranges::count_if(shared, [&](const auto& face) { return face.second == times; });
    };
    const auto outside = 2 * 2 * (3 * 4 + 4 * 5 + 5 * 3);
    CHECK(count(1) == outside);
    CHECK(count(1) + count(2) == static_cast<std::ptrdiff_t>(shared.size()));
    CHECK(outside + 2 * count(2) == static_cast<std::ptrdiff_t>(4 * box.tetrahedra.size()));
    CHECK_NOTHROW(check_mesh(box, "bar"));
  }
}

TEST_CASE("a bar's vertices run along x first; six tetrahedra share the main diagonal of a cell") {
  const Mesh box = bar({.cells = {2, 1, 1}, .size = {2, 3, 5}});
  CHECK(row(box.vertices, 1) == Vec3(1, 0, 0));
  CHECK(row(box.vertices, 3) == Vec3(0, 3, 0));
  CHECK(row(box.vertices, 6) == Vec3(0, 0, 5));
  for (std::size_t t = 0; t < 6; ++t) {
    CHECK(box.tetrahedra[t][0] == 0);
    CHECK(box.tetrahedra[t][3] == 10);
  }
}

TEST_CASE("a chain is straight, of the length asked for") {
  const Mesh rope = chain({.links = 4, .length = 2, .direction = {0, 3e200, 4e200}});
  CHECK(rope.edges == std::vector<Edge>{{0, 1}, {1, 2}, {2, 3}, {3, 4}});
  CHECK(row(rope.vertices, 0) == Vec3(0, 0, 0));
  CHECK((row(rope.vertices, 4) - Vec3(0, 1.2, 1.6)).norm() < 1e-15);
  CHECK((row(rope.vertices, 1) - Vec3(0, 0.3, 0.4)).norm() < 1e-15);
}

TEST_CASE("options out of range are refused by name") {
  static constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  const auto refused = [](const auto& make, const std::string& start) {
    const std::string message = error_of([&] { make(); });
    CAPTURE(message);
    CHECK(message.starts_with(start));
  };
  refused([] { grid({.columns = 1}); }, "grid: columns: 1 is out of range; give a finite number from 2");
  refused([] { grid({.rows = -3}); }, "grid: rows: -3 ");
  refused([] { grid({.size = {0, 1}}); }, "grid: size[0]: 0 is out of range; give a finite number above 0 [m]");
  refused([] { grid({.size = {1, nan}}); }, "grid: size[1]: nan ");
  refused([] { net({.columns = 1}); }, "net: columns: 1 ");
  refused([] { net({.size = {-1, 1}}); }, "net: size[0]: -1 ");
  refused([] { pillow({.columns = 2}); }, "pillow: columns: 2 is out of range; give a finite number from 3");
  refused([] { pillow({.gap = 0}); }, "pillow: gap: 0 ");
  refused([] { torus({.major_segments = 2}); }, "torus: major_segments: 2 ");
  refused([] { torus({.minor_segments = 0}); }, "torus: minor_segments: 0 ");
  refused([] { torus({.minor_radius = -1}); }, "torus: minor_radius: -1 ");
  refused([] { torus({.minor_radius = 0.5}); }, "torus: minor_radius is 0.5; it must be less than major_radius, 0.5");
  refused([] { sphere({.subdivisions = -1}); }, "sphere: subdivisions: -1 ");
  refused([] { sphere({.subdivisions = 12}); },
          "sphere: subdivisions: 12 is out of range; give a finite number from 0 up to 11");
  refused([] { sphere({.radius = 0}); }, "sphere: radius: 0 ");
  refused([] { cylinder({.segments = 2}); }, "cylinder: segments: 2 ");
  refused([] { cylinder({.rows = 1}); }, "cylinder: rows: 1 ");
  refused([] { cylinder({.height = -1}); }, "cylinder: height: -1 ");
  refused([] { cylinder({.top_radius = -1}); }, "cylinder: top_radius: -1 ");
  refused([] { capsule({.segments = 2}); }, "capsule: segments: 2 ");
  refused([] { capsule({.radius = 0}); }, "capsule: radius: 0 ");
  refused([] { capsule({.radius = 0.1, .height = 0.2, .top_radius = 0.4}); }, "capsule: one ball, of 0.4 m, holds");
  refused([] { tube({.segments = 2}); }, "tube: segments: 2 ");
  refused([] { tube({.radius = 0}); }, "tube: radius: 0 ");
  refused([] { tube({.points = std::vector<Vec3>{{0, 0, 0}}}); }, "tube: points: 1 given; a curve needs 2 or more");
  refused([] { tube({.points = std::vector<Vec3>{{0, 0, 0}, {0, 0, nan}}}); }, "tube: points[1]: nan ");
  refused(
      [] {
        tube({.points = std::vector<Vec3>{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}}});
      },
      "tube: points[1] and points[2] are the same; leave one out");
  refused([] { tube({.ends = TubeEnds::joined}); }, "tube: points: 2 given; a curve whose ends are joined needs 3");
  refused(
      [] {
        tube({.points = std::vector<Vec3>{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}, .rows = 2, .ends = TubeEnds::joined});
      },
      "tube: rows: a tube whose ends are joined needs 3 or more");
  refused(
      [] {
        tube({.points = std::vector<Vec3>{{0, 0, 0}, {0, 0.01, 1}, {0, 0.02, 0}}, .radius = 0.3});
      },
      "tube: its curve bends too sharply for a radius of 0.3 m at (");
  refused([] { bar({.cells = {1, 0, 1}}); }, "bar: cells[1]: 0 is out of range; give a finite number from 1");
  refused([] { bar({.size = {1, 1, 0}}); }, "bar: size[2]: 0 ");
  refused([] { chain({.links = 0}); }, "chain: links: 0 ");
  refused([] { chain({.length = nan}); }, "chain: length: nan ");
  refused([] { chain({.direction = {0, nan, 0}}); }, "chain: direction: nan ");
  refused([] { chain({.direction = {0, 0, 0}}); }, "chain: direction is (0, 0, 0);");
}

TEST_CASE("shapes too large for memory are refused, not tried") {
  constexpr Index huge = std::numeric_limits<Index>::max();
  const auto refused = [](const auto& make, const std::string& part) {
    CHECK(contains(error_of([&] { make(); }), part));
  };
  refused([] { grid({.columns = huge, .rows = huge}); },
          "grid: columns and rows ask for 4.61e+18 vertices; stay under");
  refused([] { panel({.columns = huge, .rows = huge}); }, "panel: columns and rows ask for 4.61e+18 vertices");
  refused([] { net({.columns = huge, .rows = huge}); }, "net: columns and rows ask for 4.61e+18 vertices");
  refused([] { pillow({.columns = huge, .rows = huge}); }, "pillow: columns and rows ask for 9.22e+18 vertices");
  refused([] { torus({.major_segments = huge, .minor_segments = huge}); }, "ask for 4.61e+18 vertices");
  refused([] { cylinder({.segments = huge, .rows = huge}); }, "ask for 4.61e+18 vertices");
  refused([] { capsule({.segments = huge}); }, "capsule: segments ask for");
  refused([] { tube({.segments = huge, .rows = huge}); }, "tube: segments and rows ask for 4.61e+18 vertices");
  refused([] { bar({.cells = {huge, huge, huge}}); }, "bar: cells ask for 9.9e+27 vertices");
  refused([] { chain({.links = huge}); }, "chain: links ask for 2.15e+09 vertices");
}

}  // namespace test_shapes
