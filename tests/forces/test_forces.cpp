#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "../simulation/run.h"
#include "force_on.h"
#include "pliant/constraints/builtin.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/shapes.h"

namespace test_forces {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real not_a_number = std::numeric_limits<Real>::quiet_NaN();

/// One vertex at the origin.
Mesh point() {
  return mesh_of({{0, 0, 0}});
}

}  // namespace

TEST_CASE("gravity is m g, and minus the gradient of its potential") {
  Random random;
  const Vec3 g(1, -2, -9);
  Positions x = random.positions(5, 3);
  const std::unique_ptr<Force> built = build(ForceScope{.bodies = {}, .is_whole = true}, Gravity{g});
  Force& gravity = *built;
  const Positions v = Positions::Zero(5, 3);
  const std::vector<Real> masses = {1, 2, 3, 0.5, 4};
  Positions f = Positions::Ones(5, 3);  // forces are added to what is there
  gravity.add_to(f, {x, v, masses, 0, 0}, 0.1);
  const Real before = gravity.potential({x, v, masses, 0, 0});
  for (Index i = 0; i < 5; ++i) {
    CHECK((row(f, i) - Vec3::Ones() - masses[static_cast<std::size_t>(i)] * g).norm() < 1e-14);
    for (int axis = 0; axis < 3; ++axis) {
      Positions moved = x;
      moved(i, axis) += 0.5;
      const Real change = gravity.potential({moved, v, masses, 0, 0}) - before;
      CHECK(change == doctest::Approx(-0.5 * (f(i, axis) - 1)).epsilon(1e-12));
    }
  }
  CHECK(contains(error_of([] {
                   force_on(point(), Gravity{{0, 0, not_a_number}});
                 }),
                 "gravity: the acceleration is not finite"));
}

TEST_CASE("a test force acts on the steps from begin to end, the end not included") {
  Simulation simulation({.time_step = 0.5, .iterations = 1});
  simulation.add_body(chain({.links = 2}), Mass::per_vertex(2));
  simulation.add(TestForce{.vertices = {1}, .force = Vec3(0, 3, 0), .frames = {2, 5}});
  Real speed = 0;
  for (int step = 0; step < 8; ++step) {
    simulation.step();
    if (step >= 2 && step < 5) speed += 0.5 * 3 / 2;
    CHECK(simulation.state().velocities(1, 1) == doctest::Approx(speed));
    CHECK(simulation.state().velocities.row(0).norm() == 0);
  }
}

TEST_CASE("test forces: one for all vertices, or one each") {
  const Positions zero = Positions::Zero(3, 3);
  const std::vector<Real> masses(3, 1);
  Positions f = zero;
  const Mesh mesh = chain({.links = 2});
  const auto add = [&](const TestForce& options, std::int64_t step) {
    force_on(mesh, options)->add_to(f, {zero, zero, masses, step, 0}, 1);
  };
  add({.vertices = {0, 2}, .force = Vec3(1, 2, 3)}, 1000000);
  CHECK(f == (Positions(3, 3) << 1, 2, 3, 0, 0, 0, 1, 2, 3).finished());
  add({.vertices = {0, 2}, .force = std::vector<Vec3>{{1, 0, 0}, {0, 0, -3}}}, 0);
  CHECK(f == (Positions(3, 3) << 2, 2, 3, 0, 0, 0, 1, 2, 0).finished());
}

TEST_CASE("what a test force refuses") {
  const Mesh two = chain({.links = 1});
  const auto refusal = [&](const TestForce& options) { return error_of([&] { force_on(two, options); }); };
  CHECK(contains(refusal({.force = Vec3(0, not_a_number, 0)}), "test_force: force"));
  CHECK(contains(refusal({.force = std::vector<Vec3>{{1, 0, 0}}}), "1 forces for 2 vertices"));
  CHECK(contains(refusal({.vertices = {0}}), "0 forces for 1 vertices"));
  CHECK(contains(refusal({.force = Vec3(1, 0, 0), .frames = {5, 5}}), "[5, 5)"));
  CHECK(contains(refusal({.force = Vec3(1, 0, 0), .frames = {-1, 5}}), "[-1, 5)"));
  Simulation simulation;
  simulation.add_body(point(), Mass::total(1));
  for (const Index vertex : {-1, 1}) {
    const auto add = [&] { simulation.add(TestForce{.vertices = {0, vertex}, .force = Vec3(1, 0, 0)}); };
    CHECK(contains(error_of(add), "test_force: vertex " + std::to_string(vertex) + " is out of range"));
  }
  CHECK(simulation.forces().empty());
  CHECK(contains(error_of([&] { simulation.add_force(nullptr); }), "force: there is none"));
}

TEST_CASE("the mouse spring obeys Hooke's law, and has no force at its own place") {
  const Positions x = (Positions(2, 3) << 0, 0, 0, 1, 2, 2).finished();
  const Positions zero = Positions::Zero(2, 3);
  const std::vector<Real> masses(2, 1);
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 2, 2}});
  MouseSpring spring{.vertices = {0}, .anchor = {1, 2, 2}, .stiffness = 6, .rest_length = 1};
  Positions f = zero;
  force_on(mesh, spring)->add_to(f, {x, zero, masses, 0, 0}, 1);
  CHECK((f - (Positions(2, 3) << 4, 8, 8, 0, 0, 0).finished()).norm() < 1e-14);  // 6 (3 − 1) (1, 2, 2)/3
  f = zero;
  spring.anchor = {0, 0, 0};
  force_on(mesh, spring)->add_to(f, {x, zero, masses, 0, 0}, 1);
  CHECK(f == zero);
  spring.anchor[1] = not_a_number;
  CHECK(contains(error_of([&] { force_on(mesh, spring); }), "mouse_spring: anchor: nan"));
  CHECK(contains(error_of([] { force_on(point(), MouseSpring{.stiffness = -6}); }), "mouse_spring: stiffness"));
}

TEST_CASE("past 4 m/h² the mouse spring warns with the limit, and grows; below it does neither") {
  constexpr Real limit = 4 * 0.5 / (0.1 * 0.1);
  for (const Real stiffness : {0.99 * limit, 1.01 * limit}) {
    Simulation simulation({.time_step = 0.1, .iterations = 1});
    simulation.add_body(point(), Mass::total(0.5));
    simulation.add(MouseSpring{.anchor = {1, 0, 0}, .stiffness = stiffness});
    advance(simulation, 400);
    const bool is_stable = stiffness < limit;
    CHECK((std::abs(simulation.state().positions(0, 0)) < 100) == is_stable);
    REQUIRE(simulation.warnings().size() == (is_stable ? 0 : 1));
    if (is_stable) continue;
    CHECK(contains(simulation.warnings()[0], "4 m/h²"));
    CHECK(contains(simulation.warnings()[0], "4 m/h² = 199.99"));
    CHECK(contains(simulation.warnings()[0], "vertex 0"));
  }
}

TEST_CASE("a changed time step brings the mouse spring's warning once") {
  Simulation simulation({.time_step = 0.01, .iterations = 1});
  simulation.add_body(point(), Mass::total(1));
  simulation.add(MouseSpring{.stiffness = 1e3});
  simulation.step();
  CHECK(simulation.warnings().empty());
  for (const Real time_step : {0.1, 0.01, 0.1}) simulation.set_settings({.time_step = time_step, .iterations = 1});
  CHECK(simulation.warnings().size() == 1);
  const auto add = [&] { simulation.add(MouseSpring{.vertices = {7}}); };
  CHECK(contains(error_of(add), "mouse_spring: vertex 7 is out of range"));
}

TEST_CASE("a force is on the body that is named, or on what its type is on where none is") {
  Simulation simulation({.iterations = 1});
  simulation.add_body(point(), Mass::total(1), {.name = "first"});
  const BodyId second = simulation.add_body(point(), Mass::total(1), {.name = "second"});
  const TestForce push{.force = Vec3(0, 60, 0)};
  CHECK(contains(error_of([&] { simulation.add(push); }), "test_force: it acts on one body and there are 2"));
  const ForceId pushed = simulation.add(second, push);
  const ForceId gravity = simulation.add(second, Gravity{Vec3(60, 0, 0)});
  simulation.step();
  CHECK((simulation.state().velocities - (Positions(2, 3) << 0, 0, 0, 1, 1, 0).finished()).norm() < 1e-12);
  CHECK(simulation.options<TestForce>(pushed)->force[0] == Vec3(0, 60, 0));
  CHECK(simulation.options<Gravity>(pushed) == nullptr);
  simulation.replace(gravity, std::nullopt, Gravity{Vec3(0, 0, 60)});
  simulation.replace(pushed, Gravity{Vec3(0, -60, 0)});  // of another type, on the same body
  CHECK(simulation.name(pushed) == "test_force");
  simulation.add_body(point(), Mass::total(1));  // gravity on everything is on what comes later as well
  simulation.step();
  const Positions expected = (Positions(3, 3) << 0, 0, 1, 1, 0, 1, 0, 0, 1).finished();
  CHECK((simulation.state().velocities - expected).norm() < 1e-12);
}

TEST_CASE("a drag brings a vertex, or the middle of a triangle, to its target at any stiffness") {
  const Vec3 target(0.2, 0.9, 0.4);
  for (const Real stiffness : {1.0, 1e3, 1e9}) {
    for (const Mesh& mesh : {point(), mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})}) {
      Simulation simulation({.time_step = 0.5, .iterations = 10, .precision = Precision::double_});
      const BodyId body = simulation.add_body(mesh, Mass::per_vertex(1));
      simulation.add(body, EdgeSpring{.stiffness = 100});
      Drag drag{.stencils = {{0}}, .stiffness = stiffness, .targets = target};
      if (mesh.vertex_count() == 3) drag.stencils = {{0, 1, 2}};
      simulation.add(body, drag);
      advance(simulation, 800);
      CHECK((simulation.state().positions.colwise().mean().transpose() - target).norm() < 1e-8);
      CHECK(simulation.state().velocities.cwiseAbs().maxCoeff() < 1e-8);
    }
  }
}

TEST_CASE("a drag of 1e9 N/m at a point of a triangle draws a pinned sheet there and keeps still") {
  Simulation simulation({.time_step = 0.5, .iterations = 300});
  const Mesh mesh = grid({.columns = 4, .rows = 4});
  const BodyId body = simulation.add_body(mesh, Mass::total(1));
  simulation.add(body, EdgeSpring{.stiffness = 100});
  simulation.add(body, Position{.on = {12, 15}});
  const Vec3 target(0.3, 0.3, -0.4);
  simulation.add(body,
                 Drag{.stencils = {{0, 1, 5}}, .weights = {{0.2, 0.3, 0.5}}, .stiffness = 1e9, .targets = target});
  add_gravity(simulation);
  advance(simulation, 150);
  const Positions& x = simulation.state().positions;
  CHECK((0.2 * row(x, 0) + 0.3 * row(x, 1) + 0.5 * row(x, 5) - target).norm() < 1e-6);
  CHECK(simulation.state().velocities.cwiseAbs().maxCoeff() < 1e-3);
}

TEST_CASE("the targets of a drag stand in the order of its constraints, whatever their sizes") {
  Simulation simulation;
  const BodyId body = simulation.add_body(grid({.columns = 4, .rows = 4}), Mass::total(1));
  const GroupId drag = simulation.add(body, Drag{.stencils = {{0, 1, 5}, {3}, {2, 6}, {7}},
                                                 .targets = std::vector<Vec3>{Vec3::Constant(1), Vec3::Constant(2),
                                                                              Vec3::Constant(3), Vec3::Constant(4)}});
  REQUIRE(simulation.target_count(drag) == 4);
  for (Index i = 0; i < 4; ++i) CHECK(simulation.target(drag, i) == Vec3::Constant(i + 1));
  simulation.set_target(drag, 1, {9, 9, 9});
  CHECK(simulation.target(drag, 1) == Vec3::Constant(9));
  CHECK(simulation.target(drag, 0) == Vec3::Constant(1));
  CHECK(simulation.target(drag, 2) == Vec3::Constant(3));
}

}  // namespace test_forces
