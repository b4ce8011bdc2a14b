// Motions that are known in closed form for implicit Euler.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "../simulation/run.h"
#include "pliant/constraints/builtin.h"
#include "pliant/mesh/shapes.h"

namespace test_dynamics {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real h = 1.0 / 60;
constexpr Real g = 9.81;

struct Oscillation {
  Real period;  // [s]
  Real decay;   // of the amplitude in a period
};

/// Fits xₙ₊₁ = a xₙ + b xₙ₋₁, which every linear oscillation obeys with λ² = a λ + b.
Oscillation oscillation_of(const std::vector<Real>& x) {
  Eigen::MatrixX2d before(x.size() - 2, 2);
  Eigen::VectorXd after(x.size() - 2);
  for (Index n = 0; n < after.size(); ++n) {
    before.row(n) << x[static_cast<std::size_t>(n) + 1], x[static_cast<std::size_t>(n)];
    after[n] = x[static_cast<std::size_t>(n) + 2];
  }
  const Eigen::Vector2d ab = (before.transpose() * before).ldlt().solve(before.transpose() * after);
  const Real magnitude = std::sqrt(-ab[1]);
  const Real period = 2 * std::numbers::pi * h / std::acos(ab[0] / (2 * magnitude));
  return {period, std::pow(magnitude, period / h)};
}

/// A mass of 1 kg on a stiff link of 1 m that swings by a thousandth.
Oscillation pendulum(const SolverSettings& settings, Hold hold, int steps) {
  Simulation simulation(settings);
  Mesh mesh = chain({.links = 1});
  BodyOptions options{.start = mesh.vertices};
  options.start.row(1) << std::sin(1e-3), 0, -std::cos(1e-3);
  const BodyId body = simulation.add_body(std::move(mesh), Mass::per_vertex(1), options);
  simulation.add(body, EdgeSpring{.stiffness = 1e6});
  simulation.add(body, Position{.on = {0}, .hold = hold, .stiffness = 1e6});
  add_gravity(simulation);
  std::vector<Real> x;
  for (int i = 0; i < steps; ++i) {
    simulation.step();
    x.push_back(simulation.state().positions(1, 0) - simulation.state().positions(0, 0));
  }
  return oscillation_of(x);
}

/// A torus of springs, stretched, bent and thrown.
struct FreeBody {
  explicit FreeBody(const SolverSettings& settings) : simulation(settings) {
    Random random;
    const Mesh mesh = torus({.major_segments = 10, .minor_segments = 6});
    BodyOptions options{.start = 1.1 * mesh.vertices + random.positions(mesh.vertex_count(), 0.02),
                        .velocities = random.positions(mesh.vertex_count(), 1)};
    const BodyId body = simulation.add_body(mesh, Mass::total(3), options);
    simulation.add(body, EdgeSpring{.stiffness = 300});
    simulation.add(body, Bending{.stiffness = 0.01});
    simulation.add(body, TriangleStrain{.stiffness = 200});
  }

  Vec3 linear_momentum() const {
    Vec3 sum = Vec3::Zero();
    for (Index i = 0; i < state().vertex_count(); ++i) sum += mass(i) * row(state().velocities, i);
    return sum;
  }
  Vec3 angular_momentum() const {
    Vec3 sum = Vec3::Zero();
    for (Index i = 0; i < state().vertex_count(); ++i) {
      sum += mass(i) * row(state().positions, i).cross(row(state().velocities, i));
    }
    return sum;
  }
  const State& state() const { return simulation.state(); }
  Real mass(Index i) const { return state().masses[static_cast<std::size_t>(i)]; }

  Simulation simulation;
};

}  // namespace

TEST_CASE("free fall is exact for any number of iterations and any start") {
  for (const Index iterations : {1, 3, 10}) {
    for (const Start start : {Start::prediction, Start::positions, Start::adaptive}) {
      Simulation simulation({.iterations = iterations, .start = start, .precision = Precision::double_});
      const Mesh mesh = torus({.major_segments = 10, .minor_segments = 6});
      const BodyId body = simulation.add_body(mesh, Mass::total(3));
      simulation.add(body, EdgeSpring{.stiffness = 300});
      simulation.add(body, Bending{.stiffness = 0.01});
      add_gravity(simulation);
      for (int n = 1; n <= 200; ++n) {
        simulation.step();
        const Positions fallen = simulation.state().positions - mesh.vertices;
        CHECK((fallen.col(2).array() + 0.5 * g * h * h * n * (n + 1)).abs().maxCoeff() < 1e-11);
        CHECK(fallen.leftCols<2>().cwiseAbs().maxCoeff() < 1e-11);
      }
    }
  }
}

TEST_CASE("a pendulum has the period and the damping of implicit Euler") {
  const SolverSettings settings = converged(1e-9);
  const Oscillation swing = pendulum(settings, Hold::hard, 400);
  CHECK(swing.period == doctest::Approx(2.007897).epsilon(1e-6));
  CHECK(swing.decay == doctest::Approx(0.84881).epsilon(1e-5));
}

TEST_CASE("a hard pin shows gravity at once, a soft pin hides it until the iterations converge") {
  CHECK(pendulum({.iterations = 1}, Hold::hard, 600).period == doctest::Approx(2.008).epsilon(1e-3));
  CHECK(pendulum({.iterations = 1}, Hold::soft, 4000).period == doctest::Approx(33.5).epsilon(0.01));
  CHECK(pendulum({.iterations = 20}, Hold::soft, 2000).period == doctest::Approx(7.6).epsilon(0.01));
  CHECK(pendulum(converged(1e-7), Hold::soft, 130).period == doctest::Approx(2.008).epsilon(1e-3));
}

TEST_CASE("two masses on a spring") {
  Simulation simulation({.time_step = 0.01, .iterations = 1});
  const Mesh mesh = chain({.links = 1, .direction = {1, 0, 0}});
  BodyOptions options{.start = mesh.vertices};
  options.start(0, 0) -= 0.05;
  options.start(1, 0) += 0.05;
  const BodyId body = simulation.add_body(mesh, Mass::per_vertex(1), options);
  simulation.add(body, EdgeSpring{.stiffness = 100});
  advance(simulation, 50);
  const Positions& x = simulation.state().positions;
  CHECK(x(1, 0) - x(0, 0) - 1 == doctest::Approx(0.04495848).epsilon(1e-7));
  CHECK(std::abs(x(1, 0) + x(0, 0) - 1) < 1e-14);
}

TEST_CASE("the linear momentum of a free body is kept at any number of iterations") {
  for (const Index iterations : {1, 2, 20}) {
    FreeBody body({.iterations = iterations});
    const Vec3 before = body.linear_momentum();
    for (int i = 0; i < 100; ++i) {
      body.simulation.step();
      CHECK((body.linear_momentum() - before).norm() < 1e-12);
    }
  }
}

TEST_CASE("the angular momentum of a converged free body obeys the law of implicit Euler") {
  // With q' = q + h v' and forces without torque at q': L' = L + h Σ m v' × v.
  FreeBody body(converged(1e-11));
  for (int i = 0; i < 20; ++i) {
    const Vec3 before = body.angular_momentum();
    const Positions v = body.state().velocities;
    body.simulation.step();
    Vec3 expected = before;
    for (Index k = 0; k < v.rows(); ++k) {
      expected += h * body.mass(k) * row(body.state().velocities, k).cross(row(v, k));
    }
    CHECK((body.angular_momentum() - expected).norm() < 1e-11);
  }
}

TEST_CASE("a vertex on a line falls freely along it, once converged") {
  const Vec3 direction(1, 0, -1);
  Simulation simulation(converged(1e-9));
  Mesh mesh;
  mesh.vertices = Positions::Zero(1, 3);
  const BodyId body = simulation.add_body(mesh, Mass::total(2));
  simulation.add(body, Line{.stiffness = 1e4, .direction = direction});
  add_gravity(simulation);
  const int n = 60;
  advance(simulation, n);
  const Vec3 x = row(simulation.state().positions, 0);
  const Vec3 d = direction.normalized();
  CHECK(x.dot(d) == doctest::Approx(g / std::sqrt(2) * h * h * n * (n + 1) / 2).epsilon(1e-6));
  // Across the line the weight stretches the spring of 1e4 N/m.
  CHECK((x - x.dot(d) * d).norm() == doctest::Approx(2 * g / std::sqrt(2) / 1e4).epsilon(1e-3));
}

}  // namespace test_dynamics
