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

TEST_CASE("relative wind: c A/3 (n·(u − v)) n on every vertex, with the velocity at the end of the step") {
  Random random;
  OneTriangle triangle;
  const Mat3 R = random.rotation();
  triangle.positions = 1.5 * triangle.positions * R.transpose();
  triangle.velocities = random.positions(3, 1);
  const Vec3 n = R.col(2);
  const Vec3 air(3, -2, 5);
  for (const WindArea which : {WindArea::current, WindArea::rest}) {
    const Real area = which == WindArea::current ? 0.5 * 1.5 * 1.5 : 0.5;
    Simulation simulation({.time_step = h, .iterations = 200});
    const BodyId body = simulation.add_body(triangle.mesh, Mass::each(triangle.masses),
                                            {.start = triangle.positions, .velocities = triangle.velocities});
    simulation.add(body, Wind{.velocity = air, .area = which, .drag = 7});
    simulation.step();
    const Positions& v = simulation.state().velocities;
    for (int i = 0; i < 3; ++i) {
      const Vec3 force = 7 * area / 3 * n.dot(air - row(v, i)) * n;
      const Vec3 momentum = triangle.masses[static_cast<std::size_t>(i)] * (row(v, i) - row(triangle.velocities, i));
      CHECK((momentum - h * force).norm() < 1e-12);
    }
    CHECK(simulation.evaluate().elastic == 0);
    CHECK(simulation.evaluate().outside > 0);
  }
}

TEST_CASE("wind does not blow where there is nothing to blow on") {
  OneTriangle triangle;
  const auto velocities = [&](const Wind& options) {
    Simulation simulation({.iterations = 3});
    const BodyId body = simulation.add_body(triangle.mesh, Mass::each(triangle.masses),
                                            {.start = triangle.positions, .velocities = triangle.velocities});
    simulation.add(body, options);
    simulation.step();
    return Positions(simulation.state().velocities);
  };
  CHECK(velocities({.velocity = {4, 5, 0}}).norm() == 0);
  CHECK(velocities({.velocity = {0, 0, 5}, .drag = 0}).norm() == 0);
  triangle.velocities.col(2).setConstant(5);
  CHECK((velocities({.velocity = {0, 0, 5}}) - triangle.velocities).norm() < 1e-12);
  triangle.velocities.setZero();
  triangle.positions.setZero();
  for (const WindModel model : {WindModel::thesis, WindModel::relative}) {
    CHECK(velocities({.velocity = {1, 2, 3}, .model = model}) == Positions::Zero(3, 3));
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
        CHECK(v(1, 2) == doctest::Approx(5 * (1 - std::pow(1 + drag / 0.2 * time_step, -step))).epsilon(1e-9));
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
  simulation.add(Wind{.velocity = {0, 5, 0}, .drag = 10});  // one along the sheet makes it flutter
  for (int step = 0; step < 120; ++step) {
    simulation.step();
    CHECK(simulation.state().velocities.col(1).maxCoeff() <= 5 * (1 + 1e-6));
  }
  CHECK((simulation.state().velocities.rowwise() - Eigen::RowVector3d(0, 5, 0)).cwiseAbs().maxCoeff() < 1e-5);
}

TEST_CASE("gusts vary the wind by their share and no more, and come again as one knows them") {
  const OneTriangle triangle;
  const auto strength = [&](const Wind& options, Real time) { return triangle.forces(options, time)(0, 2); };
  const Wind steady{.velocity = {0, 0, 2}, .model = WindModel::thesis};
  const Wind gusty{.velocity = {0, 0, 2}, .model = WindModel::thesis, .gust_strength = 0.3, .gust_period = 1.7};
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

TEST_CASE("a sheet that falls in still air ends at ρ g/c, at any time step") {
  constexpr Real density = 0.2;
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const Real time_step : {1.0 / 600, 1.0 / 60, 1.0 / 30}) {
      for (const Real drag : {0.1, 1.0, 10.0, 100.0}) {
        Simulation simulation({.time_step = time_step, .integrator = integrator, .iterations = 2, .threads = 1});
        const BodyId sheet = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::area_density(density));
        simulation.add(sheet, EdgeSpring{.stiffness = 1e3});
        simulation.add(sheet, Wind{.velocity = {0, 0, 0}, .drag = drag});
        const Positions& rest = simulation.body(sheet).mesh.vertices;
        const Vec3 normal = (row(rest, 1) - row(rest, 0)).cross(row(rest, 3) - row(rest, 0)).normalized();
        REQUIRE(normal.norm() == doctest::Approx(1));
        simulation.add(Gravity{Vec3(-9.81 * normal)});
        advance(simulation, static_cast<int>(10 * density / drag / time_step) + 30);
        const Real speed = -(simulation.state().velocities * normal).mean();
        CAPTURE(time_step);
        CAPTURE(drag);
        CHECK(speed == doctest::Approx(density * 9.81 / drag).epsilon(1e-3));
      }
    }
  }
}

TEST_CASE("a plate hangs in the wind at tan θ = c U/(ρ g)") {
  constexpr Real density = 0.2;
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const auto& [drag, speed] : {std::pair(1.0, 1.0), std::pair(0.5, 4.0)}) {
      Simulation simulation({.time_step = 1.0 / 30, .integrator = integrator, .iterations = 30, .damping = 2});
      const BodyId plate =
          simulation.add_body(grid({.columns = 2, .rows = 5, .size = {0.25, 1}}), Mass::area_density(density));
      const Mesh& mesh = simulation.body(plate).mesh;
      const Real top = mesh.vertices.col(2).maxCoeff();
      Selection pins{std::vector<Index>()};
      for (Index i = 0; i < mesh.vertex_count(); ++i) {
        if (mesh.vertices(i, 2) == top) pins.vertices.push_back(i);
      }
      REQUIRE(pins.vertices.size() == 2);
      simulation.add(plate, EdgeSpring{.stiffness = 3e3});
      simulation.add(plate, HingeBending{.stiffness = 1});  // limp, it would flutter
      simulation.add(plate, Position{.on = pins});
      simulation.add(plate, Wind{.velocity = {0, speed, 0}, .area = WindArea::rest, .drag = drag});
      add_gravity(simulation);
      advance(simulation, 600);
      const Positions& x = simulation.state().positions;
      Vec3 lowest = row(x, 0);
      for (Index i = 0; i < x.rows(); ++i) {
        if (x(i, 2) < lowest[2]) lowest = row(x, i);
      }
      const Real degrees = std::atan2(std::abs(lowest[1]), top - lowest[2]) * 180 / std::numbers::pi;
      const Real expected = std::atan(drag * speed / (density * 9.81)) * 180 / std::numbers::pi;
      CHECK(std::abs(degrees - expected) < 0.01);
      CHECK(simulation.state().velocities.cwiseAbs().maxCoeff() < 1e-6);
    }
  }
}

TEST_CASE("another velocity of the air costs nothing, another drag a numeric factorization") {
  Simulation simulation({.iterations = 3});
  const BodyId sheet = simulation.add_body(grid({.columns = 5, .rows = 5}), Mass::area_density(0.2));
  simulation.add(sheet, EdgeSpring{.stiffness = 100});
  const ForceId wind = simulation.add(sheet, Wind{.velocity = {0, 1, 0}});
  advance(simulation, 3);
  simulation.replace(wind, Wind{.velocity = {0, 9, 0}, .gust_strength = 0.2});
  StepReport report = simulation.step();
  CHECK(report.set_up.numeric == 0);
  CHECK(report.set_up.layout == 0);
  simulation.replace(wind, Wind{.velocity = {0, 9, 0}, .drag = 2});
  report = simulation.step();
  CHECK(report.set_up.numeric > 0);
  CHECK(report.set_up.layout == 0);  // so the pattern is not analyzed again
}

TEST_CASE("a sheet in a gale of 1e6 m/s stays finite, at any time step of either integrator") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const WindArea area : {WindArea::current, WindArea::rest}) {
      for (const Real time_step : {1.0 / 600, h, 1.0}) {
        Simulation simulation({.time_step = time_step, .integrator = integrator, .iterations = 5});
        const BodyId curtain = simulation.add_body(grid({.columns = 8, .rows = 8}), Mass::area_density(0.2));
        simulation.add(curtain, EdgeSpring{.stiffness = 5e4});
        simulation.add(curtain, Position{.on = {56, 63}});
        simulation.add(Wind{.velocity = {0, 1e6, 3e5}, .area = area});
        advance(simulation, 100);
        CHECK(simulation.state().positions.cwiseAbs().maxCoeff() < 1e6 * 100 * time_step);
      }
    }
  }
}

TEST_CASE("in the wind as well the same bits for any number of threads, and after a state that is restored") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    const auto make = [&](Index threads) {
      Simulation simulation({.integrator = integrator, .substeps = 2, .iterations = 4, .threads = threads});
      const BodyId sheet = simulation.add_body(grid({.columns = 50, .rows = 50}), Mass::area_density(0.2));
      simulation.add(sheet, EdgeSpring{.stiffness = 1e3});
      simulation.add(sheet, TriangleStrain{.stiffness = 100});
      simulation.add(sheet, Position{.on = {2450, 2499}});
      simulation.add(sheet, Wind{.velocity = {2, 40, 1}, .drag = 3, .gust_strength = 0.5});
      add_gravity(simulation);
      return simulation;
    };
    Simulation one = make(1);
    advance(one, 3);
    const State middle = one.state();
    advance(one, 3);
    for (const Index threads : {2, 3, 8}) {
      Simulation more = make(threads);
      advance(more, 6);
      CHECK(more.state().positions == one.state().positions);
      CHECK(more.state().velocities == one.state().velocities);
    }
    Simulation again = make(1);
    again.restore(middle);
    advance(again, 3);
    CHECK(again.state().positions == one.state().positions);
    CHECK(again.state().velocities == one.state().velocities);
  }
}

TEST_CASE("energy projection counts the drag as work from outside: a kept sheet falls no faster") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    Simulation simulation({.integrator = integrator, .iterations = 10, .energy_projection = 1});
    const BodyId sheet = simulation.add_body(grid({.columns = 5, .rows = 5}), Mass::area_density(0.2));
    simulation.add(sheet, EdgeSpring{.stiffness = 1e3});
    simulation.add(sheet, Wind{.velocity = {0, 0, 0}, .drag = 2});
    add_gravity(simulation, {0, 9.81, 0});
    advance(simulation, 200);
    CHECK(simulation.state().velocities.col(1).mean() == doctest::Approx(0.2 * 9.81 / 2).epsilon(1e-3));
    CHECK(simulation.evaluate().elastic < 1e-9);
    CHECK(simulation.evaluate().outside > 1e-3);
  }
}

TEST_CASE("the system matrix follows areas that have grown by half, and no others") {
  OneTriangle triangle;
  const std::unique_ptr<Force> wind = force_on(triangle.mesh, Wind{});
  REQUIRE(wind->groups().size() == 1);
  ConstraintGroup& group = *wind->groups()[0];
  const auto measure_at = [&](Real growth) {
    const Positions x = std::sqrt(growth) * triangle.positions;
    group.begin_step({x, triangle.velocities, triangle.masses, 0, 0}, h);
    return group.rest_measure()[1] / (0.5 / 3);
  };
  CHECK(measure_at(1.4) == doctest::Approx(1));
  const std::uint64_t before = group.revision();
  CHECK(measure_at(0.1) == doctest::Approx(1));
  CHECK(group.revision() == before);
  for (const Real growth : {1.6, 2.2, 5.0, 1e4}) {
    const Real measure = measure_at(growth);
    CHECK(growth <= 1.5 * measure * (1 + 1e-12));
    CHECK(growth > measure);
  }
  CHECK(group.revision() > before);
  CHECK(force_on(triangle.mesh, Wind{.model = WindModel::thesis})->groups().empty());
  CHECK(force_on(triangle.mesh, Wind{.drag = 0})->groups().empty());
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
