// Pressure against closed forms: Gauss, Boyle, Laplace.
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "../simulation/run.h"
#include "pliant/constraints/builtin.h"
#include "pliant/forces/pressure.h"
#include "pliant/mesh/shapes.h"

namespace test_pressure {

using namespace pliant;
using namespace pliant_tests;

namespace {

struct Held {
  Mesh mesh;
  std::vector<Real> masses = std::vector<Real>(static_cast<std::size_t>(mesh.vertex_count()), 1);
  Positions still = Positions::Zero(mesh.vertex_count(), 3);

  StateView at(const Positions& x) const { return {x, still, masses, 0, 0}; }
  Positions forces(PressureForce& pressure, const Positions& x) const {
    Positions f = Positions::Zero(x.rows(), 3);
    pressure.add_to(f, at(x), 1);
    return f;
  }
};

std::vector<Pressure> every_model() {
  return {{.pressure = 70},
          {.pressure = -70},
          {.model = PressureModel::gas, .pressure = 70},
          {.model = PressureModel::gas, .pressure = -30, .ambient = 100}};
}

Mesh inside_out(Mesh mesh) {
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  return mesh;
}

std::string refusal(const Mesh& mesh, const Pressure& options = {}) {
  return error_of([&] { PressureForce(mesh, 0, options); });
}

}  // namespace

TEST_CASE("pressure pushes outward with p A n, a third to each vertex") {
  const Held box{bar({.cells = {1, 1, 1}, .size = {2, 3, 4}, .cut = TetrahedronCut::five})};
  PressureForce pressure(box.mesh, 0, {.pressure = 5});
  CHECK(pressure.rest_volume() == doctest::Approx(24).epsilon(1e-14));
  const Positions f = box.forces(pressure, box.mesh.vertices);
  Vec3 right = Vec3::Zero();
  for (Index v = 0; v < 8; ++v) {
    if (box.mesh.vertices(v, 0) > 1) right += row(f, v);
  }
  CHECK(right[0] == doctest::Approx(5 * 12).epsilon(1e-13));
}

TEST_CASE("on a closed surface of any shape the forces and their torques sum to zero") {
  Random random;
  for (const Pressure& options : every_model()) {
    const Held ring{torus({.major_segments = 9, .minor_segments = 7})};
    PressureForce pressure(ring.mesh, 0, options);
    const Positions x = ring.mesh.vertices + 0.05 * random.positions(ring.mesh.vertex_count(), 1);
    const Positions f = ring.forces(pressure, x);
    CHECK(f.cwiseAbs().maxCoeff() > 0.1);
    CHECK(f.colwise().sum().norm() < 1e-12);
    Vec3 torque = Vec3::Zero();
    for (Index i = 0; i < x.rows(); ++i) torque += row(x, i).cross(row(f, i));
    CHECK(torque.norm() < 1e-12);
  }
}

TEST_CASE("the forces are minus the gradient of the potential, and their work is p dV") {
  Random random;
  for (const Pressure& options : every_model()) {
    const Held ball{sphere({.subdivisions = 1, .radius = 0.4})};
    PressureForce pressure(ball.mesh, 0, options);
    CHECK(std::abs(pressure.potential(ball.at(ball.mesh.vertices))) < 1e-12);
    const Positions x = 1.2 * ball.mesh.vertices + 0.05 * random.positions(ball.mesh.vertex_count(), 1);
    const Positions f = ball.forces(pressure, x);
    const Positions direction = random.positions(ball.mesh.vertex_count(), 1);
    const Real step = 1e-6;
    const Positions ahead = x + step * direction;
    const Positions behind = x - step * direction;
    const Real work = f.cwiseProduct(direction).sum();
    const Real slope = (pressure.potential(ball.at(ahead)) - pressure.potential(ball.at(behind))) / (2 * step);
    const Real swept = (pressure.volume(ahead) - pressure.volume(behind)) / (2 * step);
    CHECK(slope == doctest::Approx(-work).epsilon(1e-7));
    CHECK(pressure.pressure_at(pressure.volume(x)) * swept == doctest::Approx(work).epsilon(1e-7));
  }
}

TEST_CASE("a gas keeps P V; squeezed flat or turned inside out it stays finite, and its potential continuous") {
  const Mesh box = bar({.cells = {1, 1, 1}, .size = {1, 1, 1}});
  const PressureForce gas(box, 0, {.model = PressureModel::gas, .pressure = 20, .ambient = 100});
  for (const Real volume : {0.02, 0.5, 1.0, 3.0}) {
    CHECK((gas.pressure_at(volume) + 100) * volume == doctest::Approx(120).epsilon(1e-13));
  }
  CHECK(gas.pressure_at(0) == doctest::Approx(120 / 0.01 - 100));
  CHECK(gas.pressure_at(-5) == gas.pressure_at(0));
  const Held body{box};
  const auto potential = [&](Real height) {
    Positions x = box.vertices;
    x.col(2) *= height;
    return gas.potential(body.at(x));
  };
  const Real below = (potential(0.01) - potential(0.01 - 1e-5)) / 1e-5;
  const Real above = (potential(0.01 + 1e-5) - potential(0.01)) / 1e-5;
  CHECK(below == doctest::Approx(-gas.pressure_at(0.01)).epsilon(1e-6));
  CHECK(above == doctest::Approx(below).epsilon(1e-2));
}

TEST_CASE("which way the triangles run makes no difference, nor where the body's vertices begin") {
  const Held ball{sphere({.subdivisions = 1})};
  PressureForce outward(ball.mesh, 0, {.pressure = 10});
  PressureForce inward(inside_out(ball.mesh), 0, {.pressure = 10});
  CHECK(outward.rest_volume() == doctest::Approx(inward.rest_volume()).epsilon(1e-14));
  const Positions f = ball.forces(outward, ball.mesh.vertices);
  CHECK((f - ball.forces(inward, ball.mesh.vertices)).cwiseAbs().maxCoeff() < 1e-14);

  PressureForce later(ball.mesh, 3, {.pressure = 10});
  Positions x = Positions::Zero(ball.mesh.vertex_count() + 3, 3);
  x.bottomRows(ball.mesh.vertex_count()) = ball.mesh.vertices;
  Positions g = Positions::Zero(x.rows(), 3);
  const std::vector<Real> masses(static_cast<std::size_t>(x.rows()), 1);
  later.add_to(g, {x, x, masses, 0, 0}, 1);
  CHECK(g.topRows(3).norm() == 0);
  CHECK((g.bottomRows(ball.mesh.vertex_count()) - f).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(later.vertex_out_of_range(ball.mesh.vertex_count()).has_value());
  CHECK(!later.vertex_out_of_range(ball.mesh.vertex_count() + 3));
}

TEST_CASE("a spherical membrane grows until Laplace's law holds: p = 2 T/r") {
  // Triangle strain with all stretches s has the tension T = k (s − 1)/s: energy k/2 · 2 (s − 1)² of the rest area.
  const Real k = 1000;
  const Real p = 400;
  Simulation simulation(converged(1e-7, 0.1));
  const Mesh mesh = sphere({.subdivisions = 2, .radius = 0.5});
  const BodyId ball = simulation.add_body(mesh, Mass::area_density(200));
  simulation.add(ball, TriangleStrain{.stiffness = k});
  auto force = std::make_unique<PressureForce>(mesh, 0, Pressure{.pressure = p});
  const PressureForce& pressure = *force;
  const Real rest_volume = force->rest_volume();
  simulation.add_force(std::move(force));
  for (int i = 0; i < 80; ++i) {
    simulation.step();
    simulation.set_state(simulation.state().positions, Positions::Zero(mesh.vertex_count(), 3));
  }
  // 2 k (s − 1)/s = p s R, R = 0.5: the smaller root of p R s² − 2 k s + 2 k.
  const Real a = p * 0.5;
  const Real s = (2 * k - std::sqrt(4 * k * k - 8 * a * k)) / (2 * a);
  const Real grown = std::cbrt(pressure.volume(simulation.state().positions) / rest_volume);
  CHECK(s > 1.1);
  CHECK(grown == doctest::Approx(s).epsilon(2e-3));
  CHECK(simulation.warnings().empty());
}

TEST_CASE("the warning's limit is the gas spring's own") {
  // A box of one cell whose lids alone move: mass m each lid, area A, height L; (−dp/dV) A² (2/m) = ω².
  const Mesh box = bar({.cells = {1, 1, 1}, .size = {1, 1, 0.5}, .cut = TetrahedronCut::five});
  const auto warned = [&](Real pressure, Real time_step, Real mass) {
    Simulation simulation({.time_step = time_step});
    simulation.add_body(box, Mass::per_vertex(mass));
    simulation.add(Pressure{.model = PressureModel::gas, .pressure = pressure});
    simulation.step();
    return !simulation.warnings().empty();
  };
  CHECK(!warned(100, 1e-3, 1));
  CHECK(warned(100, 1, 1));
  CHECK(warned(100, 1e-2, 1) == warned(400, 5e-3, 1));
  CHECK(!warned(100, 1, 1e6));

  // What the limit promises: without any skin the volume beats about its mean below it, and well past it grows.
  Real limit = 1;
  while (warned(100, limit, 1)) limit *= 0.97;
  const auto grows = [&](Real time_step) {
    Simulation simulation({.time_step = time_step});
    Positions start = box.vertices;
    start.col(2) *= 0.999;
    const BodyId body = simulation.add_body(box, Mass::per_vertex(1), {.start = start});
    simulation.add(body, TetrahedronStrain{.stiffness = 1});
    simulation.add(Pressure{.model = PressureModel::gas, .pressure = 1e-3, .ambient = 99.999});
    return !error_of([&] { advance(simulation, 200); }, ErrorKind::diverged).empty() ||
           simulation.state().velocities.cwiseAbs().maxCoeff() > 0.1;
  };
  CHECK(!grows(0.9 * limit));
  CHECK(grows(3 * limit));
}

TEST_CASE("what a pressure refuses") {
  constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  const Mesh tube = cylinder({.segments = 6});
  CHECK(
      contains(refusal(tube), "pressure: the surface is open: it has 12 boundary edges, the first from vertex 0 to 1"));
  CHECK(contains(refusal(grid({})), "40 boundary edges"));
  CHECK(contains(refusal(chain({})), "pressure: there are no triangles"));
  Mesh turned = sphere({.subdivisions = 0});
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  CHECK(contains(refusal(turned), "the triangles at 3 edges do not agree on their outside"));
  Mesh flat = sphere({.subdivisions = 1});
  flat.vertices.col(2).setZero();
  CHECK(contains(refusal(flat), "encloses no volume"));
  const Mesh ball = sphere({.subdivisions = 0});
  CHECK(contains(refusal(ball, {.pressure = nan}), "pressure: pressure: nan"));
  CHECK(contains(refusal(ball, {.ambient = -1}), "pressure: ambient: -1"));
  CHECK(contains(refusal(ball, {.model = PressureModel::gas, .pressure = -5, .ambient = 5}), "give a sum above 0"));
  CHECK(contains(refusal(ball, {.on = {0, 12}}), "vertex 12 is out of range; the body has vertices 0 to 11"));
  CHECK(contains(refusal(ball, {.on = {0, 11, 5}}), "3 boundary edges"));
}

TEST_CASE("only the selected, closed part of a body holds the pressure") {
  const Mesh both = joined(sphere({.subdivisions = 0}), grid({.columns = 2, .rows = 2}));
  Pressure options;
  CHECK(contains(refusal(both, options), "4 boundary edges"));
  std::vector<Index> ball(12);
  for (Index v = 0; v < 12; ++v) ball[static_cast<std::size_t>(v)] = v;
  options.on = ball;
  CHECK(refusal(both, options).empty());
}

}  // namespace test_pressure
