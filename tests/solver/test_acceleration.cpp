// What L-BFGS promises: the same minimum in fewer iterations, never uphill, and the same bits whatever came before.
#include <cstring>
#include <functional>
#include <limits>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "../simulation/everything.h"
#include "../simulation/run.h"
#include "pliant/mesh/shapes.h"
#include "pliant/solver/acceleration/lbfgs.h"

namespace test_acceleration {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// The two loops as the textbook has them (Nocedal and Wright 2006, Algorithm 7.4), in double precision.
class Textbook {
 public:
  explicit Textbook(std::size_t memory) : memory_(memory) {}

  Positions move(const Positions& r, const std::function<Positions(const Positions&)>& solve) {
    if (last_r_.size() > 0) {
      s_.push_back(last_move_);
      y_.push_back(last_r_ - r);
      if (s_.size() > memory_) {
        s_.erase(s_.begin());
        y_.erase(y_.begin());
      }
    }
    std::vector<Real> alpha(s_.size());
    Positions v = r;
    for (std::size_t i = s_.size(); i-- > 0;) {
      alpha[i] = product(s_[i], v) / product(s_[i], y_[i]);
      v -= alpha[i] * y_[i];
    }
    Positions z = solve(v);
    for (std::size_t i = 0; i < s_.size(); ++i) {
      const Real beta = product(y_[i], z) / product(s_[i], y_[i]);
      z += (alpha[i] - beta) * s_[i];
    }
    last_r_ = r;
    last_move_ = z;
    return z;
  }

 private:
  static Real product(const Positions& a, const Positions& b) { return a.cwiseProduct(b).sum(); }

  std::size_t memory_;
  std::vector<Positions> s_, y_;
  Positions last_r_, last_move_;
};

/// Minus the gradient of ½ Σ c q² + ¼ Σ q⁴, for coefficients that a solve by 10 is far from.
Positions force(const Positions& q) {
  Positions r(q.rows(), 3);
  for (Index i = 0; i < static_cast<Index>(q.rows()); ++i) {
    const Real stiffness = 0.1 + 8.0 * i / static_cast<Real>(q.rows());
    for (int k = 0; k < 3; ++k) r(i, k) = -stiffness * q(i, k) - q(i, k) * q(i, k) * q(i, k);
  }
  return r;
}

Simulation sheet(const SolverSettings& settings) {
  Simulation simulation(settings);
  const BodyId body = simulation.add_body(grid({.columns = 12, .rows = 12}), Mass::area_density(0.2));
  simulation.add(Gravity{});
  simulation.add(body, TriangleStrain{.stiffness = 1e3});
  simulation.add(body, HingeBending{.stiffness = 1e-3});
  simulation.add(body, Position{.on = {132, 143}});
  return simulation;
}

bool same_bits(const Positions& a, const Positions& b) {
  return std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(Real)) == 0;
}

void move(Lbfgs& lbfgs, const LocalResult& local, const Positions& r, const Positions& x, Positions& q) {
  ThreadPool threads(1);
  lbfgs.prepare(local, r, x, threads);
  lbfgs.move(x, 0, q, threads);
}

void compare_with_textbook(Index vertices, std::size_t memory) {
  Random random;
  Lbfgs lbfgs;
  Textbook textbook(memory);
  Positions q = random.positions(vertices, 1);
  Positions expected = q;
  const auto solve = [](const Positions& r) -> Positions { return r / 10; };
  const Real first = force(q).norm();
  lbfgs.begin(vertices);
  for (int i = 0; i < 25; ++i) {
    CAPTURE(i);
    const Positions r = force(q);
    CHECK(lbfgs.is_plain() == (i <= 1));
    move(lbfgs, {}, r, solve(r), q);
    expected += textbook.move(force(expected), solve);
    CHECK((q - expected).norm() <= 1e-5 * force(expected).norm());
  }
  CHECK(force(q).norm() < 1e-2 * first);
}

}  // namespace

TEST_CASE("L-BFGS: the moves are those of the textbook, with as many pairs") {
  compare_with_textbook(100, Lbfgs::memory);
  compare_with_textbook(Lbfgs::large - 1, Lbfgs::memory);
  compare_with_textbook(Lbfgs::large, Lbfgs::memory_of_large);
}

TEST_CASE("L-BFGS: a move that raises the objective is taken back, for the plain one") {
  Random random;
  Lbfgs lbfgs;
  constexpr Index vertices = 20;
  Positions q = random.positions(vertices, 1);
  lbfgs.begin(vertices);
  LocalResult local{.inertia = 1, .elastic = 2};
  move(lbfgs, local, force(q), force(q) / 10, q);
  CHECK(lbfgs.is_plain());
  local.elastic = 1;
  const Positions before = q;
  const Positions r = force(q);
  move(lbfgs, local, r, r / 10, q);
  CHECK_FALSE(same_bits(q, before + r / 10));
  CHECK_FALSE(lbfgs.has_risen(local));
  local.elastic = 1 + 1e-9;
  CHECK(lbfgs.has_risen(local));
  local.elastic = std::numeric_limits<Real>::quiet_NaN();
  CHECK(lbfgs.has_risen(local));
  lbfgs.move_plainly(r / 10, 0, q);
  CHECK(same_bits(q, before + r / 10));
  CHECK(lbfgs.is_plain());

  SUBCASE("and goes on as if it had begun there") {
    Lbfgs fresh;
    Positions other = before;
    fresh.begin(vertices);
    move(fresh, local, r, r / 10, other);
    for (int i = 0; i < 10; ++i) {
      move(lbfgs, local, force(q), force(q) / 10, q);
      move(fresh, local, force(other), force(other) / 10, other);
      CHECK((q - other).cwiseAbs().maxCoeff() <= 1e-7);
    }
  }
}

TEST_CASE("L-BFGS: a plain move is as short as the curvature that the matrix lacks asks for") {
  ThreadPool threads(1);
  Lbfgs lbfgs;
  const Positions r = Positions::Ones(4, 3);
  Positions q = Positions::Zero(4, 3);
  lbfgs.begin(4);
  lbfgs.prepare({}, r, r / 10, threads);
  CHECK(lbfgs.is_plain());
  lbfgs.move(r / 10, 3.6, q, threads);  // xᵀr is 1.2
  CHECK((q - r / 40).norm() < 1e-8);    // kept in single precision
  lbfgs.shorten(0.5, r / 10, q);
  CHECK((q - r / 80).norm() < 1e-8);
}

TEST_CASE("L-BFGS: along no positive curvature, the move is the plain one") {
  Lbfgs lbfgs;
  Positions q = Positions::Ones(4, 3);
  lbfgs.begin(4);
  for (int i = 0; i < 5; ++i) {  // the force grows along the way
    const Positions before = q;
    const Positions r = q;
    move(lbfgs, {}, r, r, q);
    CHECK(same_bits(q, before + r));
    CHECK(lbfgs.is_plain());
  }
}

TEST_CASE("lbfgs: the minimum of the plain algorithm, in less than half of its iterations") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    CAPTURE(static_cast<int>(integrator));
    const SolverSettings settings{.integrator = integrator, .iterations = 20000, .tolerance = 1e-10, .threads = 1};
    Simulation plain = sheet(settings);
    Simulation accelerated = sheet(settings);
    SolverSettings with = settings;
    with.acceleration = Acceleration::lbfgs;
    accelerated.set_settings(with);
    Index plain_iterations = 0;
    Index iterations = 0;
    for (int step = 0; step < 8; ++step) {
      const StepReport expected = plain.step();
      const StepReport report = accelerated.step();
      REQUIRE(expected.reached_tolerance);
      REQUIRE(report.reached_tolerance);
      plain_iterations += expected.iterations;
      iterations += report.iterations;
      CHECK((plain.state().positions - accelerated.state().positions).cwiseAbs().maxCoeff() < 1e-9);
    }
    CHECK(2 * iterations < plain_iterations);
  }
}

TEST_CASE("lbfgs: nearer than the plain algorithm after as many iterations, from the same state") {
  Simulation simulation = sheet({.iterations = 10, .threads = 1});
  advance(simulation, 10);
  const State start = simulation.state();
  const auto objective = [&](Acceleration acceleration, Index iterations) {
    SolverSettings settings = simulation.settings();
    settings.acceleration = acceleration;
    settings.iterations = iterations;
    simulation.set_settings(settings);
    simulation.restore(start);
    simulation.step();
    return simulation.evaluate().objective();
  };
  const Real lowest = objective(Acceleration::lbfgs, 2000);
  CHECK(objective(Acceleration::none, 2000) > lowest - 1e-12);
  CHECK(objective(Acceleration::none, 20) - lowest > 3 * (objective(Acceleration::lbfgs, 20) - lowest));
}

TEST_CASE(
    "lbfgs: with every constraint and force, substeps and energy projection, the same bits for any number of threads") {
  const auto run = [](Index threads) {
    Simulation simulation = everything({.substeps = 2,
                                        .iterations = 9,
                                        .acceleration = Acceleration::lbfgs,
                                        .damping = 0.5,
                                        .energy_projection = 0.5,
                                        .threads = threads},
                                       40);
    advance(simulation, 4);
    return simulation.state().positions;
  };
  const Positions expected = run(1);
  CHECK(expected.allFinite());
  for (const Index threads : {2, 3, 8}) {
    CAPTURE(threads);
    CHECK(same_bits(run(threads), expected));
  }
}

TEST_CASE("lbfgs: switched on and off while it runs, each step is that of a simulation made so") {
  const auto settings = [](bool is_on) {
    return SolverSettings{
        .iterations = 12, .acceleration = is_on ? Acceleration::lbfgs : Acceleration::none, .threads = 1};
  };
  Simulation simulation = sheet(settings(false));
  for (const bool is_on : {false, true, true, false, true, false, false, true}) {
    Simulation other = sheet(settings(is_on));
    other.restore(simulation.state());
    simulation.set_settings(settings(is_on));
    simulation.step();
    other.step();
    CHECK(same_bits(simulation.state().positions, other.state().positions));
  }
}

TEST_CASE("lbfgs: a step depends on its state alone, not on the steps before") {
  const SolverSettings settings{.iterations = 12, .acceleration = Acceleration::lbfgs, .threads = 1};
  Simulation simulation = sheet(settings);
  for (int step = 0; step < 30; ++step) {
    Simulation other = sheet(settings);
    other.restore(simulation.state());
    simulation.step();
    other.step();
    CHECK(same_bits(simulation.state().positions, other.state().positions));
  }
}

}  // namespace test_acceleration
