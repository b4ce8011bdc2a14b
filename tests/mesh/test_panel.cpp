// Panels: grids between four sides that may be curved.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <doctest/doctest.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "tests/mesh/meshes.h"

namespace test_panel {

using namespace pliant;
using namespace pliant_tests;

namespace {

Real area(const Mesh& mesh) {
  const std::vector<Real> areas = triangle_areas(mesh.vertices, mesh.triangles);
  return std::accumulate(areas.begin(), areas.end(), Real{0});
}

}  // namespace

TEST_CASE("a panel is a grid between four sides, with a group of vertices for each") {
  const std::vector<Vec3> bottom = {{-2, 0, 0}, {2, 0, 0}};
  const std::vector<Vec3> top = {{-1, 0, 3}, {1, 0, 3}};
  const Mesh gore = panel({.columns = 9, .rows = 5, .bottom = bottom, .top = top});
  CHECK(gore.triangles == grid({.columns = 9, .rows = 5, .diagonals = Diagonals::alternating}).triangles);
  CHECK(area(gore) == doctest::Approx(9).epsilon(1e-14));
  CHECK(row(gore.vertices, 2 * 9 + 2).isApprox(Vec3(-0.75, 0, 1.5), 1e-14));
  CHECK(row(triangle_normals(gore.vertices, gore.triangles), 0).isApprox(Vec3(0, -1, 0), 1e-14));
  REQUIRE(gore.vertex_groups.size() == 4);
  CHECK(gore.vertex_groups[1].name == "top");
  CHECK(gore.vertex_groups[1].vertices == std::vector<Index>{36, 37, 38, 39, 40, 41, 42, 43, 44});
  CHECK(gore.vertex_groups[2].name == "left");
  CHECK(gore.vertex_groups[2].vertices == std::vector<Index>{0, 9, 18, 27, 36});
  // One scale for both axes, so that the threads run straight up in slanting cells as well.
  for (Index v = 0; v < gore.vertex_count(); ++v) {
    const Vec3 x = row(gore.vertices, v);
    CHECK(gore.texture_coordinates(v, 0) == doctest::Approx((x[0] + 2) / 4).epsilon(1e-14));
    CHECK(gore.texture_coordinates(v, 1) == doctest::Approx(x[2] / 4).epsilon(1e-14));
  }
  const Mesh crossed = panel({.columns = 9, .rows = 5, .bottom = bottom, .top = top, .diagonals = Diagonals::crossed});
  CHECK(crossed.vertex_count() == 45 + 32);
  CHECK(area(crossed) == doctest::Approx(9).epsilon(1e-14));
  CHECK(row(crossed.vertices, 45).isApprox(Vec3(-1.640625, 0, 0.375), 1e-14));
}

TEST_CASE("a panel's curved sides go through their points, with vertices at equal distances") {
  std::vector<Vec3> arc;
  for (int i = 0; i <= 12; ++i)
    arc.push_back({-std::cos(i * std::numbers::pi / 12), std::sin(i * std::numbers::pi / 12), 0});
  const std::vector<Vec3> top = {{-2, 4, 0}, {2, 4, 0}};
  const Mesh half = panel({.columns = 41, .rows = 21, .bottom = arc, .top = top, .left = Vec3(-1.2, 2, 0)});
  const Real spacing = (row(half.vertices, 1) - row(half.vertices, 0)).norm();
  CHECK(spacing == doctest::Approx(std::numbers::pi / 40).epsilon(0.01));
  for (Index i = 0; i < 41; ++i) {
    CHECK(row(half.vertices, i).norm() == doctest::Approx(1).epsilon(6e-3));
    if (i > 0)
      CHECK((row(half.vertices, i) - row(half.vertices, i - 1)).norm() == doctest::Approx(spacing).epsilon(3e-3));
  }
  Real nearest = 1;
  for (Index j = 0; j < 21; ++j) nearest = std::min(nearest, (row(half.vertices, j * 41) - Vec3(-1.2, 2, 0)).norm());
  CHECK(nearest < 0.11);  // half the distance of its vertices
  CHECK(half.vertices.col(2).isZero());
  // No cell is lost or counted twice: the cells' areas add up to what the outline holds.
  Real outline = 0;
  const auto add = [&](Index a, Index b) { outline += row(half.vertices, a).cross(row(half.vertices, b)).z() / 2; };
  for (Index i = 0; i < 40; ++i) add(i, i + 1), add(861 - 1 - i, 861 - 2 - i);
  for (Index j = 0; j < 20; ++j) add(j * 41 + 40, (j + 1) * 41 + 40), add((20 - j) * 41, (19 - j) * 41);
  CHECK(area(half) == doctest::Approx(outline).epsilon(1e-12));
}

TEST_CASE("a point given twice is a corner in a panel's side") {
  const Vec3 peak(0, 0, 2);
  const auto house = [&](bool is_sharp) {
    std::vector<Vec3> roof = {{-1, 0, 1}, peak, {1, 0, 1}};
    if (is_sharp) roof.insert(roof.begin() + 1, peak);
    return area(panel({.columns = 41, .rows = 11, .bottom = std::vector<Vec3>{{-1, 0, 0}, {1, 0, 0}}, .top = roof}));
  };
  CHECK(house(true) == doctest::Approx(3).epsilon(1e-12));
  CHECK(house(false) > 3.1);
}

TEST_CASE("panels that cannot be are refused with the side and the remedy") {
  static constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  const auto refused = [](const auto& make, const std::string& start) {
    const std::string message = error_of([&] { make(); });
    CAPTURE(message);
    CHECK(message.starts_with(start));
  };
  refused([] { panel({.columns = 1}); }, "panel: columns: 1 ");
  refused([] { panel({.bottom = std::vector<Vec3>{{0, 0, 0}}}); }, "panel: bottom: 1 given; it needs two points");
  refused([] { panel({.top = {}}); }, "panel: top: 0 given; it needs two points");
  refused([] { panel({.left = Vec3(0, nan, 0)}); }, "panel: left: nan ");
  refused([] { panel({.right = Vec3(1, 0, 1)}); }, "panel: right: the point (1, 0, 1) m is given twice where the side");
  refused(
      [] {
        panel({.bottom = std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}}});
      },
      "panel: bottom: the point (1, 0, 0) m is given twice where the side ends, or three times");
  refused([] { panel({.top = std::vector<Vec3>{{1, 0, 1}, {0, 0, 1}}}); }, "panel: between its sides it folds over");
  refused([] { panel({.left = Vec3(1.5, 0, 0.5)}); }, "panel: between its sides it folds over itself at (");
  refused([] { panel({.bottom = std::vector<Vec3>{{0, 0, 1}, {1, 0, 1}}}); }, "panel: left: ");
}

}  // namespace test_panel
