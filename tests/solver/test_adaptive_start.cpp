// Where iterations begin when `start` is `adaptive`: in the balance that the last step has ended with, as far as forces
// are balanced, and at the prediction, as far as they are not.
#include <doctest/doctest.h>

#include "../simulation/run.h"
#include "pliant/constraints/builtin.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/shapes.h"

namespace test_adaptive_start {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Index side = 12;

/// Hangs from two corners. Without pins it falls, is stretched as it begins, and shakes.
void add_sheet(Simulation& simulation, const std::vector<Index>& pins = {132, 143}) {
  const Mesh mesh = grid({.columns = side, .rows = side});
  BodyOptions options;
  if (pins.empty()) {
    options.start = 1.2 * mesh.vertices;
    for (Index i = 0; i < mesh.vertex_count(); i += 3) options.start(i, 1) += 0.02;
  }
  const BodyId body = simulation.add_body(mesh, Mass::area_density(0.2), options);
  simulation.add(body, TriangleStrain{.stiffness = 1e3});
  simulation.add(body, HingeBending{.stiffness = 1e-3});
  if (!pins.empty()) simulation.add(body, Position{.on = pins});
}

SolverSettings few_iterations(Start start, Integrator integrator = Integrator::implicit_euler) {
  return {.integrator = integrator, .iterations = 2, .acceleration = Acceleration::lbfgs, .start = start};
}

/// Comes to rest with many iterations and damping, and goes on with `settings` from there.
void settle(Simulation& simulation) {
  const SolverSettings settings = simulation.settings();
  SolverSettings resting = settings;
  resting.integrator = Integrator::implicit_euler;
  resting.iterations = 200;
  resting.damping = 10;
  simulation.set_settings(resting);
  advance(simulation, 400);
  simulation.set_settings(settings);
}

/// How far a second takes what rests [m].
template <class Add>
Real moved_from_rest(const SolverSettings& settings, const Add& add) {
  Simulation simulation(settings);
  add(simulation);
  settle(simulation);
  const Positions rest = simulation.state().positions;
  advance(simulation, 60);
  return largest_difference(simulation.state().positions, rest);
}

}  // namespace

TEST_CASE("what hangs at rest stays there, however few the iterations") {
  const auto add = [](Simulation& simulation) {
    add_sheet(simulation);
    add_gravity(simulation);
  };
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    const Real adaptive = moved_from_rest(few_iterations(Start::adaptive, integrator), add);
    const Real from_prediction = moved_from_rest(few_iterations(Start::prediction, integrator), add);
    CHECK(adaptive < 1e-4);
    CHECK(from_prediction > 20 * adaptive);
  }
}

TEST_CASE("a sail that a wind fills stays where it is too") {
  const auto add = [](Simulation& simulation) {
    add_sheet(simulation, {0, side - 1, side * (side - 1), side * side - 1});
    add_gravity(simulation);
    simulation.add(Wind{.velocity = {0, 3, 4}, .drag = 0.5});
  };
  const Real adaptive = moved_from_rest(few_iterations(Start::adaptive), add);
  CHECK(adaptive < 1e-4);
  CHECK(moved_from_rest(few_iterations(Start::prediction), add) > 5 * adaptive);
}

TEST_CASE("each component has its own share: one falls and shakes as alone, one hangs as alone") {
  SolverSettings settings = few_iterations(Start::adaptive);
  settings.acceleration = Acceleration::none;  // L-BFGS has one memory for all
  const auto settled = [&](bool has_first, bool has_second) {
    Simulation simulation(settings);
    if (has_first) add_sheet(simulation);
    if (has_second) add_sheet(simulation, {});
    add_gravity(simulation);
    advance(simulation, 50);
    return simulation.state().positions;
  };
  const Positions both = settled(true, true);
  CHECK(largest_difference(both.topRows(side * side), settled(true, false)) < 1e-12);
  CHECK(largest_difference(both.bottomRows(side * side), settled(false, true)) < 1e-12);
}

TEST_CASE("a step without one of its length before it begins at the prediction") {
  const auto positions = [](Start start, Real second_time_step) {
    Simulation simulation(few_iterations(start));
    add_sheet(simulation);
    add_gravity(simulation);
    SolverSettings settings = simulation.settings();
    if (second_time_step > 0) {
      settings.start = Start::prediction;
      simulation.set_settings(settings);  // the same first step for both
      simulation.step();
      settings.start = start;
      settings.time_step = second_time_step;
      simulation.set_settings(settings);
    }
    simulation.step();
    return simulation.state().positions;
  };
  CHECK(largest_difference(positions(Start::adaptive, 0), positions(Start::prediction, 0)) == 0);
  CHECK(largest_difference(positions(Start::adaptive, 0.01), positions(Start::prediction, 0.01)) == 0);
}

TEST_CASE("BDF2 goes on at once from steps of implicit Euler that began adaptively") {
  Simulation simulation(few_iterations(Start::adaptive));
  add_sheet(simulation);
  add_gravity(simulation);
  advance(simulation, 10);
  simulation.set_settings(few_iterations(Start::adaptive, Integrator::bdf2));
  const State now = simulation.state();
  simulation.step();
  const Positions v = (3 * simulation.state().positions - 4 * now.positions + now.previous_positions) /
                      (2 * simulation.settings().time_step);
  CHECK(largest_difference(simulation.state().velocities, v) < 1e-12);
}

TEST_CASE("a restored state begins where it would have, to the bit, also under implicit Euler") {
  const auto make = [] {
    Simulation simulation(few_iterations(Start::adaptive));
    add_sheet(simulation);
    add_gravity(simulation);
    return simulation;
  };
  Simulation simulation = make();
  advance(simulation, 20);
  const State state = simulation.state();
  CHECK(state.previous_velocities.rows() == state.velocities.rows());
  CHECK(state.previous_time_step == simulation.settings().time_step);
  advance(simulation, 20);
  Simulation other = make();
  other.restore(state);
  advance(other, 20);
  CHECK(largest_difference(simulation.state().positions, other.state().positions) == 0);

  SolverSettings parts = simulation.settings();
  parts.substeps = 3;
  parts.damping = 1;
  for (Simulation* each : {&simulation, &other}) each->set_settings(parts);
  simulation.restore(state);  // of another length: begins at the prediction once
  advance(simulation, 5);
  const State in_parts = simulation.state();
  CHECK(in_parts.previous_time_step == doctest::Approx(parts.time_step / 3));
  advance(simulation, 5);
  other.restore(in_parts);
  advance(other, 5);
  CHECK(largest_difference(simulation.state().positions, other.state().positions) == 0);

  parts.substeps = 1;
  parts.damping = 0;
  other.set_settings(parts);
  other.restore(state);
  advance(other, 20);
  simulation.set_settings(parts);
  simulation.restore(state);
  advance(simulation, 20);
  State without = state;
  without.previous_time_step = 0;
  other.restore(without);
  advance(other, 20);
  CHECK(largest_difference(simulation.state().positions, other.state().positions) > 0);
}

}  // namespace test_adaptive_start
