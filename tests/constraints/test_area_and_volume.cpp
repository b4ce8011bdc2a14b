// The nearest stretches of given product against a dense search, and what the constraints made of them do to bodies.
#include <doctest/doctest.h>

#include "../core/random.h"
#include "elastic.h"
#include "pliant/constraints/plane.h"
#include "pliant/constraints/position.h"
#include "pliant/constraints/product_projection.h"
#include "pliant/constraints/tetrahedron_strain.h"
#include "pliant/constraints/tetrahedron_volume.h"
#include "pliant/constraints/triangle_area.h"
#include "pliant/mesh/shapes.h"
#include "pliant/simulation/simulation.h"

namespace test_area_and_volume {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// A stretch from 1e-3 to 30; now and then zero, one, or the same as another.
Real random_stretch(Random& random, Real other) {
  switch (random.index(8)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2:
      return other;
    default:
      return std::pow(10, random.uniform(-3, 1.5));
  }
}

/// Sorted by magnitude, as decompositions have them; the last may be negative.
Vec3 random_stretches(Random& random) {
  Vec3 sigma = Vec3::Ones();
  for (int i = 0; i < 3; ++i) sigma[i] = random_stretch(random, sigma[(i + 2) % 3]);
  std::sort(sigma.begin(), sigma.end(), std::greater<>());
  if (random.index(3) == 0) sigma[2] = -sigma[2];
  return sigma;
}

Real random_product(Random& random) {
  return random.index(2) == 0 ? 1 : std::pow(10, random.uniform(-2, 2));
}

/// Least of f over [low, high]: a scan in steps of equal ratio, and a search by thirds around its best place.
template <class Function>
Real least(Real low, Real high, int samples, const Function& f) {
  const Real step = std::log(high / low) / samples;
  Real best_place = 0, best = std::numeric_limits<Real>::infinity();
  for (int i = 0; i <= samples; ++i) {
    const Real place = std::log(low) + i * step;
    if (const Real value = f(std::exp(place)); value < best) best = value, best_place = place;
  }
  Real left = best_place - step, right = best_place + step;
  for (int i = 0; i < 40; ++i) {
    const Real third = (right - left) / 3;
    (f(std::exp(left + third)) < f(std::exp(right - third)) ? right : left) +=
        (f(std::exp(left + third)) < f(std::exp(right - third)) ? -third : third);
  }
  return std::min(best, f(std::exp((left + right) / 2)));
}

Real square(Real x) {
  return x * x;
}

/// Least squared distance from (s0, s1) to g0 g1 = product, both positive.
Real least_of_two(Real s0, Real s1, Real product, int samples) {
  return least(1e-7, 1e3, samples, [&](Real g) { return square(g - s1) + square(product / g - s0); });
}

}  // namespace

TEST_CASE("areas: no point of the hyperbola is nearer") {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 three = random_stretches(random);
    const Vec2 sigma(three[0], std::abs(three[2]));
    const Real product = random_product(random);
    const Vec2 g = nearest_of_product(sigma, product);
    CAPTURE(sigma);
    CAPTURE(product);
    CHECK(g[0] * g[1] == doctest::Approx(product).epsilon(1e-14));
    CHECK(g[0] >= g[1] * (1 - 1e-15));
    const Real distance = (g - sigma).norm();
    CHECK(distance <= std::sqrt(least_of_two(sigma[0], sigma[1], product, 200)) + 1e-9 * (1 + distance));
  }
}

TEST_CASE("volumes: no sorted stretches of the product are nearer") {
  Random random;
  for (int i = 0; i < 1500; ++i) {
    const Vec3 sigma = random_stretches(random);
    const Real product = random_product(random);
    const Vec3 g = nearest_of_product(sigma, product);
    CAPTURE(sigma);
    CAPTURE(product);
    CHECK(g.prod() == doctest::Approx(product).epsilon(1e-14));
    CHECK(g[2] > 0);
    const Real distance = (g - sigma).norm();
    const Real found = least(1e-7, 1e2, 100, [&](Real last) {
      return square(last - sigma[2]) + least_of_two(sigma[0], sigma[1], product / last, 60);
    });
    CHECK(distance <= std::sqrt(found) + 1e-6 * (1 + distance));
  }
}

TEST_CASE("volumes: stationary, by the condition that they were not found with") {
  Random random;
  int compared = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vec3 sigma = random_stretches(random);
    const Vec3 g = nearest_of_product(sigma, random_product(random));
    if (g[2] < 1e-3) continue;  // where the multiplier is that of a nearly vanishing stretch
    ++compared;
    const Vec3 multipliers = g.cwiseProduct(sigma - g);
    const Real scale = g.cwiseProduct(sigma.cwiseAbs() + g).maxCoeff();
    CAPTURE(sigma);
    CAPTURE(g);
    CHECK(multipliers.maxCoeff() - multipliers.minCoeff() <= 1e-12 * scale);
  }
  CHECK(compared > 50000);
}

namespace {

Real volume_of(const Mesh& mesh, const Positions& q) {
  Real volume = 0;
  for (const Tetrahedron& t : mesh.tetrahedra) {
    const Vec3 x0 = row(q, t[0]);
    volume += (row(q, t[1]) - x0).cross(row(q, t[2]) - x0).dot(row(q, t[3]) - x0) / 6;
  }
  return volume;
}

struct ElasticBar {
  Mesh mesh = bar({.cells = {8, 2, 2}, .size = {1, 0.2, 0.2}});
  std::vector<Index> ends;
  Simulation simulation;
  BodyId body;

  explicit ElasticBar(SolverSettings settings) {
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      const Real x = mesh.vertices(i, 0);
      if (x < 1e-9 || x > 1 - 1e-9) ends.push_back(i);
    }
    simulation.set_settings(settings);
    body = simulation.add_body(mesh, Mass::density(1000));
    simulation.add(body, TetrahedronStrain{.stiffness = 1e5}, "strain");
  }
};

}  // namespace

namespace {

/// Volume over that at rest of a bar that is drawn to one and a half times its length, and has come to rest.
Real volume_of_stretched(ElasticBar& bar, bool is_clamped) {
  std::vector<Vec3> targets;
  for (const Index i : bar.ends) {
    const Vec3 at = row(bar.mesh.vertices, i);
    targets.push_back(Vec3(0.5 + 1.5 * (at[0] - 0.5), at[1], at[2]));
  }
  if (is_clamped) {
    bar.simulation.add(bar.body, Position{.on = bar.ends, .targets = targets}, "ends");
  } else {
    bar.simulation.add(bar.body, OnPlane{.on = bar.ends, .stiffness = 1e7, .normal = Vec3(1, 0, 0), .origin = targets},
                       "ends");
  }
  for (int i = 0; i < 120; ++i) bar.simulation.step();
  return volume_of(bar.mesh, bar.simulation.state().positions) / volume_of(bar.mesh, bar.mesh.vertices);
}

}  // namespace

TEST_CASE("a bar stretched by half keeps its volume within 1 %, and without the constraint grows with its length") {
  const SolverSettings settings{.iterations = 40};
  ElasticBar free(settings), keeping(settings);
  keeping.simulation.add(keeping.body, TetrahedronVolume{.stiffness = 2e7}, "volume");
  CHECK(volume_of_stretched(keeping, true) == doctest::Approx(1).epsilon(0.01));
  CHECK(volume_of_stretched(free, true) == doctest::Approx(1.5).epsilon(1e-9));
}

TEST_CASE("strain and volume together have Poisson's ratio κ/(2 κ + 3 k)") {
  ElasticBar bar({.iterations = 40, .acceleration = Acceleration::lbfgs});
  const Real poisson = 0.45;
  bar.simulation.add(bar.body, TetrahedronVolume{.stiffness = 3 * poisson / (1 - 2 * poisson) * 1e5}, "volume");
  CHECK(std::abs(volume_of_stretched(bar, false) - std::pow(1.5, 1 - 2 * poisson)) < 0.01);
}

TEST_CASE("an inverted, a flattened, a collapsed and a shuffled bar come back to rest") {
  for (const char* start : {"inverted", "flattened", "collapsed", "shuffled"}) {
    CAPTURE(start);
    ElasticBar bar({.time_step = 1.0 / 60, .iterations = 30});
    bar.simulation.add(bar.body, TetrahedronVolume{.stiffness = 1e5}, "volume");
    const std::string_view kind = start;
    Random random;
    Positions q = bar.mesh.vertices;
    if (kind == "inverted") q.col(2) *= -1;
    if (kind == "flattened") q.col(2).setZero();
    if (kind == "collapsed") q.setConstant(0.1);
    if (kind == "shuffled") q = random.positions(bar.mesh.vertex_count(), 0.3);
    bar.simulation.set_state(q, Positions::Zero(q.rows(), 3));
    for (int i = 0; i < 600; ++i) bar.simulation.step();
    CHECK(bar.simulation.elastic_energy(*bar.simulation.find_group("strain")) < 1e-3);  // of 4 kJ
    CHECK(volume_of(bar.mesh, bar.simulation.state().positions) == doctest::Approx(0.04).epsilon(1e-5));
  }
}

}  // namespace test_area_and_volume
