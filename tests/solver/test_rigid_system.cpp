// Bodies that push each other and move rigidly: their equations against a dense matrix, and what a spring between two
// of them resists.
#include <doctest/doctest.h>

#include "pliant/collision/contact/rigid_couplings.h"
#include "pliant/solver/rigid_system.h"
#include "tests/core/random.h"

namespace test_rigid_system {

using namespace pliant;
using namespace pliant_tests;

namespace {

using Matrix = RigidSystem::Matrix;
using Vector = RigidSystem::Vector;
using Dense = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

Mat3 random_stiffness(Random& random) {
  const Vec3 a = random.vector(1);
  const Vec3 b = random.vector(1);
  return a * a.transpose() + b * b.transpose();
}

/// J m = t + ω × a.
Eigen::Matrix<Real, 3, 6> moved_by(const Vec3& arm) {
  Eigen::Matrix<Real, 3, 6> result;
  result.leftCols<3>().setIdentity();
  for (int i = 0; i < 3; ++i) result.col(3 + i) = Vec3::Unit(i).cross(arm);
  return result;
}

/// Bodies with an inertia and springs between some of them.
struct Bodies {
  std::size_t count = 0;
  std::vector<RigidLink> links;
  std::vector<Matrix> blocks, couplings;
  Dense dense;
  std::vector<Vector> forces;
};

Bodies random_bodies(Random& random, std::size_t count, const std::vector<RigidLink>& links) {
  const auto size = static_cast<Index>(6 * count);
  Bodies bodies{.count = count,
                .links = links,
                .blocks = std::vector<Matrix>(count, Matrix::Identity()),
                .couplings = {},
                .dense = Dense::Identity(size, size),
                .forces = {}};
  for (std::size_t i = 0; i < count; ++i)
    bodies.forces.push_back(Vector::NullaryExpr([&] { return random.uniform(-1, 1); }));
  for (const RigidLink& link : links) {
    const Mat3 stiffness = 100 * random_stiffness(random);
    const auto a = moved_by(random.vector(1));
    const auto b = moved_by(random.vector(1));
    bodies.blocks[link.first] += a.transpose() * stiffness * a;
    bodies.blocks[link.second] += b.transpose() * stiffness * b;
    bodies.couplings.emplace_back(-a.transpose() * stiffness * b);
    const auto first = static_cast<Index>(6 * link.first);
    const auto second = static_cast<Index>(6 * link.second);
    bodies.dense.block<6, 6>(first, second) = bodies.couplings.back();
    bodies.dense.block<6, 6>(second, first) = bodies.couplings.back().transpose();
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto place = static_cast<Index>(6 * i);
    bodies.dense.block<6, 6>(place, place) = bodies.blocks[i];
  }
  return bodies;
}

/// The largest difference from what the dense matrix has for a solution.
Real difference(RigidSystem& system, const Bodies& bodies) {
  system.lay_out(bodies.count, bodies.links);
  std::vector<Vector> found = bodies.forces;
  Eigen::Matrix<Real, Eigen::Dynamic, 1> exact(static_cast<Index>(6 * bodies.count));
  for (std::size_t i = 0; i < bodies.count; ++i) exact.segment<6>(static_cast<Index>(6 * i)) = bodies.forces[i];
  exact = bodies.dense.ldlt().solve(exact).eval();
  for (std::size_t set = 0; set < system.set_count(); ++set) {
    REQUIRE(system.is_small(set));
    system.begin(set);
    for (const std::size_t i : system.bodies(set)) system.set_body(i, bodies.blocks[i]);
    for (const std::size_t i : system.links(set)) system.set_link(i, bodies.couplings[i]);
    REQUIRE(system.factorize(set));
    system.solve(set, found);
  }
  Real most = 0;
  for (std::size_t i = 0; i < bodies.count; ++i) {
    most = std::max(most, (found[i] - exact.segment<6>(static_cast<Index>(6 * i))).cwiseAbs().maxCoeff());
  }
  return most;
}

}  // namespace

TEST_CASE("rigid system: solutions are those of a dense matrix") {
  Random random(5);
  RigidSystem system;
  const std::vector<RigidLink> chain = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};
  const std::vector<RigidLink> ring = {{0, 3}, {0, 5}, {1, 4}, {1, 5}, {2, 3}, {2, 4}};
  const std::vector<RigidLink> two_sets = {{0, 2}, {1, 4}, {2, 6}, {3, 4}, {0, 6}};
  for (const std::vector<RigidLink>& links : {chain, ring, two_sets, std::vector<RigidLink>{}}) {
    CHECK(difference(system, random_bodies(random, 7, links)) < 1e-12);
  }
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<RigidLink> links;
    const std::size_t count = 3 + static_cast<std::size_t>(random.index(15));
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) {
        if (random.index(4) == 0) links.push_back({i, j});
      }
    }
    CHECK(difference(system, random_bodies(random, count, links)) < 1e-11);
    CHECK(difference(system, random_bodies(random, count, links)) < 1e-11);  // laid out already
  }
}

TEST_CASE("rigid system: sets are what links connect") {
  RigidSystem system;
  system.lay_out(6, std::vector<RigidLink>{{0, 3}, {1, 4}, {3, 5}});
  REQUIRE(system.set_count() == 3);
  CHECK(std::ranges::equal(system.bodies(0), std::vector<std::size_t>{0, 3, 5}));
  CHECK(std::ranges::equal(system.bodies(1), std::vector<std::size_t>{1, 4}));
  CHECK(std::ranges::equal(system.bodies(2), std::vector<std::size_t>{2}));
  CHECK(std::ranges::equal(system.links(0), std::vector<std::size_t>{0, 2}));
  CHECK(system.links(2).empty());
}

TEST_CASE("rigid system: a matrix that is not positive definite is refused, a crowd is too large") {
  RigidSystem system;
  system.lay_out(2, std::vector<RigidLink>{{0, 1}});
  system.begin(0);
  system.set_body(0, Matrix::Identity());
  system.set_body(1, Matrix::Identity());
  system.set_link(0, 2 * Matrix::Identity());
  CHECK_FALSE(system.factorize(0));
  std::vector<RigidLink> row, crowd;
  for (std::size_t i = 0; i + 1 < 1000; ++i) row.push_back({i, i + 1});
  for (std::size_t i = 0; i < 60; ++i) {
    for (std::size_t j = i + 1; j < 60; ++j) crowd.push_back({i, j});
  }
  system.lay_out(1000, row);
  CHECK(system.set_count() == 1);
  CHECK_FALSE(system.is_small(0));
  system.lay_out(60, crowd);
  CHECK_FALSE(system.is_small(0));
}

TEST_CASE("rigid couplings: a spring between two arms, whichever of its components comes first") {
  Random random(3);
  RigidCouplings couplings;
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{4, 7}, {9, 2}, {4, 7}, {2, 4}}) couplings.add(a, b);
  couplings.finish();
  REQUIRE(couplings.all().size() == 3);
  Matrix first = Matrix::Zero();
  Matrix second = Matrix::Zero();
  for (int i = 0; i < 3; ++i) {
    const Mat3 stiffness = random_stiffness(random);
    const Vec3 a = random.vector(1);
    const Vec3 b = random.vector(1);
    couplings.add_stiffness(4, 7, a, b, stiffness);
    first -= moved_by(a).transpose() * stiffness * moved_by(b);
    couplings.add_stiffness(9, 2, a, b, stiffness);
    second -= moved_by(b).transpose() * stiffness * moved_by(a);
  }
  CHECK(couplings.all()[0].curvature.isZero(0));  // 2 and 4
  CHECK((couplings.all()[1].curvature - second).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((couplings.all()[2].curvature - first).cwiseAbs().maxCoeff() < 1e-14);
  couplings.set_zero();
  CHECK(couplings.all()[2].curvature.isZero(0));
}

}  // namespace test_rigid_system
