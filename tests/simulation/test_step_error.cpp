// How far iterations leave a step from its end, and automatic iterations, which go by that.
#include <cstring>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/pliant.h"
#include "pliant/simulation/step_error.h"

namespace test_step_error {

using namespace pliant;

namespace {

/// A stiff cloth that falls from its two upper corners, into folds when `contact`.
struct Cloth {
  explicit Cloth(SolverSettings settings, bool contact = false) : simulation(settings) {
    const BodyId cloth =
        simulation.add_body(grid({.columns = 16, .rows = 16, .plane = Plane::xy}), Mass::area_density(0.15));
    simulation.add(cloth, TriangleStrain{.stiffness = 1500});
    simulation.add(cloth, HingeBending{.stiffness = 1e-5});
    simulation.add(cloth, Position{.on = {240, 255}});
    simulation.add(Gravity{});
    if (contact) {
      simulation.set_contact({.surfaces = true});
      simulation.add(SphereCollider{.center = {0.5, 0.5, -0.5}, .radius = 0.3});
    }
  }
  void advance(int steps) {
    for (int i = 0; i < steps; ++i) simulation.step();
  }
  Simulation simulation;
};

SolverSettings lively(Index iterations, Index threads = 1) {
  return {.integrator = Integrator::bdf2,
          .iterations = iterations,
          .acceleration = Acceleration::lbfgs,
          .threads = threads};
}

bool same_bits(const Positions& a, const Positions& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(Real) * static_cast<std::size_t>(a.size())) == 0;
}

bool same_bits(const State& a, const State& b) {
  return same_bits(a.positions, b.positions) && same_bits(a.velocities, b.velocities);
}

}  // namespace

TEST_CASE("a body in flight has no error, with a single iteration") {
  Simulation simulation({.iterations = 1});
  const BodyId body = simulation.add_body(grid({.columns = 4, .rows = 4}), Mass::total(1));
  simulation.add(body, TriangleStrain{.stiffness = 1000});
  simulation.add(Gravity{});
  simulation.step();
  CHECK(find_step_error(simulation)->distance < 1e-12);
}

TEST_CASE("the error is the distance to the converged step, of the body in which it is largest") {
  Cloth cloth(lively(3));
  Simulation& simulation = cloth.simulation;
  const BodyId calm = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::total(1));
  simulation.add(calm, Position{});
  cloth.advance(20);
  const State start = simulation.state();
  const StepError error = find_step_error(simulation).value();
  CHECK(error.body == BodyId{0});

  simulation.step();
  const Positions end = simulation.state().positions;
  simulation.restore(start);
  simulation.set_settings(lively(3000));
  simulation.step();
  Real sum = 0, mass = 0, push = 0;
  const Real h = simulation.settings().time_step;
  for (Index i = 0; i < simulation.body(BodyId{0}).mesh.vertex_count(); ++i) {
    const Real m = start.masses[static_cast<std::size_t>(i)];
    mass += m;
    sum += m * (end.row(i) - simulation.state().positions.row(i)).squaredNorm();
    push +=
        m * (simulation.state().positions.row(i) - start.positions.row(i) - h * start.velocities.row(i)).squaredNorm();
  }
  const Real distance = std::sqrt(sum / mass);
  CHECK(error.distance == doctest::Approx(distance).epsilon(0.02));
  CHECK(error.acceleration == doctest::Approx(distance / (h * h)).epsilon(0.02));
  const Real unit = std::max(standard_gravity, std::sqrt(push / mass) / (h * h));
  CHECK(error.share == doctest::Approx(distance / (h * h) / unit).epsilon(0.05));
  CHECK(error.share > 0.1);
}

TEST_CASE("more iterations have a smaller error, L-BFGS a smaller one than none") {
  Cloth cloth(lively(20));
  cloth.advance(30);
  const auto error = [&](SolverSettings settings) {
    cloth.simulation.set_settings(settings);
    return find_step_error(cloth.simulation)->share;
  };
  const Real with_20 = error(lively(20));
  CHECK(error(lively(60)) < 0.8 * with_20);
  SolverSettings plain = lively(20);
  plain.acceleration = Acceleration::none;
  CHECK(error(plain) > 1.3 * with_20);
}

TEST_CASE("who looks at the error changes no bit") {
  for (const bool contact : {false, true}) {
    CAPTURE(contact);
    Cloth looked_at(lively(10), contact);
    Cloth other(lively(10), contact);
    for (int i = 0; i < 40; ++i) {
      if (i % 8 == 7) CHECK(find_step_error(looked_at.simulation).has_value());
      looked_at.advance(1);
      other.advance(1);
    }
    CHECK(same_bits(looked_at.simulation.state(), other.simulation.state()));
    CHECK(looked_at.simulation.settings() == other.simulation.settings());
  }
}

TEST_CASE("a step that is given up while it is looked at leaves everything as it was") {
  Cloth cloth(lively(10));
  cloth.advance(5);
  const State before = cloth.simulation.state();
  int asked = 0;
  cloth.simulation.set_stop([&] { return ++asked > 100; });
  CHECK_THROWS_AS(find_step_error(cloth.simulation), Error);
  CHECK(same_bits(cloth.simulation.state(), before));
  CHECK(cloth.simulation.state().step == before.step);
  CHECK(cloth.simulation.settings() == lively(10));
}

TEST_CASE("iterations without end, which a tolerance ends, are not looked at") {
  SolverSettings settings = lively(1000000000);
  settings.tolerance = 1e-3;
  Cloth cloth(settings);
  cloth.advance(3);
  CHECK(!find_step_error(cloth.simulation).has_value());
  cloth.simulation.set_settings(lively(1999));
  CHECK(find_step_error(cloth.simulation)->share < 0.01);
}

TEST_CASE("automatic iterations reach the bound, and no more than the ceiling") {
  SolverSettings settings = lively(automatic_iterations);
  settings.step_error = 0.1;
  Cloth cloth(settings);
  const StepReport first = cloth.simulation.step();
  CHECK(first.iterations == first_iterations);
  cloth.advance(30);  // found before steps 10 and 30
  const Index found = cloth.simulation.state().iterations;
  CHECK(found > first_iterations);
  CHECK(found < settings.most_iterations);
  CHECK(cloth.simulation.step().iterations == found);
  CHECK(find_step_error(cloth.simulation)->share < 1.5 * settings.step_error);

  settings.step_error = 1e-3;
  settings.most_iterations = 8;
  Cloth few(settings);
  CHECK(few.simulation.step().iterations == 8);
  few.advance(12);
  CHECK(few.simulation.step().iterations == 8);
}

TEST_CASE("automatic iterations become fewer where fewer do") {
  Simulation simulation(lively(automatic_iterations));
  const BodyId body = simulation.add_body(chain({.links = 4}), Mass::total(1));
  simulation.add(body, EdgeSpring{.stiffness = 1});
  simulation.add(body, Position{.on = {0}});
  simulation.add(Gravity{});
  for (int i = 0; i < 95; ++i) simulation.step();
  CHECK(simulation.state().iterations <= 8);
  CHECK(simulation.state().iterations >= 5);
}

TEST_CASE("automatic iterations give the bits of the same numbers of iterations, on any number of threads") {
  SolverSettings settings = lively(automatic_iterations);
  settings.step_error = 0.1;
  Cloth automatic(settings, true);
  settings.threads = 3;
  Cloth threads(settings, true);
  Cloth given(lively(first_iterations), true);
  State middle;
  for (int i = 0; i < 40; ++i) {
    if (i == 20) middle = automatic.simulation.state();
    const Index taken = automatic.simulation.step().iterations;
    threads.advance(1);
    given.simulation.set_settings(lively(taken));
    given.advance(1);
  }
  CHECK(same_bits(automatic.simulation.state(), given.simulation.state()));
  CHECK(same_bits(automatic.simulation.state(), threads.simulation.state()));

  const State end = automatic.simulation.state();
  automatic.simulation.restore(middle);
  automatic.advance(20);
  CHECK(same_bits(automatic.simulation.state(), end));
}

TEST_CASE("a step of automatic iterations that is given up at any moment is taken as if it had not been begun") {
  Cloth whole(lively(automatic_iterations), true), broken(lively(automatic_iterations), true);
  for (int i = 0; i < 12; ++i) {
    whole.simulation.step();
    // Broken off ever later, past the search for the number of iterations, until it is taken.
    bool is_taken = false;
    for (int most = 0; !is_taken; most += 7) {
      const Index before = broken.simulation.state().iterations;
      broken.simulation.set_stop([left = most]() mutable { return left-- <= 0; });
      try {
        broken.simulation.step();
        is_taken = true;
      } catch (const Error& error) {
        REQUIRE(error.kind() == ErrorKind::interrupted);
        REQUIRE(broken.simulation.state().iterations == before);
      }
    }
    broken.simulation.set_stop({});
    REQUIRE(same_bits(broken.simulation.state(), whole.simulation.state()));
  }
}

TEST_CASE("iterations that are neither a number of them nor automatic are refused") {
  for (const Index wrong : {0, -2}) {
    CHECK_THROWS_WITH_AS(Simulation({.iterations = wrong}), doctest::Contains("or `automatic`"), Error);
  }
  CHECK_THROWS_AS(Simulation({.step_error = 0}), Error);
  CHECK_THROWS_AS(Simulation({.most_iterations = 4}), Error);
}

}  // namespace test_step_error
