// Whatever is changed between steps: the steps after it are those of a fresh simulation in the same state, and nothing
// jumps.
#include <functional>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant/constraints/builtin.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/shapes.h"
#include "run.h"

namespace test_live_changes {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// What may be changed of a curtain, with the values it begins with.
struct CurtainOptions {
  SolverSettings settings{.iterations = 8, .precision = Precision::double_};  // pins that come stand beside the factor
  Real spring_stiffness = 500;
  Real bending_stiffness = 1e-3;
  Real drag_target = 0.2;
  bool has_bending = true;
  bool has_drag = false;
  bool has_third_pin = false;
  bool has_push = false;
  bool has_wind = false;
};

/// Groups that are there from the beginning.
struct Curtain {
  explicit Curtain(const CurtainOptions& options) : simulation(options.settings) {
    body = simulation.add_body(grid({.columns = 8, .rows = 8}), Mass::area_density(0.3));
    springs = simulation.add(body, EdgeSpring{.stiffness = options.spring_stiffness});
    pins = simulation.add(body, Position{.on = {56, 63}});
    soft_pins = simulation.add(body, Position{.on = {59}, .hold = Hold::soft, .stiffness = 200});
    simulation.set_target(soft_pins, 0, {0.4, options.drag_target, 0.9});
    add_gravity(simulation);
    if (options.has_bending) bending = simulation.add(body, Bending{.stiffness = options.bending_stiffness});
    if (options.has_drag) add_drag();
    if (options.has_third_pin) add_third_pin();
    if (options.has_push) add_push();
    if (options.has_wind) add_wind();
  }

  void add_drag() {
    simulation.add(body, Drag{.stencils = {{9, 10, 18}}, .stiffness = 50, .targets = Vec3(0.2, 0.1, 0.1)});
  }
  void add_third_pin() { simulation.add(body, Position{.on = {60}, .targets = Vec3(0.55, 0.01, 0.95)}); }
  ForceId add_wind() { return simulation.add(body, Wind{.velocity = {0, 4, 0}}); }
  ForceId add_push() {
    return simulation.add(Gravity{Vec3(0, 2, 0)});  // no forces that know the time
  }

  Simulation simulation;
  BodyId body{};
  GroupId springs{};
  GroupId pins{};
  GroupId soft_pins{};
  GroupId bending{};
};

/// Runs a curtain, changes it, and compares what follows with a curtain that was `after` all along.
void check_change(const CurtainOptions& before, const CurtainOptions& after,
                  const std::function<void(Curtain&)>& change, Real largest_move = 0.05) {
  Curtain changed(before);
  advance(changed.simulation, 25);
  const State state = changed.simulation.state();
  change(changed);
  CHECK(changed.simulation.state().positions == state.positions);
  Curtain fresh(after);
  fresh.simulation.set_state(state.positions, state.velocities);
  for (int step = 0; step < 15; ++step) {
    changed.simulation.step();
    fresh.simulation.step();
    CHECK(largest_difference(changed.simulation.state().positions, fresh.simulation.state().positions) < 1e-9);
    CHECK(largest_difference(changed.simulation.state().velocities, fresh.simulation.state().velocities) < 1e-7);
    if (step > 0) continue;
    // No farther than the velocity and a few dozen g take it within the step.
    const Positions coasting = state.positions + after.settings.time_step * state.velocities;
    CHECK(largest_difference(changed.simulation.state().positions, coasting) < largest_move);
  }
}

}  // namespace

TEST_CASE("a changed stiffness") {
  CurtainOptions after;
  SUBCASE("ten times as stiff") {
    after.spring_stiffness = 5000;
  }
  SUBCASE("a thousandth") {
    after.spring_stiffness = 0.5;
  }
  SUBCASE("and of bending, too") {
    after.spring_stiffness = 700;
    after.bending_stiffness = 10;
  }
  check_change({}, after, [&](Curtain& curtain) {
    curtain.simulation.set_stiffness(curtain.springs, after.spring_stiffness);
    curtain.simulation.set_stiffness(curtain.bending, after.bending_stiffness);
  });
}

TEST_CASE("changed settings") {
  CurtainOptions after;
  SUBCASE("a longer step") {
    after.settings.time_step = 1.0 / 24;
  }
  SUBCASE("a shorter step") {
    after.settings.time_step = 1e-4;
  }
  SUBCASE("more iterations") {
    after.settings.iterations = 50;
  }
  SUBCASE("fewer iterations") {
    after.settings.iterations = 1;
  }
  SUBCASE("another back end") {
    after.settings.backend = Backend::eigen;
  }
  SUBCASE("another ordering") {
    after.settings.ordering = Ordering::minimum_degree;
  }
  SUBCASE("more threads") {
    after.settings.threads = 3;
  }
  SUBCASE("a tolerance") {
    after.settings.tolerance = 1e-2;
  }
  SUBCASE("another start") {
    after.settings.start = Start::positions;
  }
  check_change({}, after, [&](Curtain& curtain) { curtain.simulation.set_settings(after.settings); });
}

TEST_CASE("groups that come and go") {
  CurtainOptions with;
  CurtainOptions without;
  SUBCASE("bending goes") {
    without.has_bending = false;
    check_change(with, without, [](Curtain& curtain) { curtain.simulation.remove(curtain.bending); });
  }
  SUBCASE("bending comes") {
    without.has_bending = false;
    check_change(without, with,
                 [](Curtain& curtain) { curtain.simulation.add(curtain.body, Bending{.stiffness = 1e-3}); });
  }
  SUBCASE("a drag comes") {
    with.has_drag = true;
    check_change(without, with, [](Curtain& curtain) { curtain.add_drag(); });
  }
  SUBCASE("a hard pin comes") {
    with.has_third_pin = true;
    check_change(
        without, with, [](Curtain& curtain) { curtain.add_third_pin(); }, 0.15);  // its target is elsewhere
  }
}

TEST_CASE("a target that moves, and forces that come and go") {
  CurtainOptions with;
  CurtainOptions without;
  SUBCASE("a target") {
    with.drag_target = 0.3;
    check_change(without, with, [](Curtain& curtain) {
      curtain.simulation.set_target(curtain.soft_pins, 0, {0.4, 0.3, 0.9});
    });
  }
  SUBCASE("a force") {
    with.has_push = true;
    check_change(without, with, [](Curtain& curtain) { curtain.add_push(); });
  }
  SUBCASE("wind") {
    with.has_wind = true;
    check_change(without, with, [](Curtain& curtain) { curtain.add_wind(); });
  }
  SUBCASE("a wind that has come and gone") {
    check_change(without, without, [](Curtain& curtain) { curtain.simulation.remove(curtain.add_wind()); });
  }
}

TEST_CASE("a vertex that is pinned without a target is held where it is, and let go it falls from there") {
  Curtain curtain({});
  advance(curtain.simulation, 25);
  const Vec3 place = row(curtain.simulation.state().positions, 20);
  const GroupId pin = curtain.simulation.add(curtain.body, Position{.on = {20}});
  advance(curtain.simulation, 25);
  CHECK(row(curtain.simulation.state().positions, 20) == place);
  curtain.simulation.remove(pin);
  curtain.simulation.step();
  CHECK((row(curtain.simulation.state().positions, 20) - place).norm() < 0.02);
  CHECK(row(curtain.simulation.state().positions, 20) != place);
}

TEST_CASE("hard pins stand at their targets from the step on in which these move") {
  Curtain curtain({});
  REQUIRE(curtain.simulation.target_count(curtain.pins) == 2);
  for (int step = 0; step < 10; ++step) {
    const Vec3 target(0.01 * step, 0.1, 1.1);
    curtain.simulation.set_target(curtain.pins, 1, target);
    curtain.simulation.step();
    CHECK(row(curtain.simulation.state().positions, 63) == target);
    CHECK(row(curtain.simulation.state().positions, 56) == Vec3(0, 0, 1));
  }
}

TEST_CASE("a body that is added while the simulation runs") {
  Simulation simulation({.iterations = 4});
  simulation.add_body(chain({.links = 1}), Mass::total(1));
  add_gravity(simulation);
  advance(simulation, 10);
  const BodyId second = simulation.add_body(chain({.links = 3}), Mass::total(1));
  simulation.add(second, EdgeSpring{.stiffness = 100});
  CHECK(simulation.vertex(second, 2) == 4);
  advance(simulation, 10);
  constexpr Real g_h2 = 9.81 / 3600;
  CHECK(simulation.state().positions(0, 2) == doctest::Approx(-g_h2 * 20 * 21 / 2).epsilon(1e-12));
  CHECK(simulation.state().positions(2, 2) == doctest::Approx(-g_h2 * 10 * 11 / 2).epsilon(1e-12));
}

TEST_CASE("what is refused leaves the simulation as it was") {
  Curtain curtain({});
  Curtain untouched({});
  Simulation& simulation = curtain.simulation;
  const Real nan_value = std::numeric_limits<Real>::quiet_NaN();
  const Positions q = simulation.state().positions;
  Positions bad = q;
  bad(3, 1) = nan_value;
  CHECK(contains(error_of([&] { simulation.set_state(bad, q); }), "positions[3] is not finite"));
  CHECK(contains(error_of([&] { simulation.set_state(2 * q, bad); }), "velocities[3] is not finite"));
  CHECK(contains(error_of([&] { simulation.set_state(q.topRows(5), q); }), "5 rows for 64 vertices"));
  for (const Real stiffness : {0.0, -1.0, nan_value}) {
    CHECK(contains(error_of([&] { simulation.set_stiffness(curtain.springs, stiffness); }), "stiffness"));
  }
  CHECK(contains(error_of([&] { simulation.set_stiffness(GroupId{99}, 1); }), "group 99 does not exist"));
  CHECK(contains(error_of([&] { simulation.set_target(curtain.pins, 2, Vec3(0, 0, 0)); }), "no target 2"));
  CHECK(contains(error_of([&] { simulation.set_target(curtain.pins, -1, Vec3(0, 0, 0)); }), "no target -1"));
  CHECK(contains(error_of([&] { simulation.set_target(curtain.springs, 0, Vec3(0, 0, 0)); }), "no target 0"));
  CHECK(contains(error_of([&] { simulation.set_target(curtain.pins, 0, Vec3(0, nan_value, 0)); }), "not finite"));
  CHECK(contains(error_of([&] { simulation.set_settings({.iterations = 0}); }), "iterations"));
  CHECK(contains(error_of([&] { simulation.remove(GroupId{99}); }), "group 99 does not exist"));
  CHECK(contains(error_of([&] { simulation.remove(ForceId{99}); }), "force 99 does not exist"));
  CHECK(contains(error_of([&] { simulation.vertex(curtain.body, 64); }), "vertex 64 is out of range"));
  advance(simulation, 5);
  advance(untouched.simulation, 5);
  CHECK(simulation.state().positions == untouched.simulation.state().positions);
}

}  // namespace test_live_changes
