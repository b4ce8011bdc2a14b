// Implicit Euler, BDF2 and substeps on motions that are known in closed form.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "../simulation/everything.h"
#include "../simulation/run.h"
#include "motions.h"
#include "pliant/constraints/builtin.h"
#include "pliant/core/error.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/shapes.h"
#include "pliant/simulation/transaction.h"
#include "pliant/solver/integration/integrator.h"

namespace test_integrators {

using namespace pliant;
using namespace pliant_tests;

namespace {

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
  // The phase of λ is close to hω, so a period has close to 2π/hω steps.
  const Real bdf2 = 1 - std::pow(amplification(Integrator::bdf2, 0.3), 2 * std::numbers::pi / 0.3);
  CHECK(loss_a_period(Integrator::bdf2, 0.3) == doctest::Approx(bdf2).epsilon(0.05));
  for (const Real h_omega : {0.1, 0.3, 1.0, 10.0}) {
    CHECK(amplification(Integrator::implicit_euler, h_omega) == doctest::Approx(1 / std::hypot(1, h_omega)));
    // λ of (3λ² − 4λ + 1)² = −4 (hω)² λ⁴, as the recurrence itself has it: from any start all else dies out.
    Real q[4] = {1, 0.9, 0.7, 0.6};
    Real logarithm = 0;
    for (int i = 0; i < 4000; ++i) {
      // BDF2 of x' = v, v' = −ω² x with v eliminated: 9x − 24x₁ + 22x₂ − 8x₃ + x₄ = −4 (hω)² x
      const Real next = (24 * q[3] - 22 * q[2] + 8 * q[1] - q[0]) / (9 + 4 * h_omega * h_omega);
      for (int k = 0; k < 3; ++k) q[k] = q[k + 1];
      q[3] = next;
      const Real size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      for (Real& x : q) x /= size;
      logarithm += std::log(size);
    }
    CHECK(std::exp(logarithm / 4000) == doctest::Approx(amplification(Integrator::bdf2, h_omega)).epsilon(2e-3));
  }
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

TEST_CASE("free fall is exact in BDF2 but for what its first step, of implicit Euler, has fallen too far") {
  constexpr Real h = 0.05;
  Simulation simulation(oscillator_settings(Integrator::bdf2, h));
  simulation.add_body(chain({.links = 1}), Mass::per_vertex(2));
  add_gravity(simulation);
  const Real begin = simulation.state().positions(0, 2);
  advance(simulation, 100);
  const Real t = 100 * h;
  CHECK(simulation.state().velocities(0, 2) == doctest::Approx(-9.81 * t).epsilon(1e-12));
  const Real fallen = begin - simulation.state().positions(0, 2);
  CHECK(fallen - 9.81 * t * t / 2 == doctest::Approx(9.81 * h * h / 2).epsilon(0.01));
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
    Simulation small_steps = two_masses(oscillator_settings(Integrator::bdf2, 0.05), 1);
    small_steps.set_state(simulation.state().positions, simulation.state().velocities);
    advance(small_steps, 2);
    simulation.step();
    CHECK(largest_difference(simulation.state().positions, small_steps.state().positions) < 1e-15);
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
  broken.previous_time_step = -1;
  CHECK_THROWS_WITH_AS(other.restore(broken), doctest::Contains("previous time step"), Error);
  broken.previous_time_step = 0;  // then nobody looks at the rest
  broken.previous_velocities.resize(0, 3);
  CHECK_NOTHROW(other.restore(broken));
  CHECK_NOTHROW(other.step());
  broken.previous_time_step = state.previous_time_step;
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
      simulation.add(Wind{.velocity = {0, 3, 1}});
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

TEST_CASE("the objective after a step is that of its last substep, in either integrator") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    SolverSettings settings = oscillator_settings(integrator, 1.0 / 60);
    settings.substeps = 3;
    settings.iterations = 500;
    Simulation simulation = flying_bodies(settings);
    add_gravity(simulation);
    for (int i = 0; i < 4; ++i) {
      simulation.step();
      REQUIRE(simulation.objective_history().size() <= 500);
      CHECK(simulation.evaluate().residual < 1e-6);  // converged: of another prediction it would not be
      CHECK(simulation.evaluate().objective() <= simulation.objective_history().front());
    }
  }
}

TEST_CASE("a step that is given up in a late substep leaves the state as it was, history included") {
  SolverSettings settings = oscillator_settings(Integrator::bdf2, 1.0 / 60, 1);
  settings.substeps = 4;
  Simulation simulation = flying_bodies(settings);
  advance(simulation, 3);
  const State before = simulation.state();
  int asked = 0;
  simulation.set_stop([&] { return ++asked > 50; });
  CHECK_THROWS_AS(simulation.step(), Error);
  simulation.set_stop({});
  CHECK(asked == 51);
  CHECK(simulation.state().positions == before.positions);
  CHECK(simulation.state().previous_positions == before.previous_positions);
  CHECK(simulation.state().previous_velocities == before.previous_velocities);
  CHECK(simulation.state().time == before.time);
  Simulation other = flying_bodies(settings);
  other.restore(before);
  advance(other, 2);
  advance(simulation, 2);
  CHECK(largest_difference(simulation.state().positions, other.state().positions) == 0);
}

TEST_CASE("the bits are the same on any number of threads, with BDF2, substeps, damping and energy projection") {
  const auto run = [](Index threads) {
    Simulation simulation({.integrator = Integrator::bdf2,
                           .substeps = 2,
                           .iterations = 4,
                           .damping = 2,
                           .energy_projection = 0.5,
                           .threads = threads});
    add_everything_solids(simulation, 48);
    add_gravity(simulation);
    advance(simulation, 5);
    CHECK(simulation.thread_count() == threads);
    return simulation.state().positions;
  };
  const Positions one = run(1);
  CHECK(largest_difference(one, run(2)) == 0);
  CHECK(largest_difference(one, run(3)) == 0);
}

TEST_CASE("the bits are the same on any number of threads where one body is larger than a share of a loop") {
  const auto run = [](Index threads) {
    Simulation simulation({.integrator = Integrator::bdf2,
                           .iterations = 3,
                           .damping = 2,
                           .energy_projection = 0.5,
                           .start = Start::adaptive,
                           .threads = threads});
    const BodyId body = simulation.add_body(grid({.columns = 110, .rows = 100}), Mass::total(1));
    simulation.add(body, EdgeSpring{.stiffness = 50});
    add_gravity(simulation);
    Positions velocities = simulation.state().velocities;
    for (Index i = 0; i < simulation.state().vertex_count(); ++i) velocities(i, 2) = std::sin(0.01 * i) + 0.3 * (i % 7);
    simulation.set_state(Positions(simulation.state().positions), velocities);
    advance(simulation, 4);
    CHECK(simulation.thread_count() == threads);
    return simulation.state().positions;
  };
  const Positions one = run(1);
  CHECK(largest_difference(one, run(2)) == 0);
  CHECK(largest_difference(one, run(5)) == 0);
}

TEST_CASE("what is undone comes back with its history") {
  const SolverSettings settings = oscillator_settings(Integrator::bdf2, 0.05);
  Simulation simulation = two_masses(settings, 3);
  advance(simulation, 4);
  const State before = simulation.state();
  {
    const Transaction transaction(simulation);
    simulation.set_state(before.positions, Positions::Zero(2, 3));
    CHECK(simulation.state().previous_time_step == 0);
  }
  CHECK(simulation.state().previous_time_step == 0.05);
  simulation.step();
  Simulation other = two_masses(settings, 3);
  advance(other, 5);
  CHECK(largest_difference(simulation.state().positions, other.state().positions) == 0);
}

TEST_CASE("an explicit spring and BDF2 refuse each other") {
  const MouseSpring spring{.vertices = {0}};
  Simulation simulation = two_masses(oscillator_settings(Integrator::bdf2, 0.01), 1);
  CHECK_THROWS_WITH_AS(simulation.add(BodyId{0}, spring),
                       doctest::Contains("mouse_spring: an explicit spring gains energy"), Error);
  CHECK(simulation.forces().empty());
  add_gravity(simulation);
  CHECK_THROWS_AS(simulation.replace(simulation.forces().begin()->first, BodyId{0}, spring), Error);

  Simulation euler = two_masses(oscillator_settings(Integrator::implicit_euler, 0.01), 1);
  euler.add(BodyId{0}, spring);
  SolverSettings settings = euler.settings();
  settings.integrator = Integrator::bdf2;
  CHECK_THROWS_WITH_AS(euler.set_settings(settings), doctest::Contains("use a drag"), Error);
  CHECK(euler.settings().integrator == Integrator::implicit_euler);
  CHECK_NOTHROW(euler.step());
}

}  // namespace test_integrators
