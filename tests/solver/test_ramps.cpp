// A stiffness that is led to another one: the factor has the nearest power of two meanwhile, so that most steps
// factorize nothing, and the steps come to the same.
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "pliant/pliant.h"
#include "pliant/timeline/timeline.h"
#include "tests/mesh/meshes.h"

namespace test_ramps {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr BodyId sheet{0};
constexpr Real begin_stiffness = 300;
constexpr Real end_stiffness = 2400;
constexpr int steps = 24;

Simulation make(const SolverSettings& settings) {
  Simulation simulation(settings);
  simulation.add_body(grid({.columns = 9, .rows = 9}), Mass::area_density(0.3));
  simulation.add(sheet, EdgeSpring{.stiffness = begin_stiffness}, "springs");
  simulation.add(sheet, TriangleStrain{.stiffness = 20}, "skin");
  simulation.add(sheet, Position{.on = {72, 80}});
  simulation.add(Gravity{});
  return simulation;
}

GroupId springs(const Simulation& simulation) {
  return simulation.find_group("springs").value();
}

Real duration(const Simulation& simulation) {
  return steps * simulation.settings().time_step;
}

Real stiffness_after(Real from, Real to, int step) {
  return step >= steps ? to : from * std::pow(to / from, static_cast<Real>(step) / steps);
}

}  // namespace

TEST_CASE("ramps: the factor has the nearest power of two, or what is too large to have one") {
  Simulation simulation = make({});
  ConstraintGroup& group = *simulation.groups().at(springs(simulation)).set.batches.front();
  const auto in_factor = [&](Real stiffness) {
    group.set_passing_stiffness(stiffness);
    CHECK(group.stiffness() == stiffness);
    return group.factor_stiffness();
  };
  CHECK(in_factor(1) == 1);
  CHECK(in_factor(1.41) == 1);
  CHECK(in_factor(1.42) == 2);
  CHECK(in_factor(0.75) == 1);
  CHECK(in_factor(0.5) == 0.5);
  CHECK(in_factor(300) == 256);
  constexpr Real largest = std::numeric_limits<Real>::max();
  CHECK(in_factor(largest) == largest);
  CHECK(in_factor(std::numeric_limits<Real>::denorm_min()) == std::numeric_limits<Real>::denorm_min());
  group.set_stiffness(300);
  CHECK(group.factor_stiffness() == 300);
}

TEST_CASE("ramps: one factorization for each doubling, up and down, and one where they end") {
  for (const bool is_up : {true, false}) {
    Simulation simulation = make({.threads = 1});
    if (!is_up) simulation.set_stiffness(springs(simulation), end_stiffness);
    Timeline timeline;
    timeline.step(simulation);
    timeline.ramp_stiffness(simulation, springs(simulation), is_up ? end_stiffness : begin_stiffness,
                            duration(simulation));
    int factorizations = 0;
    for (int i = 0; i < steps; ++i) factorizations += timeline.step(simulation).set_up.numeric > 0 ? 1 : 0;
    CHECK(factorizations == 5);  // 256, 512, 1024, 2048 on the way, and the end
    CHECK(*simulation.stiffness(springs(simulation)) == (is_up ? end_stiffness : begin_stiffness));
    CHECK(timeline.step(simulation).set_up.numeric == 0);
  }
}

TEST_CASE("ramps: converged steps are those with the stiffness of each step in the factor") {
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::lbfgs}) {
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
      const SolverSettings settings{.integrator = integrator,
                                    .iterations = 100000,
                                    .acceleration = acceleration,
                                    .tolerance = 1e-9,
                                    .threads = 1};
      Simulation ramped = make(settings);
      Simulation stepped = make(settings);
      Timeline timeline;
      timeline.ramp_stiffness(ramped, springs(ramped), end_stiffness, duration(ramped));
      for (int i = 1; i <= steps + 2; ++i) {
        timeline.step(ramped);
        stepped.set_stiffness(springs(stepped), stiffness_after(begin_stiffness, end_stiffness, i));
        stepped.step();
      }
      CHECK((ramped.state().positions - stepped.state().positions).cwiseAbs().maxCoeff() < 1e-7);
    }
  }
}

TEST_CASE("ramps: with few iterations steps are hardly farther from converged ones than with the exact factor") {
  Simulation ramped = make({.threads = 1});
  Simulation stepped = make({.threads = 1});
  Simulation converged = make({.iterations = 100000, .tolerance = 1e-9, .threads = 1});
  Timeline timeline;
  timeline.ramp_stiffness(ramped, springs(ramped), end_stiffness, duration(ramped));
  for (int i = 1; i <= steps; ++i) {
    timeline.step(ramped);
    for (Simulation* each : {&stepped, &converged}) {
      each->set_stiffness(springs(*each), stiffness_after(begin_stiffness, end_stiffness, i));
      each->step();
    }
  }
  const auto error = [&](const Simulation& simulation) {
    return (simulation.state().positions - converged.state().positions).cwiseAbs().maxCoeff();
  };
  CHECK(error(stepped) > 5e-4);
  CHECK(error(ramped) < 1.2 * error(stepped));
}

TEST_CASE("ramps: one that is ended, or goes on elsewhere, leaves nothing of itself in the factor") {
  const SolverSettings settings{.iterations = 6, .threads = 1};
  Simulation ramped = make(settings);
  Timeline timeline;
  timeline.ramp_stiffness(ramped, springs(ramped), end_stiffness, duration(ramped));
  for (int i = 0; i < 10; ++i) timeline.step(ramped);
  Simulation copy = ramped.copy();
  timeline.stop_ramp(springs(ramped));
  timeline.step(ramped);
  copy.step();
  CHECK(ramped.state().positions == copy.state().positions);

  Simulation fresh = make(settings);
  fresh.set_stiffness(springs(fresh), *ramped.stiffness(springs(ramped)));
  fresh.restore(ramped.state());
  timeline.step(ramped);
  fresh.step();
  CHECK(ramped.state().positions == fresh.state().positions);
}

/// Of a ramp on a mesh that has an order of its own in the solver, the positions after `steps`, the last of them with a
/// simulation that begins in the middle of the ramp.
Positions end_of_ramp(bool is_resumed) {
  Mesh mesh = grid({.columns = 52, .rows = 52});
  number_at_random(mesh);
  const auto make_shuffled = [&] {
    Simulation simulation({.iterations = 6, .threads = 1});
    simulation.add_body(mesh, Mass::area_density(0.3));
    simulation.add(sheet, EdgeSpring{.stiffness = begin_stiffness}, "springs");
    simulation.add(sheet, TriangleStrain{.stiffness = 20});
    simulation.add(sheet, Position{.on = {0, 51}});
    simulation.add(Gravity{});
    return simulation;
  };
  Simulation simulation = make_shuffled();
  Timeline timeline;
  timeline.step(simulation);
  timeline.ramp_stiffness(simulation, springs(simulation), end_stiffness, duration(simulation));
  for (int i = 0; i < steps / 2; ++i) timeline.step(simulation);
  if (is_resumed) {
    const State state = simulation.state();
    const Real stiffness = *simulation.stiffness(springs(simulation));
    simulation = make_shuffled();
    simulation.set_stiffness(springs(simulation), stiffness);
    simulation.restore(state);
  }
  for (int i = 0; i < steps / 4; ++i) timeline.step(simulation);
  return simulation.state().positions;
}

TEST_CASE("ramps: the same bits where a run is resumed on the way, in the solver's own order too") {
  CHECK((end_of_ramp(true).array() == end_of_ramp(false).array()).all());
}

TEST_CASE("ramps: with Chebyshev, which needs all of the stiffness in the factor, each step factorizes") {
  Simulation simulation = make({.acceleration = Acceleration::chebyshev, .threads = 1});
  Timeline timeline;
  timeline.step(simulation);
  timeline.ramp_stiffness(simulation, springs(simulation), end_stiffness, duration(simulation));
  for (int i = 0; i < steps; ++i) CHECK(timeline.step(simulation).set_up.numeric > 0);
}

}  // namespace test_ramps
