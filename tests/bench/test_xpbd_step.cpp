// XPBD of the bench: where its sweeps end, against the step that Projective Dynamics converges to.
#include <doctest/doctest.h>

#include "../simulation/run.h"
#include "bench/xpbd.h"
#include "pliant/collision/colliders/builtin.h"
#include "pliant/constraints/builtin.h"
#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"

namespace test_xpbd_step {

using namespace pliant;
using namespace pliant_bench;
using namespace pliant_tests;

namespace {

SolverSettings to_the_end() {
  SolverSettings settings = converged(1e-12);
  settings.precision = Precision::double_;
  settings.acceleration = Acceleration::lbfgs;
  settings.iterations = 5000;
  return settings;
}

/// 5 × 5 vertices that are bent at rest and a tenth larger now; held by two corners, at one of them softly.
Simulation cloth() {
  Simulation simulation(to_the_end());
  Mesh mesh = grid({.columns = 5, .rows = 5, .size = {1, 1}});
  for (Index i = 0; i < mesh.vertex_count(); ++i) mesh.vertices(i, 1) = .1 * std::sin(3 * mesh.vertices(i, 0));
  const BodyOptions options{.start = 1.1 * mesh.vertices, .velocities = mesh.vertices};
  const BodyId body = simulation.add_body(mesh, Mass::area_density(.2), options);
  simulation.add(body, TriangleStrain{.stiffness = 1e3});
  simulation.add(body, HingeBending{.stiffness = 1e-2});
  simulation.add(body, Position{.on = {20}});
  simulation.add(body, Position{.on = {24}, .hold = Hold::soft, .stiffness = 500});
  add_gravity(simulation);
  return simulation;
}

Simulation solid() {
  Simulation simulation(to_the_end());
  const Mesh mesh = bar({.cells = {4, 1, 1}, .size = {4, 1, 1}});
  const BodyId body = simulation.add_body(mesh, Mass::density(1000), {.start = 1.2 * mesh.vertices});
  simulation.add(body, TetrahedronStrain{.stiffness = 1e6});
  simulation.add(body, Position{.on = {0, 5, 10}});
  add_gravity(simulation);
  return simulation;
}

/// Hangs straight down; each link is stretched by a tenth.
Simulation hanging_chain() {
  Simulation simulation(to_the_end());
  const Mesh mesh = chain({.links = 5});
  const BodyId body = simulation.add_body(mesh, Mass::per_vertex(.1), {.start = 1.1 * mesh.vertices});
  simulation.add(body, EdgeSpring{.stiffness = 500});
  simulation.add(body, Position{.on = {0}});
  add_gravity(simulation);
  return simulation;
}

/// How far sweeps end from the converged step, as a share of how far the prediction is from it.
Real share_left(Simulation simulation, Multipliers multipliers, int sweeps) {
  Xpbd xpbd(simulation, multipliers);
  const Positions prediction = xpbd.positions();
  simulation.step();
  const Positions& end = simulation.state().positions;
  for (int i = 0; i < sweeps; ++i) xpbd.sweep();
  return (xpbd.positions() - end).norm() / (prediction - end).norm();
}

}  // namespace

TEST_CASE("XPBD of the bench: sweeps with a multiplier for each row end where the step converges") {
  CHECK(share_left(cloth(), Multipliers::each_row, 20) > 1e-3);
  CHECK(share_left(cloth(), Multipliers::each_row, 20'000) < 1e-6);
  CHECK(share_left(solid(), Multipliers::each_row, 2'000) < 1e-6);
  CHECK(share_left(hanging_chain(), Multipliers::each_row, 5'000) < 1e-6);
}

TEST_CASE("XPBD of the bench: as published it ends there where gradients are constant, and elsewhere where they turn") {
  CHECK(share_left(hanging_chain(), Multipliers::one, 5'000) < 1e-6);
  const Real left = share_left(cloth(), Multipliers::one, 20'000);
  CHECK(left > 1e-3);
  CHECK(share_left(cloth(), Multipliers::one, 40'000) == doctest::Approx(left).epsilon(1e-6));
}

TEST_CASE("XPBD of the bench: a single spring takes one sweep") {
  constexpr Real mass = .3, stiffness = 700, h = 1.0 / 60;
  Simulation simulation({.time_step = h});
  const Mesh mesh = chain({.links = 1, .length = .5});
  const BodyId body = simulation.add_body(mesh, Mass::per_vertex(mass), {.start = 1.4 * mesh.vertices});
  simulation.add(body, EdgeSpring{.stiffness = stiffness});
  simulation.add(body, Position{.on = {0}});
  add_gravity(simulation);
  const Real excess = .2 + 9.81 * h * h;
  const Real left = excess / (1 + stiffness * h * h / mass);
  for (const Multipliers multipliers : {Multipliers::one, Multipliers::each_row}) {
    Xpbd xpbd(simulation, multipliers);
    CHECK(xpbd.positions()(1, 2) == doctest::Approx(-.5 - excess).epsilon(1e-12));
    for (int i = 0; i < 3; ++i) {
      xpbd.sweep();
      CHECK(xpbd.positions()(1, 2) == doctest::Approx(-.5 - left).epsilon(1e-12));
    }
    xpbd.begin_step();
    CHECK(xpbd.positions()(1, 2) == doctest::Approx(-.5 - excess).epsilon(1e-12));
  }
}

TEST_CASE("XPBD of the bench: what it does not have is refused") {
  CHECK(Xpbd::takes(cloth()));
  Simulation on_floor = cloth();
  on_floor.add(PlaneCollider{});
  CHECK_FALSE(Xpbd::takes(on_floor));
  CHECK_THROWS_WITH_AS(Xpbd(on_floor, Multipliers::one), doctest::Contains("no contact"), Error);
  Simulation touching = cloth();
  touching.set_contact({});
  CHECK_FALSE(Xpbd::takes(touching));
  Simulation elastic = solid();
  elastic.add(BodyId{0}, TetrahedronNeoHookean{});
  CHECK_FALSE(Xpbd::takes(elastic));
  Simulation of_second_order({.integrator = Integrator::bdf2});
  CHECK_FALSE(Xpbd::takes(of_second_order));
}

}  // namespace test_xpbd_step
