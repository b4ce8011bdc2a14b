// Equilibria that are known in closed form, or to which fine discretizations converge. Long steps are nearly static.
#include <doctest/doctest.h>

#include "../simulation/run.h"
#include "pliant/constraints/builtin.h"
#include "pliant/mesh/shapes.h"

namespace test_statics {

using namespace pliant;
using namespace pliant_tests;

namespace {

std::vector<Index> vertices_where(const Mesh& mesh, int axis, Real value) {
  std::vector<Index> found;
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    if (std::abs(mesh.vertices(i, axis) - value) < 1e-9) found.push_back(i);
  }
  return found;
}

/// Mean displacement along an axis of the vertices that rest at a place on another axis.
Real mean_displacement(const Simulation& simulation, const Mesh& mesh, const std::vector<Index>& vertices, int axis) {
  Real sum = 0;
  for (const Index i : vertices) sum += simulation.state().positions(i, axis) - mesh.vertices(i, axis);
  return sum / static_cast<Real>(vertices.size());
}

}  // namespace

TEST_CASE("a hanging chain: every link carries what hangs below it") {
  for (const Real time_step : {1.0 / 60, 8.0}) {
    Simulation simulation(converged(1e-11, time_step));
    const Mesh mesh = chain({.links = 10});
    const BodyId body = simulation.add_body(mesh, Mass::per_vertex(0.1));
    simulation.add(body, EdgeSpring{.stiffness = 1e4});
    simulation.add(body, Position{.on = {0}});
    add_gravity(simulation);
    advance(simulation, time_step < 1 ? 6000 : 10);
    for (int i = 1; i <= 10; ++i) {
      const Real carried = 0.1 * 9.81 * (i * (21 - i) / 2);  // Σ over the links above of the masses below
      CHECK(simulation.state().positions(i, 2) == doctest::Approx(-0.1 * i - carried / 1e4).epsilon(1e-9));
    }
    CHECK(simulation.state().positions(10, 2) == doctest::Approx(-1.0053955).epsilon(1e-9));
  }
}

TEST_CASE("a chain between two pins sags as the discrete catenary") {
  Simulation simulation(converged(1e-8, 8));
  const Mesh mesh = chain({.links = 20, .length = 1.5, .direction = {1, 0, 0}});
  BodyOptions options{.start = mesh.vertices};
  for (int i = 0; i <= 20; ++i) options.start.row(i) << i / 20.0, 0, -2 * (i / 20.0) * (1 - i / 20.0);
  const BodyId body = simulation.add_body(mesh, Mass::total(1), options);
  simulation.add(body, EdgeSpring{.stiffness = 1e4});
  simulation.add(body, Position{.on = {0, 20}});
  add_gravity(simulation);
  advance(simulation, 15);
  CHECK(-simulation.state().positions.col(2).minCoeff() == doctest::Approx(0.5076758).epsilon(1e-7));
}

TEST_CASE("the stretch of a rope does not depend on the number of its links") {
  // EA = 500 N; a rope of 1 kg lengthens by m g L/(2 EA), exactly so when its mass is lumped to the vertices.
  for (const Index links : {1, 4, 32}) {
    Simulation simulation(converged(1e-11, 8));
    const BodyId body = simulation.add_body(chain({.links = links}), Mass::total(1));
    simulation.add(body, EdgeStrain{.stiffness = 500});
    simulation.add(body, Position{.on = {0}});
    add_gravity(simulation);
    advance(simulation, 20);
    CHECK(-simulation.state().positions(links, 2) - 1 == doctest::Approx(9.81 / (2 * 500)).epsilon(1e-6));
  }
}

TEST_CASE("a sheet hung by its top edge lengthens by rho g L²/(2k), whatever its cells and how they are cut") {
  for (const Diagonals diagonals : {Diagonals::forward, Diagonals::alternating, Diagonals::crossed}) {
    for (const Index cells : {1, 4, 8, 16}) {
      CAPTURE(cells);
      Simulation simulation(converged(1e-8, 8));
      const Mesh mesh = grid({.columns = cells + 1, .rows = cells + 1, .diagonals = diagonals});
      const BodyId body = simulation.add_body(mesh, Mass::area_density(0.2));
      simulation.add(body, TriangleStrain{.stiffness = 50});
      simulation.add(body, Position{.on = vertices_where(mesh, 2, 1)});
      add_gravity(simulation);
      advance(simulation, 15);
      const Real lengthening = -mean_displacement(simulation, mesh, vertices_where(mesh, 2, 0), 2);
      CHECK(lengthening == doctest::Approx(0.01962).epsilon(1e-3));
    }
  }
}

TEST_CASE("a hung tetrahedral bar lengthens by rho g L²/(2k)") {
  Simulation simulation(converged(1e-3, 8));
  const Mesh mesh = bar({.cells = {5, 2, 2}, .size = {1, 0.4, 0.4}});
  const BodyId body = simulation.add_body(mesh, Mass::density(1000));
  simulation.add(body, TetrahedronStrain{.stiffness = 2e4});
  simulation.add(body, Position{.on = vertices_where(mesh, 0, 0)});
  add_gravity(simulation, {9.81, 0, 0});
  advance(simulation, 12);
  CHECK(mean_displacement(simulation, mesh, vertices_where(mesh, 0, 1), 0) == doctest::Approx(0.24525).epsilon(1e-3));
}

TEST_CASE("a clamped tetrahedral bar sags by the share of the beam's sag that its resolution allows") {
  // 20 × 4 × 4 cells give .826, 30 × 6 × 6 give .913 of the Timoshenko beam's .075929 m: too slow to repeat here.
  Simulation simulation(converged(1e-2, 8));
  const Mesh mesh = bar({.cells = {10, 2, 2}, .size = {2, 0.4, 0.4}});
  const BodyId body = simulation.add_body(mesh, Mass::density(100));
  simulation.add(body, TetrahedronStrain{.stiffness = 2e6});
  simulation.add(body, Position{.on = vertices_where(mesh, 0, 0)});
  add_gravity(simulation);
  advance(simulation, 4);
  const Real sag = -mean_displacement(simulation, mesh, vertices_where(mesh, 0, 2), 2);
  CHECK(sag / 0.075929 == doctest::Approx(0.557).epsilon(2e-3));
}

TEST_CASE("a clamped heavy sheet droops as the elastica does: within 1 % with 40 links") {
  // Side view of a sheet 1 m wide, 1 m long, 1 kg/m²: Γ = ρ g L³/κ, droop H over reach W of the free end.
  constexpr int links = 40;
  constexpr Real length = 1.0 / links;
  constexpr std::array<std::pair<Real, Real>, 3> cases = {{{1, 0.124562}, {10, 1.066802}, {100, 5.888105}}};
  for (const auto& [gamma, ratio] : cases) {
    Simulation simulation({.time_step = 0.2, .iterations = 3000, .tolerance = 1e-6, .threads = 1});
    const Mesh mesh = chain({.links = links + 1, .length = 1 + length, .direction = {1, 0, 0}});
    const BodyId body = simulation.add_body(mesh, Mass::line_density(1));
    simulation.add(body, EdgeSpring{.stiffness = 3e5});
    simulation.add(body, Position{.on = {0, 1}});
    Bending bending{.stiffness = 9.81 / gamma};
    std::vector<Real> areas;
    for (Index i = 1; i <= links; ++i) {
      // v is the second difference; at the clamp the whole turn falls on half a link, so it weighs twice.
      areas.push_back(i == 1 ? 2 * length : length);
      bending.stencils.add({i, i - 1, i + 1});
      bending.cotangents.add({2 * areas.back() / (length * length), 2 * areas.back() / (length * length)});
    }
    bending.areas = areas;
    simulation.add(body, bending);
    add_gravity(simulation);
    Real speed = 1;
    for (int step = 0; step < 100 && speed > 1e-4; ++step) {
      simulation.step();
      speed = simulation.state().velocities.cwiseAbs().maxCoeff();
    }
    const Vec3 end = row(simulation.state().positions, links + 1);
    CHECK(-end[2] / (end[0] - length) == doctest::Approx(ratio).epsilon(0.01));
  }
}

TEST_CASE("a clamped strip sags as the heavy elastica, however its cells are cut: within 1 %, with 20 cells along it") {
  // As above, of the free length from half a row behind the last that is pinned; rows are half as far apart in crossed
  // cells.
  constexpr Index cells = 20;
  constexpr Real gamma = 10;
  constexpr Real elastica = 0.700200;
  for (const Diagonals diagonals : {Diagonals::forward, Diagonals::alternating, Diagonals::crossed}) {
    const Real behind = diagonals == Diagonals::crossed ? 0.25 : 0.5;
    const Real size = 1 / (cells + behind);
    const Mesh mesh = grid({.columns = cells + 2,
                            .rows = 4,
                            .size = {(cells + 1) * size, 3 * size},
                            .plane = Plane::xy,
                            .diagonals = diagonals});
    Simulation simulation(
        {.time_step = 0.2, .iterations = 300, .acceleration = Acceleration::lbfgs, .tolerance = 1e-6, .threads = 1});
    const BodyId body = simulation.add_body(mesh, Mass::area_density(1));
    simulation.add(body, TriangleStrain{.stiffness = 1e4});
    simulation.add(body, TriangleBending{.stiffness = 9.81 / gamma});
    std::vector<Index> clamped;
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      if (mesh.vertices(i, 0) < 1.01 * size) clamped.push_back(i);
    }
    simulation.add(body, Position{.on = clamped});
    add_gravity(simulation);
    Real speed = 1;
    for (int step = 0; step < 100 && speed > 1e-4; ++step) {
      simulation.step();
      speed = simulation.state().velocities.cwiseAbs().maxCoeff();
    }
    const std::vector<Index> end = vertices_where(mesh, 0, (cells + 1) * size);
    const Real sag = -mean_displacement(simulation, mesh, end, 2);
    CHECK(std::abs(sag / elastica - 1) < 0.01);
  }
}

}  // namespace test_statics
