// What accelerations promise: the same minimum in fewer iterations, never uphill, and the same bits whatever came
// before.
#include <array>
#include <cstring>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "../simulation/everything.h"
#include "../simulation/run.h"
#include "pliant/mesh/shapes.h"
#include "pliant/solver/acceleration/anderson.h"
#include "pliant/solver/acceleration/chebyshev.h"
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

/// Anderson acceleration as the paper has it, in double precision.
class LeastSquares {
 public:
  explicit LeastSquares(std::size_t memory) : memory_(memory) {}

  Positions move(const Positions& x) {
    if (last_x_.size() > 0) {
      changes_.push_back(x - last_x_);
      moves_.push_back(last_move_ + changes_.back());
      if (moves_.size() > memory_) {
        changes_.erase(changes_.begin());
        moves_.erase(moves_.begin());
      }
    }
    last_x_ = x;
    last_move_ = x;
    if (changes_.empty()) return x;
    Eigen::MatrixXd columns(x.size(), static_cast<Eigen::Index>(changes_.size()));
    for (std::size_t i = 0; i < changes_.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = flat(changes_[i]);
    const Eigen::VectorXd gamma = columns.colPivHouseholderQr().solve(flat(x));
    for (std::size_t i = 0; i < moves_.size(); ++i) last_move_ -= gamma[static_cast<Eigen::Index>(i)] * moves_[i];
    return last_move_;
  }
  Positions scale_last(Real share) { return last_move_ *= share; }

 private:
  static Eigen::VectorXd flat(const Positions& x) { return Eigen::Map<const Eigen::VectorXd>(x.data(), x.size()); }

  std::size_t memory_;
  std::vector<Positions> changes_, moves_;
  Positions last_x_, last_move_;
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

void move(Accelerator& accelerator, const LocalResult& local, const Positions& r, const Positions& x, Positions& q) {
  ThreadPool threads(1);
  accelerator.prepare(local, r, x, threads);
  accelerator.move(x, 0, q, threads);
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

void compare_with_least_squares(Index vertices, std::size_t memory) {
  Random random;
  Anderson anderson;
  LeastSquares textbook(memory);
  Positions q = random.positions(vertices, 1);
  Positions expected = q;
  const Real first = force(q).norm();
  anderson.begin(vertices);
  for (int i = 0; i < 12; ++i) {
    CAPTURE(i);
    const Positions r = force(q);
    move(anderson, {}, r, r / 10, q);
    CHECK(anderson.is_plain() == (i == 0));
    expected += textbook.move(force(expected) / 10);
    CHECK((q - expected).norm() <= 1e-4 * force(expected).norm());
  }
  CHECK(force(q).norm() < 1e-2 * first);
}

constexpr std::array accelerations = {Acceleration::lbfgs, Acceleration::anderson, Acceleration::chebyshev};

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

TEST_CASE("Anderson: the moves are those of the least squares, with as many differences") {
  compare_with_least_squares(100, Anderson::memory);
  compare_with_least_squares(Anderson::large - 1, Anderson::memory);
  compare_with_least_squares(Anderson::large, Anderson::memory_of_large);
}

TEST_CASE("Anderson: solutions that do not differ have no share, and nothing becomes infinite") {
  Anderson anderson;
  Positions q = Positions::Zero(4, 3);
  const Positions x = Positions::Ones(4, 3);
  anderson.begin(4);
  for (int i = 0; i < 20; ++i) {
    const Positions before = q;
    move(anderson, {}, x, x, q);
    CHECK(same_bits(q, before + x));
  }
}

TEST_CASE("Anderson: goes on from a move that was made shorter as from one that was made so") {
  Random random;
  Anderson anderson;
  LeastSquares textbook(Anderson::memory);
  Positions q = random.positions(50, 1);
  Positions expected = q;
  anderson.begin(50);
  for (int i = 0; i < 6; ++i) {
    CAPTURE(i);
    const Positions r = force(q);
    move(anderson, {}, r, r / 10, q);
    Positions s = textbook.move(force(expected) / 10);
    if (i == 3) {
      anderson.scale_move(0.5, q);
      s = textbook.scale_last(0.5);
    }
    expected += s;
    CHECK((q - expected).norm() <= 1e-4 * force(expected).norm());
  }
}

TEST_CASE("Chebyshev: a force whose errors shrink by 0 to 0.997 is gone in a seventh of the plain moves") {
  constexpr Index vertices = 300;
  Eigen::VectorXd stiffness(vertices);
  for (Index i = 0; i < vertices; ++i) stiffness[i] = 0.003 + 0.997 * i / (vertices - 1);
  const auto r = [&](const Positions& q) -> Positions { return -(stiffness.asDiagonal() * q); };
  const auto moves_until_gone = [](const std::function<void(Positions&)>& next) {
    Positions q = Positions::Ones(vertices, 3);
    int count = 0;
    for (; q.norm() > 1e-6 && count < 10000; ++count) next(q);
    return count;
  };
  Chebyshev chebyshev;
  chebyshev.begin(vertices);
  const int plain = moves_until_gone([&](Positions& q) { q += r(q); });
  const int accelerated = moves_until_gone([&](Positions& q) { move(chebyshev, {}, r(q), r(q), q); });
  CHECK(plain > 3000);
  CHECK(7 * accelerated < plain);
}

TEST_CASE("Chebyshev: each rise makes momentum smaller; a plain move without one does not") {
  const auto move_after = [](int rises) {
    Chebyshev chebyshev;
    const Positions r = Positions::Ones(4, 3);
    Positions q = Positions::Zero(4, 3);
    chebyshev.begin(4);
    for (int i = 0; i < 2; ++i) move(chebyshev, {}, r, r / 10, q);
    for (int i = 0; i < rises; ++i) chebyshev.note_rise();
    chebyshev.move_plainly(r / 10, 0, q);
    const Positions before = q;
    move(chebyshev, {}, r, r / 10, q);
    return (q - before).norm();
  };
  Chebyshev begun;
  const Positions r = Positions::Ones(4, 3);
  Positions first = Positions::Zero(4, 3);
  begun.begin(4);
  move(begun, {}, r, r / 10, first);
  Positions second = first;
  move(begun, {}, r, r / 10, second);
  CHECK(move_after(0) == doctest::Approx((second - first).norm()).epsilon(1e-12));
  CHECK(move_after(1) < 0.99 * move_after(0));
  CHECK(move_after(2) < 0.99 * move_after(1));
}

TEST_CASE("Anderson, Chebyshev: a move that raises the objective gives way to the plain one, as long as it should be") {
  Anderson anderson;
  Chebyshev chebyshev;
  for (Accelerator* const accelerator : {static_cast<Accelerator*>(&anderson), static_cast<Accelerator*>(&chebyshev)}) {
    const Positions r = Positions::Ones(4, 3);
    Positions q = Positions::Zero(4, 3);
    accelerator->begin(4);
    for (const Real share : {1.0, 0.9, 0.7}) move(*accelerator, {.elastic = 1}, share * r, share * r / 10, q);
    const Positions before = q;
    move(*accelerator, {.elastic = 1}, r, r / 10, q);
    CHECK_FALSE(accelerator->is_plain());
    CHECK_FALSE(same_bits(q, before + r / 10));
    CHECK_FALSE(accelerator->has_risen({.elastic = 1}));
    CHECK(accelerator->has_risen({.elastic = 1 + 1e-9}));
    CHECK(accelerator->best_share({.elastic = 2}) == 0);  // its slope is not known
    accelerator->move_plainly(r / 10, 3.6, q);            // xᵀr is 1.2
    CHECK(accelerator->is_plain());
    CHECK((q - before - r / 40).norm() < 1e-15);
    accelerator->shorten(0.5, r / 10, q);
    CHECK((q - before - r / 80).norm() < 1e-15);
    CHECK(accelerator->best_share({.elastic = 2}) == doctest::Approx(0.15 / (2 * 1.15)));
  }
}

TEST_CASE("accelerations: the minimum of the plain algorithm, in fewer iterations") {
  for (const Acceleration acceleration : accelerations) {
    CAPTURE(static_cast<int>(acceleration));
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
      CAPTURE(static_cast<int>(integrator));
      const SolverSettings settings{.integrator = integrator, .iterations = 20000, .tolerance = 1e-10, .threads = 1};
      Simulation plain = sheet(settings);
      Simulation accelerated = sheet(settings);
      SolverSettings with = settings;
      with.acceleration = acceleration;
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
      const double share = acceleration == Acceleration::chebyshev ? 0.75 : 0.5;  // momentum ends slowly
      CHECK(iterations < share * plain_iterations);
    }
  }
}

TEST_CASE("accelerations: nearer than the plain algorithm after as many iterations, from the same state") {
  for (const Acceleration acceleration : accelerations) {
    CAPTURE(static_cast<int>(acceleration));
    Simulation simulation = sheet({.iterations = 10, .threads = 1});
    advance(simulation, 10);
    const State start = simulation.state();
    const auto objective = [&](Acceleration chosen, Index iterations) {
      SolverSettings settings = simulation.settings();
      settings.acceleration = chosen;
      settings.iterations = iterations;
      simulation.set_settings(settings);
      simulation.restore(start);
      simulation.step();
      return simulation.evaluate().objective();
    };
    const Real lowest = objective(acceleration, 2000);
    CHECK(objective(Acceleration::none, 2000) > lowest - 1e-12);
    CHECK(objective(Acceleration::none, 20) - lowest > 3 * (objective(acceleration, 20) - lowest));
  }
}

TEST_CASE(
    "accelerations: with every constraint and force, substeps and energy projection, the same bits for any number of "
    "threads") {
  for (const Acceleration acceleration : accelerations) {
    CAPTURE(static_cast<int>(acceleration));
    const auto run = [acceleration](Index threads) {
      Simulation simulation = everything({.substeps = 2,
                                          .iterations = 9,
                                          .acceleration = acceleration,
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
}

TEST_CASE("accelerations: no iterate has a higher objective than the one before") {
  for (const Acceleration acceleration : accelerations) {
    CAPTURE(static_cast<int>(acceleration));
    Simulation simulation = sheet({.iterations = 60, .acceleration = acceleration, .threads = 1});
    Index taken_back = 0;
    for (int step = 0; step < 30; ++step) {
      taken_back += simulation.step().backtracks;
      const std::span<const Real> history = simulation.objective_history();
      REQUIRE(history.size() == 60);
      for (std::size_t i = 1; i < history.size(); ++i) CHECK(history[i] <= history[i - 1] * (1 + 1e-11));
    }
    CHECK((acceleration != Acceleration::chebyshev || taken_back > 0));  // without that it would not hold
  }
}

TEST_CASE("accelerations: switched on and off while it runs, each step is that of a simulation made so") {
  for (const Acceleration acceleration : accelerations) {
    CAPTURE(static_cast<int>(acceleration));
    const auto settings = [acceleration](bool is_on) {
      return SolverSettings{.iterations = 12, .acceleration = is_on ? acceleration : Acceleration::none, .threads = 1};
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
}

TEST_CASE("accelerations: a step depends on its state alone, not on the steps before") {
  for (const Acceleration acceleration : accelerations) {
    CAPTURE(static_cast<int>(acceleration));
    const SolverSettings settings{.iterations = 12, .acceleration = acceleration, .threads = 1};
    Simulation simulation = sheet(settings);
    for (int step = 0; step < 30; ++step) {
      Simulation other = sheet(settings);
      other.restore(simulation.state());
      simulation.step();
      other.step();
      CHECK(same_bits(simulation.state().positions, other.state().positions));
    }
  }
}

}  // namespace test_acceleration
