// What the system of equations is said to be like, against closed forms.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "pliant/constraints/builtin.h"
#include "pliant/mesh/shapes.h"
#include "pliant/simulation/simulation.h"

namespace test_system_info {

namespace {

using namespace pliant;

TEST_CASE("one spring between two masses: ω² = k (1/m + 1/m)") {
  Simulation simulation;
  const BodyId body = simulation.add_body(chain({.links = 1}), Mass::per_vertex(0.5));
  simulation.add(body, EdgeSpring{.stiffness = 300});
  const SystemInfo info = simulation.system_info();
  CHECK(info.fastest_frequency == doctest::Approx(std::sqrt(300 * 4.0)).epsilon(1e-12));
  CHECK(info.matrix_entries == 3);
  CHECK(info.factor_entries >= 3);
  CHECK(info.pinned_vertices == 0);
  REQUIRE(info.free_components.size() == 1);
  CHECK(info.free_components[0].vertex_count == 2);
}

TEST_CASE("the order of elimination: nested dissection where the factor is dense, minimum degree where it is not") {
  const auto entries = [](Index side, Ordering ordering) {
    Simulation simulation({.backend = Backend::cholmod, .ordering = ordering});
    const BodyId body = simulation.add_body(grid({.columns = side, .rows = side}), Mass::area_density(0.2));
    simulation.add(body, TriangleStrain{});
    simulation.add(body, HingeBending{});
    return simulation.system_info().factor_entries;
  };
  try {
    CHECK(entries(100, Ordering::automatic) == entries(100, Ordering::nested_dissection));
    CHECK(entries(100, Ordering::automatic) < 0.9 * static_cast<double>(entries(100, Ordering::minimum_degree)));
    CHECK(entries(20, Ordering::automatic) == entries(20, Ordering::minimum_degree));
    CHECK(entries(20, Ordering::automatic) != entries(20, Ordering::nested_dissection));
  } catch (const Error& error) {
    MESSAGE("skipped: ", std::string(error.what()));
  }
}

TEST_CASE("a chain of equal springs, pinned at one end") {
  // Fixed at one end and free at the other: ω_j = 2 √(k/m) sin((2j − 1) π / (2 (2n + 1))), j = n the fastest.
  constexpr int n = 40;
  Simulation simulation;
  const BodyId body = simulation.add_body(chain({.links = n}), Mass::per_vertex(0.1));
  simulation.add(body, EdgeSpring{.stiffness = 1000});
  simulation.add(body, Position{.on = {0}});
  const SystemInfo info = simulation.system_info();
  const Real expected = 2 * std::sqrt(1000 / 0.1) * std::sin((2 * n - 1) * std::numbers::pi / (2 * (2 * n + 1)));
  CHECK(info.fastest_frequency == doctest::Approx(expected).epsilon(1e-6));
  CHECK(info.pinned_vertices == 1);
  CHECK(info.free_components.empty());
}

TEST_CASE("the time step does not change it, however short") {
  for (const Real time_step : {1e-12, 1e-3, 10.0}) {
    Simulation simulation(SolverSettings{.time_step = time_step});
    const BodyId body = simulation.add_body(grid({.columns = 6, .rows = 5}), Mass::area_density(0.2));
    simulation.add(body, TriangleStrain{.stiffness = 50});
    simulation.add(body, HingeBending{});
    static Real first = 0;
    const Real frequency = simulation.system_info().fastest_frequency;
    if (first == 0) first = frequency;
    CHECK(frequency == doctest::Approx(first).epsilon(1e-9));
    CHECK(frequency > 0);
  }
}

TEST_CASE("components that nothing holds, and those that something does") {
  Simulation simulation;
  const BodyId pinned = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::total(1));
  simulation.add(pinned, EdgeSpring{});
  simulation.add(pinned, Position{.on = {4}, .hold = Hold::soft});
  const BodyId dragged = simulation.add_body(chain({.links = 2}), Mass::total(1));
  simulation.add(dragged, EdgeSpring{});
  Drag drag;
  drag.stencils.add({1, 2});
  simulation.add(dragged, drag);
  const BodyId loose = simulation.add_body(chain({.links = 4}), Mass::total(1));
  simulation.add(loose, EdgeSpring{.on = {0, 1, 2}});
  const SystemInfo info = simulation.system_info();
  REQUIRE(info.free_components.size() == 3);
  CHECK(info.free_components[0].first_vertex == 12);
  CHECK(info.free_components[0].vertex_count == 3);
  CHECK(info.free_components[1].first_vertex == 15);
  CHECK(info.free_components[1].vertex_count == 1);
}

TEST_CASE("no constraints, all vertices pinned, and numbers beyond all bounds") {
  Simulation none;
  const BodyId body = none.add_body(grid({.columns = 3, .rows = 3}), Mass::total(1));
  CHECK(none.system_info().fastest_frequency == 0);
  CHECK(none.system_info().free_components.size() == 9);
  none.add(body, Position{});
  CHECK(none.system_info().fastest_frequency == 0);
  CHECK(none.system_info().free_components.empty());
}

TEST_CASE("asking changes no step") {
  const auto position = [](bool is_asked) {
    Simulation simulation;
    const BodyId body = simulation.add_body(grid({.columns = 4, .rows = 4}), Mass::total(1));
    simulation.add(body, EdgeSpring{});
    simulation.add(body, Position{.on = {0}});
    simulation.step();
    if (is_asked) simulation.system_info();
    simulation.step();
    return simulation.state().positions;
  };
  CHECK(position(false) == position(true));
}

}  // namespace

}  // namespace test_system_info
