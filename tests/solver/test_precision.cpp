// What single precision of the factor changes: the speed of convergence, and nothing that is converged to.
#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "../simulation/run.h"
#include "pliant/pliant.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/scene.h"

namespace test_precision {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// A curtain with springs and bending that swings from two corners.
Simulation curtain(Precision precision, Index iterations, Index threads = 1) {
  Simulation simulation({.iterations = iterations, .precision = precision, .threads = threads});
  const BodyId body = simulation.add_body(grid({.columns = 24, .rows = 24, .size = {1, 1}}), Mass::per_vertex(0.01));
  simulation.add(Gravity{});
  simulation.add(body, EdgeSpring{.stiffness = 200});
  simulation.add(body, Bending{.stiffness = 1e-4});
  simulation.add(body, Position{.on = std::vector<Index>{552, 575}});
  return simulation;
}

Real distance(const Simulation& a, const Simulation& b) {
  return (a.state().positions - b.state().positions).rowwise().norm().maxCoeff();
}

}  // namespace

TEST_CASE("converged steps in mixed and in double precision agree") {
  Simulation exact = curtain(Precision::double_, 400);
  Simulation mixed = curtain(Precision::mixed, 400);
  for (int i = 0; i < 30; ++i) {
    exact.step();
    mixed.step();
  }
  CHECK(mixed.precision() == Precision::mixed);
  CHECK(mixed.contraction() > 0);
  CHECK(mixed.contraction() < 1e-4);
  CHECK(exact.contraction() == 0);
  CHECK(distance(exact, mixed) < 1e-7);
  CHECK(mixed.warnings() == exact.warnings());
}

TEST_CASE("mixed precision gives the same bits with any number of threads") {
  Simulation once = curtain(Precision::mixed, 10, 1);
  advance(once, 20);
  for (const Index threads : {2, 3, 8}) {
    Simulation other = curtain(Precision::mixed, 10, threads);
    advance(other, 20);
    CHECK(other.state().positions == once.state().positions);
  }
}

TEST_CASE("the precision can be changed while it runs") {
  Simulation simulation = curtain(Precision::double_, 10);
  advance(simulation, 5);
  SolverSettings settings = simulation.settings();
  settings.precision = Precision::mixed;
  simulation.set_settings(settings);
  advance(simulation, 1);
  CHECK(simulation.precision() == Precision::mixed);
  settings.precision = Precision::double_;
  simulation.set_settings(settings);
  advance(simulation, 1);
  CHECK(simulation.precision() == Precision::double_);
}

TEST_CASE("a body at rest does not drift in mixed precision") {
  Simulation simulation({.iterations = 10, .precision = Precision::mixed, .threads = 1});
  const BodyId body = simulation.add_body(grid({.columns = 12, .rows = 12, .size = {1, 1}}), Mass::per_vertex(0.01));
  simulation.add(body, EdgeSpring{.stiffness = 200});
  const Positions start = simulation.state().positions;
  advance(simulation, 200);
  CHECK((simulation.state().positions - start).rowwise().norm().maxCoeff() < 1e-7);
}

TEST_CASE("bodies fall freely in mixed precision, however stiff and light they are") {
  struct Body {
    Real time_step, stiffness, mass;
  };
  for (const Body& each : {Body{1.0 / 60, 1e3, 1.0}, Body{8.0, 1e7, 1e-3}}) {
    const Real time_step = each.time_step;
    CAPTURE(each.stiffness);
    Simulation simulation({.time_step = time_step, .iterations = 10, .precision = Precision::mixed, .threads = 1});
    const BodyId body =
        simulation.add_body(grid({.columns = 8, .rows = 8, .size = {1, 1}}), Mass::per_vertex(each.mass));
    simulation.add(body, EdgeSpring{.stiffness = each.stiffness});
    simulation.add(Gravity{});
    const Positions start = simulation.state().positions;
    const int steps = 10;
    advance(simulation, steps);
    const Real depth = 0.5 * 9.81 * time_step * time_step * steps * (steps + 1);
    const Positions moved = simulation.state().positions - start;
    const Vec3 mean = moved.colwise().mean().transpose();
    CHECK((mean - Vec3(0, 0, -depth)).norm() < 1e-9 * depth);
    CHECK((moved.rowwise() - moved.colwise().mean()).rowwise().norm().maxCoeff() < 1e-6);
  }
}

TEST_CASE("where single precision does not do, that is said once") {
  Simulation simulation({.time_step = 0.5, .iterations = 10, .precision = Precision::mixed});
  const BodyId body = simulation.add_body(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), Mass::per_vertex(1));
  simulation.add(body, EdgeSpring{.stiffness = 100});
  // One drag stays out of the factor, and nine do not.
  const Vec3 target(0.2, 0.9, 0.4);
  const GroupId drag = simulation.add(body, Drag{.stencils = {{0, 1, 2}}, .stiffness = 1e9, .targets = target});
  advance(simulation, 3);
  CHECK(simulation.precision() == Precision::mixed);
  CHECK((simulation.state().positions.colwise().mean().transpose() - target).norm() < 1e-6);
  simulation.remove(drag);
  Stencils nine;
  for (int i = 0; i < 9; ++i) nine.add({0, 1, 2});
  simulation.add(body, Drag{.stencils = nine, .stiffness = 1e9, .targets = target});
  advance(simulation, 3);
  CHECK(simulation.precision() == Precision::double_);
  CHECK(simulation.contraction() > 0.01);
  REQUIRE(simulation.warnings().size() == 1);
  CHECK(contains(simulation.warnings().front(), "precision: "));
}

// Where bodies meet colliders or each other, the loads of friction and the weights of pairs are those of earlier
// iterates, so there is no one fixed point.
TEST_CASE(
    "in every built-in scene without colliders a step in single precision comes to the same fixed point as in double") {
  for (const BuiltinScene& builtin : builtin_scenes()) {
    const std::string name(builtin.name);
    CAPTURE(name);
    Scene scene = parse_scene(builtin.text, {}, builtin.name);
    if (!scene.simulation.colliders().empty()) continue;
    for (int i = 0; i < 40; ++i) scene.step();
    Simulation& simulation = scene.simulation;
    CHECK(simulation.precision() == Precision::mixed);
    const State start = simulation.state();
    if (!start.contact.pairs.empty()) continue;
    const auto converge = [&](Precision precision) {
      SolverSettings settings = simulation.settings();
      settings.iterations = name == "dress_from_panels" ? 3000 : 300;  // whose seams are closing
      settings.precision = precision;
      simulation.set_settings(settings);
      simulation.restore(start);
      simulation.step();
      CHECK(simulation.precision() == precision);
      return simulation.state().positions;
    };
    const Positions exact = converge(Precision::double_);
    const Positions mixed = converge(Precision::mixed);
    const Real size = (exact.colwise().maxCoeff() - exact.colwise().minCoeff()).norm();
    CHECK(largest_difference(exact, mixed) < 1e-6 * size);
    CHECK(largest_difference(exact, start.positions) > 1e-5 * size);
  }
}

}  // namespace test_precision
