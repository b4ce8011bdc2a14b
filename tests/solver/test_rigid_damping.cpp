// Damping: what it takes, and what it leaves alone.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "../simulation/run.h"
#include "motions.h"
#include "pliant/solver/integration/rigid_damping.h"

namespace test_rigid_damping {

using namespace pliant;
using namespace pliant_tests;

TEST_CASE("damping makes the amplitude decay at its rate, besides what the integrator takes") {
  constexpr Real rate = 0.5;
  constexpr Real omega = 2 * std::numbers::pi;
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const Real h : {0.002, 0.01}) {
      CAPTURE(h);
      // Largest stretch in the period around a time, with and without damping.
      const auto swing_at = [&](Real damping, Real time) {
        Simulation simulation = two_masses(oscillator_settings(integrator, h, damping), omega);
        Real largest = 0;
        for (Real t = 0; t < time + 0.5; t += h) {
          simulation.step();
          if (t > time - 0.5) largest = std::max(largest, std::abs(stretch(simulation)));
        }
        return largest;
      };
      const Real damped = std::log(swing_at(rate, 1) / swing_at(rate, 4)) / 3;
      const Real own = std::log(swing_at(0, 1) / swing_at(0, 4)) / 3;
      CHECK(damped - own == doctest::Approx(rate).epsilon(0.01));
    }
  }
}

TEST_CASE("damping leaves the momenta of free bodies as they are") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    SolverSettings settings = oscillator_settings(integrator, 1.0 / 60, 20);
    settings.iterations = 200;
    Simulation damped = flying_bodies(settings);
    const Momenta begin = momenta_of(damped.state());
    for (int i = 0; i < 60; ++i) {
      // The same step without damping, from the same state.
      settings.damping = 0;
      Simulation free = flying_bodies(settings);
      free.restore(damped.state());
      free.step();
      damped.step();
      const Momenta with = momenta_of(damped.state());
      const Momenta without = momenta_of(free.state());
      CHECK((with.linear - begin.linear).norm() < 1e-9 * begin.linear.norm());
      CHECK((with.angular - without.angular).norm() < 1e-9 * begin.angular.norm());
      CHECK((damped.state().positions - free.state().positions).norm() == 0);
      CHECK((damped.state().velocities - free.state().velocities).norm() > 0);
    }
  }
}

TEST_CASE("damping leaves free fall as it is, and brings a shaken body to rest in itself") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    Simulation simulation = flying_bodies(oscillator_settings(integrator, 1.0 / 60, 20));
    Simulation free = flying_bodies(oscillator_settings(integrator, 1.0 / 60));
    for (Simulation* each : {&simulation, &free}) add_gravity(*each);
    advance(simulation, 120);
    advance(free, 120);
    const auto center = [](const Simulation& s) {
      Vec3 sum = Vec3::Zero();
      for (Index i = 0; i < s.state().vertex_count(); ++i) {
        sum += s.state().masses[static_cast<std::size_t>(i)] * row(s.state().positions, i);
      }
      return sum;
    };
    CHECK((center(simulation) - center(free)).norm() < 1e-9 * center(free).norm());
    // What is left to damp once more is what vibrates.
    const auto vibration = [](const Simulation& s) {
      std::vector<Index> torus_vertices(72);
      for (Index i = 0; i < 72; ++i) torus_vertices[static_cast<std::size_t>(i)] = i;
      const std::vector<char> none_pinned(s.state().masses.size(), 0);
      Positions rigid = s.state().velocities;
      ThreadPool threads(1);
      damp_vibrations({torus_vertices, {0, 72}}, none_pinned, s.state().positions, s.state().masses, 0, rigid, threads);
      return (s.state().velocities - rigid).topRows(72).norm();
    };
    CHECK(vibration(simulation) < 0.5 * vibration(free));
  }
}

TEST_CASE("rigid motions are not damped, whatever the shape") {
  const auto check = [](const Positions& x, const std::vector<Index>& vertices, const Vec3& omega) {
    const std::vector<char> none_pinned(static_cast<std::size_t>(x.rows()), 0);
    const std::vector<Real> masses(static_cast<std::size_t>(x.rows()), 0.3);
    Positions v(x.rows(), 3);
    for (Index i = 0; i < static_cast<Index>(x.rows()); ++i)
      v.row(i) = (Vec3(3, 2, 1) + omega.cross(row(x, i))).transpose();
    const Positions before = v;
    ThreadPool threads(1);
    damp_vibrations({vertices, {0, vertices.size()}}, none_pinned, x, masses, 0, v, threads);
    CHECK(largest_difference(v, before) < 1e-12 * (1 + before.cwiseAbs().maxCoeff()));
  };
  Positions plane(4, 3), line(3, 3), point(1, 3), far(4, 3);
  plane << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 2, 0;
  line << 0, 0, 0, 1, 1, 1, 3, 3, 3;
  point << 5, 6, 7;
  far = plane.array() + 1e5;
  check(plane, {0, 1, 2, 3}, {1, 2, 3});
  check(line, {0, 1, 2}, {1, -1, 0.5});
  check(point, {0}, {0, 0, 0});
  check(far, {0, 1, 2, 3}, {1e-3, 2e-3, 3e-3});
}

TEST_CASE("pinned vertices keep their velocities, and count in the motion that is not damped") {
  Positions x(2, 3), v(2, 3);
  x << 0, 0, 0, 1, 0, 0;
  v << 0, 0, 0, 2, 4, 0;  // it goes away from the pinned one, and round it
  ThreadPool threads(2);
  damp_vibrations({{0, 1}, {0, 2}}, std::vector<char>{1, 0}, x, std::vector<Real>{1, 1}, 0, v, threads);
  CHECK(row(v, 0) == Vec3(0, 0, 0));
  CHECK((row(v, 1) - Vec3(1, 4, 0)).norm() < 1e-14);
}

}  // namespace test_rigid_damping
