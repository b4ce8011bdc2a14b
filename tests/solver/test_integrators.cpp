// Implicit Euler, BDF2, substeps and damping on motions that are known in closed form.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "../simulation/everything.h"
#include "../simulation/run.h"
#include "pliant/constraints/builtin.h"
#include "pliant/core/error.h"
#include "pliant/forces/mouse_spring.h"
#include "pliant/mesh/shapes.h"
#include "pliant/solver/rigid_damping.h"

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real amplitude = 0.01;  // [m]

/// Two masses of 1 kg on a spring of 1 m that is stretched by `amplitude`; k so that ω is as given.
Simulation two_masses(const SolverSettings& settings, Real omega) {
  Simulation simulation(settings);
  Mesh mesh = chain({.links = 1, .direction = {1, 0, 0}});
  BodyOptions options{.start = mesh.vertices};
  options.start(0, 0) -= amplitude / 2;
  options.start(1, 0) += amplitude / 2;
  const BodyId body = simulation.add_body(std::move(mesh), Mass::per_vertex(1), options);
  simulation.add(body, EdgeSpring{.stiffness = omega * omega / 2});
  return simulation;
}

Real stretch(const Simulation& simulation) {
  return (simulation.state().positions.row(1) - simulation.state().positions.row(0)).norm() - 1;
}

SolverSettings oscillator_settings(Integrator integrator, Real h, Real damping = 0) {
  return {.time_step = h,
          .integrator = integrator,
          .iterations = 20,
          .damping = damping,
          .precision = Precision::double_,
          .threads = 1};
}

/// Root mean square of stretch − exact over two periods of `steps` steps each.
Real error_of(Integrator integrator, int steps, Index substeps = 1) {
  constexpr Real omega = 2 * std::numbers::pi;
  SolverSettings settings = oscillator_settings(integrator, 1.0 / steps);
  settings.substeps = substeps;
  Simulation simulation = two_masses(settings, omega);
  Real sum = 0;
  for (int i = 1; i <= 2 * steps; ++i) {
    simulation.step();
    const Real error = stretch(simulation) - amplitude * std::cos(omega * i / steps);
    sum += error * error;
  }
  return std::sqrt(sum / (2 * steps));
}

/// Fits xₙ₊₁ = a xₙ + b xₙ₋₁ behind the start, and returns by what share the amplitude falls in a period.
Real loss_a_period(Integrator integrator, Real h_omega, Index substeps = 1) {
  SolverSettings settings = oscillator_settings(integrator, h_omega);
  settings.substeps = substeps;
  Simulation simulation = two_masses(settings, 1);
  advance(simulation, 5);
  Eigen::MatrixX2d before(100, 2);
  Eigen::VectorXd after(100);
  Real last = stretch(simulation);
  simulation.step();
  Real now = stretch(simulation);
  for (Index n = 0; n < 100; ++n) {
    simulation.step();
    before.row(n) << now, last;
    after[n] = stretch(simulation);
    last = now;
    now = after[n];
  }
  const Eigen::Vector2d ab = (before.transpose() * before).ldlt().solve(before.transpose() * after);
  const Real magnitude = std::sqrt(-ab[1]);
  const Real phase = std::acos(ab[0] / (2 * magnitude));
  return 1 - std::pow(magnitude, 2 * std::numbers::pi / phase);
}

struct Momenta {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
};

Momenta momenta_of(const State& state) {
  Momenta sum;
  for (Index i = 0; i < state.vertex_count(); ++i) {
    const Vec3 p = state.masses[static_cast<std::size_t>(i)] * row(state.velocities, i);
    sum.linear += p;
    sum.angular += row(state.positions, i).cross(p);
  }
  return sum;
}

/// A torus that flies, turns and vibrates, and a chain beside it that does so too.
Simulation flying_bodies(const SolverSettings& settings) {
  Simulation simulation(settings);
  const auto add = [&](Mesh mesh, const Vec3& turning) {
    BodyOptions options{.start = mesh.vertices, .velocities = Positions(mesh.vertices.rows(), 3)};
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      const Vec3 x = row(mesh.vertices, i);
      const Vec3 shake = 0.3 * Vec3(std::sin(9.0 * i), std::cos(7.0 * i), std::sin(5.0 * i + 1));
      options.velocities.row(i) = (Vec3(1, 2, 3) + turning.cross(x) + shake).transpose();
    }
    const BodyId body = simulation.add_body(std::move(mesh), Mass::total(1), options);
    simulation.add(body, EdgeSpring{.stiffness = 200});
  };
  add(torus({.major_segments = 12, .minor_segments = 6}), {1, -2, 3});
  add(chain({.links = 5}), {0, 4, 0});
  return simulation;
}

}  // namespace

TEST_CASE("the error falls with the square of the time step in BDF2, with the time step in implicit Euler") {
  for (const int steps : {100, 200, 400}) {
    CAPTURE(steps);
    const Real second = error_of(Integrator::bdf2, steps) / error_of(Integrator::bdf2, 2 * steps);
    CHECK(second > 3.6);
    CHECK(second < 4.4);
    const Real first = error_of(Integrator::implicit_euler, steps) / error_of(Integrator::implicit_euler, 2 * steps);
    CHECK(first > 1.7);
    CHECK(first < 2.3);
    const Real halved = error_of(Integrator::bdf2, steps, 1) / error_of(Integrator::bdf2, steps, 2);
    CHECK(halved > 3.6);
    CHECK(halved < 4.4);
  }
}

TEST_CASE("the amplitude falls by what each integrator is known to take") {
  const auto implicit_euler = [](Real h_omega) {  // λ² (1 + h²ω²) − 2λ + 1 = 0: λ = 1/(1 ± ihω)
    return 1 - std::pow(1 + h_omega * h_omega, -std::numbers::pi / std::atan(h_omega));
  };
  CHECK(loss_a_period(Integrator::implicit_euler, 0.3) == doctest::Approx(implicit_euler(0.3)).epsilon(1e-6));
  CHECK(loss_a_period(Integrator::implicit_euler, 0.3, 4) == doctest::Approx(implicit_euler(0.075)).epsilon(1e-6));
  CHECK(loss_a_period(Integrator::bdf2, 0.3) < 0.1 * loss_a_period(Integrator::implicit_euler, 0.3));
  CHECK(loss_a_period(Integrator::bdf2, 0.3) > 0.01);
}

TEST_CASE("both integrators are stable on an oscillator however large the step") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const Real h_omega : {0.01, 0.1, 1.0, 3.0, 10.0, 100.0}) {
      CAPTURE(h_omega);
      Simulation simulation = two_masses(oscillator_settings(integrator, h_omega), 1);
      Real largest = 0;
      for (int i = 0; i < 2000; ++i) {
        simulation.step();
        largest = std::max(largest, std::abs(stretch(simulation)));
      }
      CHECK(largest <= amplitude * (1 + 1e-9));
      if (h_omega >= 1) CHECK(std::abs(stretch(simulation)) < 1e-6 * amplitude);
    }
  }
}

TEST_CASE("free fall and flight are exact in BDF2 behind its first step") {
  // q'' = g is solved exactly by BDF2; implicit Euler's first step is off by h² g/2, and nothing is added to that.
  constexpr Real h = 0.05;
  Simulation simulation(oscillator_settings(Integrator::bdf2, h));
  simulation.add_body(chain({.links = 1}), Mass::per_vertex(2));
  add_gravity(simulation);
  const Real begin = simulation.state().positions(0, 2);
  advance(simulation, 100);
  const Real t = 100 * h;
  CHECK(simulation.state().velocities(0, 2) == doctest::Approx(-9.81 * t).epsilon(1e-12));
  const Real fallen = begin - simulation.state().positions(0, 2);
  CHECK(std::abs(fallen - 9.81 * t * t / 2) < 9.81 * h * h);
}

TEST_CASE("BDF2 begins anew with implicit Euler after a changed time step, a new state or a new body") {
  const SolverSettings settings = oscillator_settings(Integrator::bdf2, 0.1);
  const auto implicit_step_from = [&](const Simulation& from, Real h) {
    Simulation euler = two_masses(oscillator_settings(Integrator::implicit_euler, h), 1);
    euler.set_state(from.state().positions, from.state().velocities);
    euler.step();
    return euler.state().positions;
  };
  // The step anew uses the factor of BDF2, whose inertia is 9/4 times as large, so that its iterations converge slowly.
  constexpr Real tolerance = 1e-9;
  Simulation simulation = two_masses(settings, 1);
  const Positions first = implicit_step_from(simulation, 0.1);
  simulation.step();
  CHECK(largest_difference(simulation.state().positions, first) < tolerance);
  const Positions not_euler = implicit_step_from(simulation, 0.1);
  simulation.step();
  CHECK(largest_difference(simulation.state().positions, not_euler) > 1e-6);

  SUBCASE("time step") {
    SolverSettings changed = settings;
    changed.time_step = 0.05;
    simulation.set_settings(changed);
    const Positions expected = implicit_step_from(simulation, 0.05);
    simulation.step();
    CHECK(largest_difference(simulation.state().positions, expected) < tolerance);
  }
  SUBCASE("number of substeps") {
    SolverSettings changed = settings;
    changed.substeps = 2;
    simulation.set_settings(changed);
    simulation.step();
    CHECK(simulation.state().previous_time_step == 0.05);
  }
  SUBCASE("state") {
    simulation.set_state(simulation.state().positions, simulation.state().velocities);
    const Positions expected = implicit_step_from(simulation, 0.1);
    simulation.step();
    CHECK(largest_difference(simulation.state().positions, expected) < tolerance);
  }
  SUBCASE("body") {
    const Positions expected = implicit_step_from(simulation, 0.1);
    simulation.add_body(chain({.links = 1}), Mass::per_vertex(1));
    simulation.step();
    CHECK(largest_difference(simulation.state().positions.topRows(2), expected) < tolerance);
  }
  SUBCASE("integrator") {
    SolverSettings changed = settings;
    changed.integrator = Integrator::implicit_euler;
    simulation.set_settings(changed);
    const Positions expected = implicit_step_from(simulation, 0.1);
    simulation.step();
    CHECK(largest_difference(simulation.state().positions, expected) < tolerance);
    CHECK(simulation.state().previous_time_step == 0);
  }
}

TEST_CASE("a state that is restored goes on with its history, to the bit") {
  SolverSettings settings = oscillator_settings(Integrator::bdf2, 1.0 / 60, 2);
  settings.substeps = 2;
  Simulation simulation = flying_bodies(settings);
  advance(simulation, 5);
  const State state = simulation.state();
  advance(simulation, 5);
  Simulation other = flying_bodies(settings);
  other.restore(state);
  advance(other, 5);
  CHECK(largest_difference(simulation.state().positions, other.state().positions) == 0);
  CHECK(largest_difference(simulation.state().velocities, other.state().velocities) == 0);

  State broken = state;
  broken.previous_positions(0, 0) = std::numeric_limits<Real>::quiet_NaN();
  CHECK_THROWS_WITH_AS(other.restore(broken), doctest::Contains("previous positions[0] is not finite"), Error);
  broken.previous_positions.resize(1, 3);
  CHECK_THROWS_WITH_AS(other.restore(broken), doctest::Contains("previous positions: 1 rows"), Error);
}

TEST_CASE("substeps are steps of the divided length") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    SolverSettings settings{.time_step = 0.02, .integrator = integrator, .iterations = 5, .threads = 1};
    const auto make = [](const SolverSettings& given) {
      Simulation simulation(given);
      add_everything_solids(simulation, 6);
      add_gravity(simulation);
      simulation.add_wind({.velocity = {0, 3, 1}});
      return simulation;
    };
    Simulation small_steps = make(settings);
    settings.time_step = 0.04;
    settings.substeps = 2;
    Simulation substeps = make(settings);
    advance(small_steps, 20);
    for (int i = 0; i < 10; ++i) CHECK(substeps.step().iterations <= 10);
    CHECK(largest_difference(small_steps.state().positions, substeps.state().positions) < 1e-12);
    CHECK(substeps.state().step == 10);
    CHECK(substeps.state().time == doctest::Approx(0.4).epsilon(1e-14));
  }
}

TEST_CASE("hard pins go evenly through the substeps") {
  Simulation simulation({.time_step = 0.1, .substeps = 4, .iterations = 30, .threads = 1});
  const BodyId body = simulation.add_body(chain({.links = 1}), Mass::per_vertex(1));
  const GroupId pins = simulation.add(body, Position{.on = {0, 1}});
  for (int i = 1; i <= 3; ++i) {
    simulation.set_target(pins, 0, Vec3(0.2 * i, 0, 0));
    simulation.step();
    CHECK(simulation.state().positions(0, 0) == 0.2 * i);
    CHECK(simulation.state().velocities(0, 0) == doctest::Approx(2).epsilon(1e-12));
    CHECK(simulation.state().positions(1, 0) == 0);
  }
}

TEST_CASE("a step that diverges in a late substep leaves the state as it was before the first") {
  Simulation simulation({.time_step = 1, .substeps = 3, .iterations = 5, .threads = 1});
  simulation.add_body(chain({.links = 1}), Mass::per_vertex(1));
  class Late final : public Force {
   public:
    std::string_view type() const override { return "late"; }
    void add_to(Positions& forces, const StateView& state, Real) override {
      forces(0, 0) += state.time > 0.5 ? 1e300 : 1;
    }
  };
  simulation.add_force(std::make_unique<Late>());
  const State before = simulation.state();
  CHECK_THROWS_AS(simulation.step(), Error);
  CHECK(simulation.state().positions == before.positions);
  CHECK(simulation.state().velocities == before.velocities);
  CHECK(simulation.state().time == 0);
  CHECK(simulation.state().step == 0);
}

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
  }
}

TEST_CASE("rigid motions are not damped, whatever the shape") {
  const auto check = [](const Positions& x, const std::vector<Index>& vertices, const Vec3& omega) {
    RigidDamping damping;
    damping.set_parts({vertices, {0, vertices.size()}}, std::vector<char>(static_cast<std::size_t>(x.rows()), 0));
    const std::vector<Real> masses(static_cast<std::size_t>(x.rows()), 0.3);
    Positions v(x.rows(), 3);
    for (Index i = 0; i < static_cast<Index>(x.rows()); ++i)
      v.row(i) = (Vec3(3, 2, 1) + omega.cross(row(x, i))).transpose();
    const Positions before = v;
    damping.apply(x, masses, 0, v);
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

TEST_CASE("an explicit spring and BDF2 refuse each other") {
  const auto spring = [] { return std::make_unique<MouseSpring>(0, MouseSpringOptions{}); };
  Simulation simulation = two_masses(oscillator_settings(Integrator::bdf2, 0.01), 1);
  CHECK_THROWS_WITH_AS(simulation.add_force(spring()),
                       doctest::Contains("mouse_spring: an explicit spring gains energy"), Error);
  CHECK(simulation.forces().empty());
  add_gravity(simulation);
  CHECK_THROWS_AS(simulation.replace(simulation.forces().begin()->first, spring()), Error);

  Simulation euler = two_masses(oscillator_settings(Integrator::implicit_euler, 0.01), 1);
  euler.add_force(spring());
  SolverSettings settings = euler.settings();
  settings.integrator = Integrator::bdf2;
  CHECK_THROWS_WITH_AS(euler.set_settings(settings), doctest::Contains("use a drag"), Error);
  CHECK(euler.settings().integrator == Integrator::implicit_euler);
  CHECK_NOTHROW(euler.step());
}
