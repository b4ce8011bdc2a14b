// The energies of contact: smooth where it begins, and forces that are minus their gradient.
#include <doctest/doctest.h>

#include "../core/random.h"
#include "pliant/collision/colliders/builtin.h"
#include "pliant/collision/contact/contact.h"
#include "pliant/collision/contact/potential.h"

namespace test_contact_forces {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// Contact of a few vertices with one collider in a step, without a solver.
struct Rig {
  Rig(const PlacedShape& placed, Positions begin_at, Real friction) : begin(std::move(begin_at)) {
    const auto count = static_cast<std::size_t>(begin.rows());
    masses.assign(count, 0.02);
    radii.assign(count, 0.1);
    pinned.assign(count, 0);
    contact.set_colliders(
        {{.shape = placed.shape.get(), .friction = friction, .begin = placed.pose, .end = placed.pose}});
    state.colliders = {{0, placed.pose}};
  }
  void begin_at(Positions& q) { contact.begin_substep(step(), state, q, threads); }
  ContactStep step() const { return {begin, masses, radii, pinned, {}, 1.0 / 60}; }
  /// Of forces and energy at q.
  ContactSums add(const Positions& q, Positions& forces) {
    forces.setZero(q.rows(), 3);
    contact.find_forces(q, threads);
    return contact.add(forces, threads);
  }

  Positions begin;
  std::vector<Real> masses, radii;
  std::vector<char> pinned;
  ContactState state;
  Contact contact;
  ThreadPool threads{1};
};

std::vector<PlacedShape> some_shapes() {
  return {build(PlaneCollider{.normal = {1, 2, 3}}), build(SphereCollider{.radius = 0.7}),
          build(CapsuleCollider{.from = {-0.4, 0, 0}, .to = {0.5, 0.3, 0}, .radius = 0.25}),
          build(BoxCollider{.size = {1, 0.6, 0.4}, .rotation = {30, 20, -50}}),
          build(BoxCollider{.size = {1, 0.6, 0.4}, .rounding = 0.15})};
}

/// Points within a contact distance of the surface, on both sides of it.
Positions points_near_surface(const ColliderShape& shape, const Pose& pose, Random& random, Index count) {
  Positions points(count, 3);
  for (Index i = 0; i < count; ++i) {
    const Vec3 x = random.positions(1, 1).row(0).transpose();
    const SignedDistance found = shape.distance(x);
    const Real at = 0.099 - 0.15 * static_cast<Real>(i) / static_cast<Real>(count);
    points.row(i) = pose.to_space(x + (at - found.distance) * found.normal).transpose();
  }
  return points;
}

/// Of the differences of energy against the forces at q, the largest; where the normal jumps there is none.
Real largest_error(Rig& rig, const Positions& q) {
  Positions forces, unused;
  rig.add(q, forces);
  Real largest = 0;
  for (Index i = 0; i < q.rows(); ++i) {
    for (int a = 0; a < 3; ++a) {
      constexpr Real step = 1e-6;
      Positions up = q, down = q;
      up(i, a) += step;
      down(i, a) -= step;
      Positions forces_up, forces_down;
      const Real slope = (rig.add(up, forces_up).energy - rig.add(down, forces_down).energy) / (2 * step);
      if ((forces_up - forces_down).norm() > 1e-2 * (1 + forces.norm())) continue;
      largest = std::max(largest, std::abs(slope + forces(i, a)));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("contact potential: value and slope are continuous where contact begins, and at the surface") {
  for (const Real at : {0.1, 0.0}) {
    const Potential below = normal_potential(500, 0.1, at - 1e-9);
    const Potential above = normal_potential(500, 0.1, at + 1e-9);
    CHECK(below.energy == doctest::Approx(above.energy).epsilon(1e-6));
    CHECK(std::abs(below.force - above.force) < 2e-6);
  }
  CHECK(normal_potential(500, 0.1, 0.1).energy == 0);
  CHECK(normal_potential(500, 0.1, 0.2).force == 0);
  CHECK(normal_potential(500, 0.1, -0.1).force == doctest::Approx(100));
}

TEST_CASE("friction potential: value and slope are continuous where it begins to slide") {
  const Vec3 along = Vec3(2, -1, 2) / 3;
  const Friction below = friction_potential(500, 2, (0.004 - 1e-12) * along);
  const Friction above = friction_potential(500, 2, (0.004 + 1e-12) * along);
  CHECK(below.energy == doctest::Approx(above.energy).epsilon(1e-9));
  CHECK((below.force + 2 * along).norm() < 1e-8);
  CHECK((above.force + 2 * along).norm() < 1e-14);
  CHECK(below.curvature == 500);
  CHECK(above.curvature == doctest::Approx(500).epsilon(1e-6));
  CHECK(friction_potential(500, 2, along).energy == doctest::Approx(2 - 4.0 / 1000));
  CHECK(friction_potential(500, 2, Vec3::Zero()).force == Vec3::Zero());
}

TEST_CASE("contact: forces are minus the gradient of the energy, for every collider") {
  Random random;
  for (const PlacedShape& placed : some_shapes()) {
    CAPTURE(std::string(placed.shape->type()));
    const Positions q = points_near_surface(*placed.shape, placed.pose, random, 24);
    Rig rig(placed, q, 0);
    Positions start = q;
    rig.begin_at(start);
    Positions forces;
    CHECK(rig.add(q, forces).energy > 0);
    CHECK(largest_error(rig, q) < 1e-5 * forces.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("contact: with friction of frozen load as well, sticking and sliding") {
  Random random;
  for (const PlacedShape& placed : some_shapes()) {
    for (const Real way : {1e-4, 3e-2}) {
      CAPTURE(std::string(placed.shape->type()));
      CAPTURE(way);
      const Positions begin = points_near_surface(*placed.shape, placed.pose, random, 24);
      Positions q = begin + way * random.positions(24, 1);
      Rig rig(placed, begin, 0.5);
      rig.begin_at(q);
      Positions forces;
      const Real without = rig.add(q, forces).energy;
      const ContactSums sums = rig.contact.refresh(forces, rig.threads);
      CHECK(sums.energy > without);
      Positions again;
      CHECK(rig.add(q, again).energy == doctest::Approx(sums.energy).epsilon(1e-12));
      CHECK((again - forces).cwiseAbs().maxCoeff() < 1e-12 * forces.cwiseAbs().maxCoeff());
      CHECK(largest_error(rig, q) < 2e-5 * forces.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("contact: the curvature is that of the energy, from above, and D is above it") {
  Random random;
  for (const PlacedShape& placed : some_shapes()) {
    CAPTURE(std::string(placed.shape->type()));
    const Positions begin = points_near_surface(*placed.shape, placed.pose, random, 24);
    Positions q = begin + 1e-3 * random.positions(24, 1);
    Rig rig(placed, begin, 0.5);
    rig.begin_at(q);
    Positions forces;
    rig.add(q, forces);
    rig.contact.refresh(forces, rig.threads);
    rig.add(q, forces);
    std::vector<Real> diagonal(24, 0);
    rig.contact.add_diagonal(diagonal);
    for (int i = 0; i < 20; ++i) {
      const Positions p = random.positions(24, 1);
      const Real curvature = rig.contact.curvature(p);
      Real above = 0;
      for (Index v = 0; v < 24; ++v) above += diagonal[at(v)] * p.row(v).squaredNorm();
      CHECK(curvature > 0);
      CHECK(curvature <= above * (1 + 1e-12));
    }
  }
}

TEST_CASE("contact: nothing is left deeper than a twentieth of the contact distance outside") {
  Random random;
  for (const PlacedShape& placed : some_shapes()) {
    CAPTURE(std::string(placed.shape->type()));
    Positions begin = points_near_surface(*placed.shape, placed.pose, random, 24);
    for (Index i = 0; i < 24; ++i) {  // all outside to begin with
      const Vec3 x = placed.pose.to_frame(row(begin, i));
      const SignedDistance found = placed.shape->distance(x);
      begin.row(i) = placed.pose.to_space(x + (0.2 - found.distance) * found.normal).transpose();
    }
    Rig rig(placed, begin, 0.5);
    Positions q = begin;
    rig.begin_at(q);
    CHECK((q - begin).cwiseAbs().maxCoeff() == 0);
    for (int i = 0; i < 20; ++i) {
      q = begin + random.positions(24, 3);
      rig.contact.hold_back(q, rig.threads);
      for (Index v = 0; v < 24; ++v) {
        CHECK(placed.shape->distance(placed.pose.to_frame(row(q, v))).distance > 0.05 * 0.1 - 1e-9);
      }
    }
  }
}

}  // namespace test_contact_forces
