#include <limits>
#include <numeric>

#include <doctest/doctest.h>

#include "pliant/mesh/mass.h"
#include "pliant/mesh/shapes.h"
#include "tests/mesh/meshes.h"

namespace test_mass {

using namespace pliant;
using namespace pliant_tests;

namespace {

Real sum(const std::vector<Real>& masses) {
  return std::accumulate(masses.begin(), masses.end(), Real{0});
}

std::string refusal(const Mesh& mesh, const Mass& mass) {
  return error_of([&] { vertex_masses(mesh, mass, "flag"); });
}

/// Two triangles, and a vertex that belongs to neither.
Mesh sheet_with_a_stray_vertex() {
  Mesh mesh = grid({.columns = 2, .rows = 2});
  mesh.vertices.conservativeResize(5, 3);
  mesh.vertices.row(4).setZero();
  return mesh;
}

}  // namespace

TEST_CASE("densities give the mass of the shape, lumped") {
  const Mesh sheet = grid({.columns = 2, .rows = 2, .size = {2, 3}});
  CHECK(vertex_masses(sheet, Mass::area_density(0.5), "") == std::vector<Real>{1, 0.5, 0.5, 1});
  const Mesh large = grid({.columns = 7, .rows = 4, .size = {2, 3}, .diagonals = Diagonals::alternating});
  CHECK(sum(vertex_masses(large, Mass::area_density(0.5), "")) == doctest::Approx(3).epsilon(1e-14));

  for (const TetrahedronCut cut : {TetrahedronCut::five, TetrahedronCut::six}) {
    const Mesh box = bar({.cells = {3, 4, 2}, .size = {1, 2, 0.5}, .cut = cut});
    CHECK(sum(vertex_masses(box, Mass::density(1000), "")) == doctest::Approx(1000).epsilon(1e-14));
  }
  CHECK(vertex_masses(chain({.links = 2, .length = 4}), Mass::line_density(0.5), "") == std::vector<Real>{0.5, 1, 0.5});
}

TEST_CASE("the total is shared by volume, area, length, or equally") {
  CHECK(vertex_masses(grid({.columns = 2, .rows = 2}), Mass::total(6), "") == std::vector<Real>{2, 1, 1, 2});
  CHECK(vertex_masses(chain({.links = 2}), Mass::total(4), "") == std::vector<Real>{1, 2, 1});
  CHECK(vertex_masses(mesh_of({{0, 0, 0}, {5, 0, 0}}), Mass::total(4), "") == std::vector<Real>{2, 2});
  const std::vector<Real> bar_masses = vertex_masses(bar({.cells = {1, 1, 1}}), Mass::total(8), "");
  CHECK(sum(bar_masses) == doctest::Approx(8).epsilon(1e-15));
  CHECK(bar_masses.front() == doctest::Approx(2).epsilon(1e-15));  // corner 0 has all six tetrahedra, a quarter of each
  CHECK(bar_masses[1] == doctest::Approx(2.0 / 3).epsilon(1e-15));
}

TEST_CASE("masses per vertex and each by itself are taken as they are") {
  const Mesh stray = sheet_with_a_stray_vertex();
  CHECK(vertex_masses(stray, Mass::per_vertex(0.25), "") == std::vector<Real>(5, 0.25));
  const std::vector<Real> each{1, 2, 3, 4, 5e-300};
  CHECK(vertex_masses(stray, Mass::each(each), "") == each);
}

TEST_CASE("masses add up: a density for each kind of element") {
  Mesh both = joined(grid({.columns = 2, .rows = 2}), chain({.links = 2, .length = 4}));
  const Mass mass = Mass::area_density(6) + Mass::line_density(0.5);
  CHECK(vertex_masses(both, mass, "") == std::vector<Real>{2, 1, 1, 2, 0.5, 1, 0.5});
  CHECK(vertex_masses(both, mass + Mass::per_vertex(1), "") == std::vector<Real>{3, 2, 2, 3, 1.5, 2, 1.5});
  CHECK(contains(refusal(both, Mass::area_density(6)), "vertex 4 has mass 0; no element gives it any"));
  CHECK(contains(refusal(both, mass + Mass::line_density(-1)), "the mass is -1"));
  CHECK(contains(refusal(both, mass + Mass::density(1)), "the mesh has no tetrahedra"));
}

TEST_CASE("a mass that is not finite and positive is refused, with its vertex") {
  const Mesh sheet = grid({.columns = 2, .rows = 2});
  constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  for (const Real bad : {0.0, -1.0, nan, std::numeric_limits<Real>::infinity()}) {
    CHECK(contains(refusal(sheet, Mass::per_vertex(bad)), "flag: the mass is "));
    CHECK(contains(refusal(sheet, Mass::total(bad)), "give one that is finite and above 0"));
    CHECK(contains(refusal(sheet, Mass::area_density(bad)), "flag: the mass is "));
    CHECK(contains(refusal(sheet, Mass::each({1, 1, bad, 1})), "flag: vertex 2 has mass "));
  }
  CHECK(refusal(sheet, Mass::each({1, 1, 0, 1})) ==
        "flag: vertex 2 has mass 0; give every vertex one that is finite and above 0");
  CHECK(refusal(sheet, Mass::each({1, 1})) == "flag: there are 2 masses for 4 vertices; give one for each vertex");
}

TEST_CASE("a vertex that no element gives mass is named") {
  const Mesh stray = sheet_with_a_stray_vertex();
  const std::string expected =
      "flag: vertex 4 has mass 0; no element gives it any: remove the vertex, or give one mass per vertex";
  CHECK(refusal(stray, Mass::area_density(1)) == expected);
  CHECK(refusal(stray, Mass::total(1)) == expected);
}

TEST_CASE("a density asks for its elements") {
  const Mesh sheet = grid({});
  CHECK(contains(refusal(sheet, Mass::density(1)), "given as a density, but the mesh has no tetrahedra"));
  CHECK(contains(refusal(sheet, Mass::line_density(1)), "given as a line density, but the mesh has no edge elements"));
  CHECK(contains(refusal(bar({}), Mass::area_density(1)), "given as an area density, but the mesh has no triangles"));
}

}  // namespace test_mass
