// What springs at single places do against rigid motions.
#include <array>

#include <doctest/doctest.h>

#include "pliant/collision/contact/rigid_resistance.h"

namespace test_rigid_resistance {

using namespace pliant;

namespace {

using Motion = RigidResistance::Motion;

/// How far a motion takes x.
Vec3 way_of(const RigidResistance& of, const Vec3& x, const Motion& motion) {
  return motion.head<3>() + motion.tail<3>().cross(x - of.center);
}

Real energy_of(const RigidResistance& of, const Motion& motion) {
  const Eigen::Matrix<Real, 6, 6> whole = of.curvature.selfadjointView<Eigen::Lower>();
  return motion.dot(whole * motion) / 2;
}

RigidResistance resistance() {
  RigidResistance made;
  made.center = {0.3, -0.2, 0.5};
  return made;
}

const Vec3 place(1.1, 0.4, -0.7);
const std::array<Motion, 3> motions = {(Motion() << 1, 2, -3, 0, 0, 0).finished(),
                                       (Motion() << 0, 0, 0, 0.5, -1, 2).finished(),
                                       (Motion() << 0.3, -0.7, 1.1, 2, 0.4, -0.9).finished()};

TEST_CASE("rigid resistance: a spring along one direction has the energy of the way along it") {
  const Vec3 n = Vec3(1, -2, 0.5).normalized();
  for (const Real k : {40.0, -15.0}) {
    RigidResistance sum = resistance();
    sum.add_direction(place, n, k);
    for (const Motion& motion : motions) {
      const Real along = n.dot(way_of(sum, place, motion));
      CHECK(energy_of(sum, motion) == doctest::Approx(k / 2 * along * along).epsilon(1e-12));
    }
  }
}

TEST_CASE("rigid resistance: a spring alike in all directions has the energy of the whole way") {
  RigidResistance sum = resistance();
  sum.add_everywhere(place, 7);
  for (const Motion& motion : motions) {
    CHECK(energy_of(sum, motion) == doctest::Approx(3.5 * way_of(sum, place, motion).squaredNorm()).epsilon(1e-12));
  }
}

TEST_CASE("rigid resistance: a spring of any stiffness, and forces with their torques") {
  RigidResistance sum = resistance();
  const Mat3 stiffness = (Mat3() << 5, 1, -2, 1, 8, 0.5, -2, 0.5, 3).finished();
  sum.add_stiffness(place, stiffness);
  const Vec3 force(2, -1, 4);
  sum.add_force(place, force);
  for (const Motion& motion : motions) {
    const Vec3 way = way_of(sum, place, motion);
    CHECK(energy_of(sum, motion) == doctest::Approx(way.dot(stiffness * way) / 2).epsilon(1e-12));
    CHECK(sum.force.dot(motion) == doctest::Approx(force.dot(way)).epsilon(1e-12));
  }
}

}  // namespace
}  // namespace test_rigid_resistance
