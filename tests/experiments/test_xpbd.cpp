// XPBD and PBD of the experiments: where they agree with the springs, and what they conserve.
#include <doctest/doctest.h>

#include "../simulation/run.h"
#include "experiments/support/xpbd.h"
#include "pliant/constraints/builtin.h"
#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"

namespace test_xpbd {

using namespace pliant;
using namespace pliant_experiments;
using namespace pliant_tests;

namespace {

constexpr Index links = 5;
constexpr Real link_mass = .1;

/// Hangs straight down from its first vertex; the links are 0.2 m long.
Simulation hanging_chain(const SolverSettings& settings, Real stiffness) {
  Simulation simulation(settings);
  const BodyId body = simulation.add_body(chain({.links = links}), Mass::per_vertex(link_mass));
  simulation.add(body, EdgeSpring{.stiffness = stiffness});
  simulation.add(body, Position{.on = {0}});
  add_gravity(simulation);
  return simulation;
}

void advance(Xpbd& xpbd, int steps) {
  for (int i = 0; i < steps; ++i) xpbd.step();
}

Vec3 momentum(const Simulation& simulation, const Xpbd& xpbd) {
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < xpbd.velocities().rows(); ++i) {
    sum += simulation.state().masses[static_cast<std::size_t>(i)] * row(xpbd.velocities(), i);
  }
  return sum;
}

Real tip(const Xpbd& xpbd) {
  return xpbd.positions()(links, 2);
}

}  // namespace

TEST_CASE("XPBD: a hanging chain comes to rest where every link carries what hangs below it") {
  constexpr Real stiffness = 400;
  Xpbd xpbd(hanging_chain({}, stiffness), {.iterations = 200});
  advance(xpbd, 3000);
  for (Index i = 0; i <= links; ++i) {
    Real fallen = 0;
    for (Index link = 1; link <= i; ++link) fallen += link_mass * 9.81 * (links - link + 1) / stiffness;
    CHECK(xpbd.positions()(i, 2) == doctest::Approx(-.2 * i - fallen).epsilon(1e-9));
    CHECK(xpbd.velocities().row(i).norm() < 1e-9);
  }
}

TEST_CASE("XPBD: iterated to the end, a step along one line is that of implicit Euler") {
  SolverSettings settings = converged(1e-11);
  settings.precision = Precision::double_;
  Simulation simulation = hanging_chain(settings, 5e3);
  Xpbd xpbd(simulation, {.iterations = 3000});
  for (int i = 0; i < 20; ++i) {
    simulation.step();
    xpbd.step();
    CHECK(largest_difference(xpbd.positions(), simulation.state().positions) < 1e-9);
    CHECK(largest_difference(xpbd.velocities(), simulation.state().velocities) < 1e-7);
  }
}

TEST_CASE("XPBD: with few iterations springs are softer than asked for") {
  constexpr Real stiffness = 1e5;
  Real before = -1e9;
  for (const int iterations : {1, 2, 5, 20, 100}) {
    Xpbd xpbd(hanging_chain({}, stiffness), {.iterations = iterations});
    advance(xpbd, 1000);
    CHECK(tip(xpbd) > before);
    before = tip(xpbd);
  }
  CHECK(before < -1);  // the last one is still longer than at rest
}

TEST_CASE("XPBD: substeps are steps of their own") {
  SolverSettings settings{.time_step = .02};
  Xpbd whole(hanging_chain(settings, 1e3), {.iterations = 3, .substeps = 4});
  settings.time_step = .005;
  Xpbd parts(hanging_chain(settings, 1e3), {.iterations = 3});
  advance(whole, 10);
  advance(parts, 40);
  CHECK(largest_difference(whole.positions(), parts.positions()) < 1e-12);
}

TEST_CASE("PBD: nothing but lengths at rest is converged to, whatever the stiffness is") {
  for (const Real stiffness : {1., 1e4}) {
    Xpbd pbd(hanging_chain({}, stiffness), {.iterations = 2000, .pbd_share = .5});
    advance(pbd, 5);
    CHECK(tip(pbd) == doctest::Approx(-1).epsilon(1e-9));
  }
  Xpbd soft(hanging_chain({}, 1), {.iterations = 4, .pbd_share = .5});
  Xpbd stiff(hanging_chain({}, 1e4), {.iterations = 4, .pbd_share = .5});
  advance(soft, 10);
  advance(stiff, 10);
  CHECK(soft.positions() == stiff.positions());
  CHECK(tip(soft) < -1.01);
}

TEST_CASE("XPBD and PBD: momentum is conserved where nothing acts from outside") {
  for (const std::optional<double> share : {std::optional<double>(), std::optional<double>(.3)}) {
    Simulation simulation;
    const Mesh mesh = grid({.columns = 4, .rows = 4});
    BodyOptions options{.start = 1.3 * mesh.vertices, .velocities = mesh.vertices};
    std::vector<Real> masses;
    for (Index i = 0; i < mesh.vertex_count(); ++i) masses.push_back(.1 + .05 * i);
    const BodyId body = simulation.add_body(mesh, Mass::each(masses), options);
    simulation.add(body, EdgeSpring{.stiffness = 500});
    Xpbd xpbd(simulation, {.iterations = 7, .pbd_share = share});
    const Vec3 before = momentum(simulation, xpbd);
    const Positions first = xpbd.velocities();
    advance(xpbd, 50);
    CHECK((momentum(simulation, xpbd) - before).norm() < 1e-12 * before.norm());
    CHECK(largest_difference(xpbd.velocities(), first) > .1);  // there was something to conserve it in
  }
}

TEST_CASE("XPBD: soft pins are refused") {
  Simulation simulation = hanging_chain({}, 100);
  simulation.add(BodyId{0}, Position{.on = {3}, .hold = Hold::soft});
  CHECK_THROWS_WITH_AS(Xpbd(simulation, {}), doctest::Contains("soft pins"), Error);
}

}  // namespace test_xpbd
