#include <cmath>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "../simulation/run.h"
#include "force_on.h"
#include "pliant/constraints/builtin.h"
#include "pliant/forces/wind.h"
#include "pliant/mesh/shapes.h"

namespace test_wind {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real h = 1.0 / 60;

/// One triangle of area 1/2 in the plane z = 0 at rest, and its state.
struct OneTriangle {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  Positions positions = mesh.vertices;
  Positions velocities = Positions::Zero(3, 3);
  std::vector<Real> masses = {1, 2, 4};

  Positions forces(const Wind& options, Real time = 0, Real time_step = h) const {
    Positions f = Positions::Zero(3, 3);
    force_on(mesh, options)->add_to(f, {positions, velocities, masses, 0, time}, time_step);
    return f;
  }
};

/// Each vertex' share, (1 − e⁻ˣ)/x of it: the exact decay.
Real damped(Real share_of_area, Real drag, Real mass, Real time_step = h) {
  const Real x = time_step * drag * share_of_area / mass;
  return (1 - std::exp(-x)) / x;
}

}  // namespace

TEST_CASE("thesis wind: A (n·d) n, a third to each vertex") {
  OneTriangle triangle;
  const Wind options{.velocity = {1, 2, 3}, .model = WindModel::thesis};
  for (int i = 0; i < 3; ++i) CHECK((row(triangle.forces(options), i) - Vec3(0, 0, 0.5)).norm() < 1e-15);
  triangle.velocities = Positions::Constant(3, 3, 5);  // it has no drag
  for (int i = 0; i < 3; ++i) CHECK((row(triangle.forces(options), i) - Vec3(0, 0, 0.5)).norm() < 1e-15);
  triangle.positions *= 2;
  CHECK(row(triangle.forces(options), 0)[2] == doctest::Approx(2).epsilon(1e-14));
  Wind rest = options;
  rest.area = WindArea::rest;
  CHECK(row(triangle.forces(rest), 0)[2] == doctest::Approx(0.5).epsilon(1e-14));
}

TEST_CASE("relative wind: c A (n·(u − v)) n on every vertex, times (1 − exp(−x))/x") {
  Random random;
  OneTriangle triangle;
  const Mat3 R = random.rotation();
  triangle.positions = 1.5 * triangle.positions * R.transpose();
  triangle.velocities = random.positions(3, 1);
  const Vec3 n = R.col(2);
  const Vec3 v = triangle.velocities.colwise().mean().transpose();
  for (const WindArea which : {WindArea::current, WindArea::rest}) {
    const Real area = which == WindArea::current ? 0.5 * 1.5 * 1.5 : 0.5;
    const Wind options{.velocity = {3, -2, 5}, .area = which, .drag = 7};
    const Positions f = triangle.forces(options);
    for (int i = 0; i < 3; ++i) {
      const Real scale = damped(area / 3, 7, triangle.masses[static_cast<std::size_t>(i)]);
      const Vec3 expected = scale * 7 * area / 3 * n.dot(options.velocity - v) * n;
      CHECK((row(f, i) - expected).norm() < 1e-13);
    }
  }
}

TEST_CASE("wind does not blow where there is nothing to blow on") {
  OneTriangle triangle;
  CHECK(triangle.forces({.velocity = {4, 5, 0}}).norm() == 0);
  CHECK(triangle.forces({.velocity = {0, 0, 5}, .drag = 0}).norm() == 0);
  triangle.velocities.col(2).setConstant(5);
  CHECK(triangle.forces({.velocity = {0, 0, 5}}).norm() == 0);
  triangle.positions.setZero();
  for (const WindModel model : {WindModel::thesis, WindModel::relative}) {
    CHECK(triangle.forces({.velocity = {1, 2, 3}, .model = model}) == Positions::Zero(3, 3));
  }
}

TEST_CASE("a free triangle takes on the wind's normal velocity without overshooting, however strong the drag") {
  for (const Real drag : {0.1, 10.0, 1e3, 1e9}) {
    for (const Real time_step : {1e-3, h, 8.0}) {
      Simulation simulation({.time_step = time_step, .iterations = 1});
      simulation.add_body(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), Mass::area_density(0.2));
      simulation.add(Wind{.velocity = {3, 0, 5}, .drag = drag});
      Real last = 0;
      for (int step = 1; step <= 50; ++step) {
        simulation.step();
        const Positions& v = simulation.state().velocities;
        CHECK(v.leftCols<2>().cwiseAbs().maxCoeff() < 1e-9);
        CHECK(v.col(2).maxCoeff() <= 5 * (1 + 1e-12));
        CHECK(v.col(2).minCoeff() >= last * (1 - 1e-12));
        CHECK(v(1, 2) == doctest::Approx(5 * (1 - std::exp(-drag / 0.2 * time_step * step))).epsilon(1e-9));
        last = v.col(2).minCoeff();
      }
    }
  }
}

TEST_CASE("so does a sheet, whose border has less drag a vertex and is drawn along") {
  Simulation simulation({.iterations = 10});
  const BodyId sheet = simulation.add_body(grid({.columns = 6, .rows = 6}), Mass::area_density(0.2));
  simulation.add(sheet, TriangleStrain{.stiffness = 100});
  simulation.add(sheet, Bending{.stiffness = 0.01});
  simulation.add(Wind{.velocity = {3, 5, 0}, .drag = 10});
  for (int step = 0; step < 120; ++step) {
    simulation.step();
    CHECK(simulation.state().velocities.col(1).maxCoeff() <= 5 * (1 + 1e-6));
  }
  CHECK((simulation.state().velocities.rowwise() - Eigen::RowVector3d(0, 5, 0)).cwiseAbs().maxCoeff() < 1e-5);
}

TEST_CASE("gusts vary the wind by their share and no more, and come again as one knows them") {
  const OneTriangle triangle;
  const auto strength = [&](const Wind& options, Real time) { return triangle.forces(options, time)(0, 2); };
  const Wind steady{.velocity = {0, 0, 2}};
  const Wind gusty{.velocity = {0, 0, 2}, .gust_strength = 0.3, .gust_period = 1.7};
  const Real mean = strength(steady, 0);
  CHECK(strength(steady, 12.3) == mean);
  Real least = mean;
  Real most = mean;
  for (int i = 0; i < 5000; ++i) {
    const Real time = 0.01 * i;
    const Real phase = 2 * std::numbers::pi * time / 1.7;
    const Real gust = 0.6 * std::sin(phase) + 0.4 * std::sin(1.618 * phase + 1);
    CHECK(strength(gusty, time) == doctest::Approx(mean * (1 + 0.3 * gust)).epsilon(1e-12));
    least = std::min(least, strength(gusty, time));
    most = std::max(most, strength(gusty, time));
  }
  CHECK(least > 0.7 * mean);
  CHECK(least < 0.72 * mean);
  CHECK(most < 1.3 * mean);
  CHECK(most > 1.28 * mean);
  CHECK(strength(gusty, 3) == strength(gusty, 3));
}

TEST_CASE("thesis wind with W = 1e6 grows without bound: the error names vertex and wind, the state stays whole") {
  for (const Real time_step : {h, 1.0, 8.0}) {
    Simulation simulation({.time_step = time_step, .iterations = 5});
    const BodyId curtain =
        simulation.add_body(grid({.columns = 16, .rows = 16, .size = {1.5, 1.5}}), Mass::per_vertex(1));
    simulation.add(curtain, EdgeSpring{.stiffness = 5e4});
    simulation.add(curtain, Position{.on = {240, 255}, .hold = Hold::soft, .stiffness = 1e7});
    add_gravity(simulation);
    simulation.add(Wind{.velocity = {0, 1e6, 3e5}, .model = WindModel::thesis});
    std::string message;
    State before;
    int steps = 0;
    for (; message.empty() && steps < 30; ++steps) {
      before = simulation.state();
      message = error_of([&] { simulation.step(); }, ErrorKind::diverged);
    }
    CAPTURE(message);
    CHECK(steps < 20);
    CHECK(contains(message, "step " + std::to_string(before.step + 1)));
    CHECK(contains(message, "vertex "));
    CHECK(contains(message, "wind"));
    CHECK(simulation.state().positions == before.positions);
    CHECK(simulation.state().velocities == before.velocities);
    CHECK(simulation.state().step == before.step);
    CHECK(simulation.state().time == before.time);
    CHECK(before.positions.allFinite());
    CHECK(before.velocities.allFinite());
  }
}

TEST_CASE("thesis wind on the rest area, and relative wind, have no such limit") {
  for (const Wind& options : {Wind{.velocity = {0, 1e6, 3e5}, .model = WindModel::thesis, .area = WindArea::rest},
                              Wind{.velocity = {0, 1e6, 3e5}}}) {
    Simulation simulation({.iterations = 5});
    const BodyId curtain = simulation.add_body(grid({.columns = 8, .rows = 8}), Mass::per_vertex(1));
    simulation.add(curtain, EdgeSpring{.stiffness = 5e4});
    simulation.add(curtain, Position{.on = {56, 63}});
    simulation.add(options);
    advance(simulation, 300);
    CHECK(simulation.state().positions.allFinite());
  }
}

TEST_CASE("what a wind refuses") {
  const auto refusal = [](const Wind& options) { return error_of([&] { force_on(OneTriangle().mesh, options); }); };
  CHECK(contains(refusal({.drag = -1}), "wind: drag"));
  CHECK(contains(refusal({.velocity = {0, std::numeric_limits<Real>::quiet_NaN(), 0}}), "wind: velocity"));
  CHECK(contains(refusal({.gust_strength = 1.5}), "wind: gust_strength"));
  CHECK(contains(refusal({.gust_period = 0}), "wind: gust_period"));
  Simulation simulation;
  simulation.add_body(chain({.links = 2}), Mass::total(1));
  CHECK(contains(error_of([&] { simulation.add(Wind{}); }), "no triangles"));
}

}  // namespace test_wind
