// Coulomb's law on sheets, against the sums that each integrator makes of a constant acceleration.
#include <doctest/doctest.h>

#include "contact_scenes.h"

namespace test_contact_friction {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real friction = 0.3;
constexpr int steps_of_a_second = 60;

struct Run {
  Real way = 0;    // down the slope [m]
  Real speed = 0;  // at the end [m/s]
};

Run slide(Real degrees, Index vertices, const SolverSettings& settings, int steps, Real speed = 0) {
  const Slope slope(degrees);
  Simulation simulation(settings);
  add_sheet(simulation, {.vertices = vertices, .velocity = speed * slope.down}, slope.normal);
  simulation.add(Gravity{});
  simulation.add(PlaneCollider{.normal = slope.normal, .friction = friction});
  const Vec3 begin = mean(simulation.state().positions);
  for (int i = 0; i < steps; ++i) simulation.step();
  return {slope.down.dot(mean(simulation.state().positions) - begin),
          slope.down.dot(mean(simulation.state().velocities))};
}

/// The way of a point with this acceleration in a second, as the integrator takes it.
Real exact_way(Real acceleration, Integrator integrator, int substeps) {
  const Real h = 1.0 / (steps_of_a_second * substeps);
  Real x = 0, v = 0, x_before = 0, v_before = 0;
  for (int i = 0; i < steps_of_a_second * substeps; ++i) {
    const bool is_bdf2 = integrator == Integrator::bdf2 && i > 0;
    const Real eta = is_bdf2 ? 2 * h / 3 : h;
    const Real a = is_bdf2 ? (4 * x - x_before) / 3 : x;
    const Real b = is_bdf2 ? (4 * v - v_before) / 3 : v;
    x_before = x;
    v_before = v;
    v = b + eta * acceleration;
    x = a + eta * v;
  }
  return x;
}

SolverSettings ten_iterations() {
  return {.iterations = 10, .threads = 1};
}

}  // namespace

TEST_CASE("friction: what slides goes the exact way, to a thousandth") {
  for (const Index vertices : {16, 40}) {
    for (const Real degrees : {17.0, 30.0}) {
      CAPTURE(vertices);
      CAPTURE(degrees);
      const Real acceleration = Slope(degrees).acceleration(friction);
      SolverSettings settings = ten_iterations();
      const Real euler = exact_way(acceleration, Integrator::implicit_euler, 1);
      CHECK(slide(degrees, vertices, settings, 60).way == doctest::Approx(euler).epsilon(1e-3));
      settings.integrator = Integrator::bdf2;
      const Real bdf2 = exact_way(acceleration, Integrator::bdf2, 1);
      CHECK(slide(degrees, vertices, settings, 60).way == doctest::Approx(bdf2).epsilon(1e-3));
    }
  }
}

TEST_CASE("friction: the same in four substeps") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const std::pair<Index, Real>& each : {std::pair<Index, Real>{16, 17}, {16, 30}, {40, 17}}) {
      const Index vertices = each.first;
      const Real degrees = each.second;
      CAPTURE(vertices);
      CAPTURE(degrees);
      SolverSettings settings = ten_iterations();
      settings.substeps = 4;
      settings.integrator = integrator;
      const Real exact = exact_way(Slope(degrees).acceleration(friction), integrator, 4);
      CHECK(slide(degrees, vertices, settings, 60).way == doctest::Approx(exact).epsilon(1e-3));
    }
  }
}

TEST_CASE("friction: what sticks does not creep, in a second and in a minute") {
  SolverSettings settings = ten_iterations();
  CHECK(std::abs(slide(16, 40, settings, 60).way) < 1e-4);
  const Run minute = slide(16, 16, settings, 3600);
  CHECK(std::abs(minute.way) < 1e-4);
  CHECK(std::abs(minute.speed) < 1e-6);
  settings.integrator = Integrator::bdf2;
  CHECK(std::abs(slide(16, 16, settings, 60).way) < 1e-4);
  settings.integrator = Integrator::implicit_euler;
  settings.substeps = 4;
  CHECK(std::abs(slide(16, 16, settings, 60).way) < 1e-4);
  settings.integrator = Integrator::bdf2;
  CHECK(std::abs(slide(16, 16, settings, 60).way) < 1e-4);
}

TEST_CASE("friction: what is thrown along a floor stops where it should") {
  constexpr Real h = 1.0 / 60;
  Real exact = 0;
  for (Real speed = 2 - friction * 9.81 * h; speed > 0; speed -= friction * 9.81 * h) exact += speed * h;
  for (const Index vertices : {16, 40}) {
    const Run run = slide(0, vertices, ten_iterations(), 60, 2);
    CHECK(run.way == doctest::Approx(exact).epsilon(1e-3));
    CHECK(std::abs(run.speed) < 1e-6);
  }
}

TEST_CASE("friction: a conveyor takes along what lies on it") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    SolverSettings settings = ten_iterations();
    settings.integrator = integrator;
    Simulation simulation(settings);
    add_sheet(simulation, {.vertices = 8, .size = 0.2}, Vec3::UnitZ());
    simulation.add(Gravity{});
    SUBCASE("whose surface moves") {
      simulation.add(PlaneCollider{.surface_velocity = {0.5, 0, 0}, .friction = friction});
    }
    SUBCASE("that moves itself") {
      simulation.add(PlaneCollider{.velocity = {0.5, 0, 0}, .friction = friction});
    }
    for (int i = 0; i < 60; ++i) simulation.step();
    const Vec3 before = mean(simulation.state().positions);
    for (int i = 0; i < 60; ++i) simulation.step();
    const Vec3 way = mean(simulation.state().positions) - before;
    CHECK(way.x() == doctest::Approx(0.5).epsilon(1e-6));
    CHECK(std::abs(way.y()) < 1e-6);
  }
}

TEST_CASE("friction: on a turntable a sheet slips at ω² R = μ g, within a hundredth") {
  constexpr Real radius = 0.5;
  const auto drift = [&](Real share_of_limit, Integrator integrator, Index iterations) {
    SolverSettings settings = ten_iterations();
    settings.integrator = integrator;
    settings.iterations = iterations;
    settings.time_step = 1.0 / 240;
    Simulation simulation(settings);
    Real omega = 0.9 * std::sqrt(friction * 9.81 / radius);
    add_sheet(simulation, {.vertices = 4, .size = 0.02, .velocity = {0, omega * radius, 0}, .center = {radius, 0, 0}},
              Vec3::UnitZ());
    simulation.add(Gravity{});
    const ColliderId table = simulation.add(PlaneCollider{.angular_velocity = {0, 0, omega}, .friction = friction});
    const auto distance = [&] { return mean(simulation.state().positions).head<2>().norm(); };
    for (int i = 0; i < 60; ++i) simulation.step();  // comes to rest on the table
    const Real begin = distance();
    const Real end = share_of_limit * std::sqrt(friction * 9.81 / begin);
    for (int i = 0; i < 480; ++i) {  // slowly: what turns it faster is friction as well
      omega += (end - omega) / (480 - i);
      simulation.replace(table, PlaneCollider{.angular_velocity = {0, 0, omega}, .friction = friction});
      simulation.step();
    }
    for (int i = 0; i < 240; ++i) simulation.step();
    return distance() - begin;
  };
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    CAPTURE(static_cast<int>(integrator));
    for (const Index iterations : {10, 20}) {
      CAPTURE(iterations);
      CHECK(std::abs(drift(std::sqrt(0.99), integrator, iterations)) < 1e-5);
      CHECK(drift(std::sqrt(1.01), integrator, iterations) > 1e-2);
    }
  }
}

TEST_CASE("friction: a stiff box in ten iterations slips off a turntable at ω² R = μ g, within a hundredth") {
  const auto drift = [](Real share_of_limit, Integrator integrator) {
    SolverSettings settings = ten_iterations();
    settings.integrator = integrator;
    Simulation simulation(settings);
    Real omega = 0.9 * std::sqrt(friction * 9.81);
    Mesh box = bar({.cells = {3, 3, 3}, .size = {0.2, 0.2, 0.2}});
    box.vertices.rowwise() += Eigen::RowVector3d(0.9, -0.1, 0.02);
    Positions velocities(box.vertex_count(), 3);
    for (Index i = 0; i < box.vertex_count(); ++i) {
      velocities.row(i) = omega * Vec3::UnitZ().cross(row(box.vertices, i)).transpose();
    }
    const BodyId body = simulation.add_body(std::move(box), Mass::density(1000), {.velocities = velocities});
    simulation.add(body, TetrahedronStrain{.stiffness = 1e6});
    simulation.set_contact({.distance = 0.02, .surfaces = false});
    simulation.add(Gravity{});
    const ColliderId table = simulation.add(PlaneCollider{.angular_velocity = {0, 0, omega}, .friction = friction});
    const auto distance = [&] { return mean(simulation.state().positions).head<2>().norm(); };
    for (int i = 0; i < 60; ++i) simulation.step();
    const Real begin = distance();
    const Real end = share_of_limit * std::sqrt(friction * 9.81 / begin);
    for (int i = 0; i < 480; ++i) {
      omega += (end - omega) / (480 - i);
      simulation.replace(table, PlaneCollider{.angular_velocity = {0, 0, omega}, .friction = friction});
      simulation.step();
    }
    for (int i = 0; i < 240; ++i) simulation.step();
    return distance() - begin;
  };
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    CAPTURE(static_cast<int>(integrator));
    CHECK(std::abs(drift(std::sqrt(0.99), integrator)) < 1e-3);
    CHECK(drift(std::sqrt(1.01), integrator) > 0.1);
  }
}

}  // namespace test_contact_friction
