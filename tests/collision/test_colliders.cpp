// The shapes of colliders: distances that are distances, with their gradients, and what is refused.
#include <doctest/doctest.h>

#include "../core/random.h"
#include "pliant/collision/colliders/builtin.h"

namespace test_colliders {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// One of each type, and the special cases of each.
std::vector<PlacedShape> shapes() {
  return {build(PlaneCollider{.position = {0.1, 0.2, 0.3}, .normal = {1, -2, 0.5}}),
          build(PlaneCollider{.normal = {0, 0, -1}}),
          build(SphereCollider{.center = {0.2, -0.1, 0}, .radius = 0.7}),
          build(CapsuleCollider{.from = {-0.4, 0.1, 0}, .to = {0.5, 0.3, 0.2}, .radius = 0.25}),
          build(CapsuleCollider{.from = {0.1, 0.1, 0.1}, .to = {0.1, 0.1, 0.1}, .radius = 0.5}),
          build(BoxCollider{.size = {1, 0.6, 0.4}, .rotation = {30, 20, -50}}),
          build(BoxCollider{.size = {1, 0.6, 0.4}, .rounding = 0.15}),
          build(BoxCollider{.size = {0.5, 0.5, 0.5}, .rounding = 0.25})};
}

Vec3 point_near(Random& random) {
  return random.positions(1, 1.2).row(0).transpose();
}

std::string refusal(const auto& options) {
  try {
    build(options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("colliders: the normal is the gradient of the distance, of length 1, inside and outside") {
  Random random;
  for (const PlacedShape& placed : shapes()) {
    CAPTURE(std::string(placed.shape->type()));
    for (int i = 0; i < 300; ++i) {
      const Vec3 x = point_near(random);
      const SignedDistance found = placed.shape->distance(x);
      CHECK(found.normal.norm() == doctest::Approx(1).epsilon(1e-12));
      constexpr Real step = 1e-6;
      Vec3 slope;
      Real kink = 0;  // where an axis of symmetry lies between, the gradient is of no use
      for (int a = 0; a < 3; ++a) {
        const Vec3 by = step * Vec3::Unit(a);
        const SignedDistance up = placed.shape->distance(x + by);
        const SignedDistance down = placed.shape->distance(x - by);
        slope[a] = (up.distance - down.distance) / (2 * step);
        kink = std::max(kink, (up.normal - down.normal).norm());
      }
      if (kink < 0.01) CHECK((slope - found.normal).norm() < 1e-4);
    }
  }
}

TEST_CASE("colliders: the surface is as far as the distance says, along the normal") {
  Random random;
  for (const PlacedShape& placed : shapes()) {
    CAPTURE(std::string(placed.shape->type()));
    for (int i = 0; i < 300; ++i) {
      const Vec3 x = point_near(random);
      const SignedDistance found = placed.shape->distance(x);
      const Vec3 nearest = x - found.distance * found.normal;
      CHECK(placed.shape->distance(nearest).distance == doctest::Approx(0).epsilon(1e-9));
      const Vec3 y = point_near(random);
      CHECK(std::abs(found.distance - placed.shape->distance(y).distance) <= (x - y).norm() + 1e-12);
      // Convex: in the middle between two points never further than the mean.
      CHECK(placed.shape->distance((x + y) / 2).distance <=
            (found.distance + placed.shape->distance(y).distance) / 2 + 1e-12);
    }
  }
}

TEST_CASE("colliders: known distances, from where they were put") {
  const auto at = [](const PlacedShape& placed, const Vec3& x) {
    return placed.shape->distance(placed.pose.to_frame(x)).distance;
  };
  const PlacedShape plane = build(PlaneCollider{.position = {0, 0, 1}, .normal = {0, 3, 0}});
  CHECK(at(plane, {7, 2, -5}) == doctest::Approx(2));
  CHECK(at(plane, {7, -2, -5}) == doctest::Approx(-2));
  const PlacedShape sphere = build(SphereCollider{.center = {1, 2, 3}, .radius = 0.5});
  CHECK(at(sphere, {1, 2, 5}) == doctest::Approx(1.5));
  CHECK(at(sphere, {1, 2, 3}) == doctest::Approx(-0.5));
  const PlacedShape capsule = build(CapsuleCollider{.from = {0, 0, 0}, .to = {2, 0, 0}, .radius = 0.1});
  CHECK(at(capsule, {1, 0.5, 0}) == doctest::Approx(0.4));
  CHECK(at(capsule, {3, 0, 0}) == doctest::Approx(0.9));
  const PlacedShape box = build(BoxCollider{.center = {0, 0, 1}, .size = {2, 4, 6}, .rotation = {0, 0, 90}});
  CHECK(at(box, {3, 0, 1}) == doctest::Approx(1));  // turned: 4 m along x
  CHECK(at(box, {0, 0, 1}) == doctest::Approx(-1));
  const PlacedShape rounded = build(BoxCollider{.size = {2, 2, 2}, .rounding = 0.5});
  CHECK(at(rounded, {1, 1, 1}) == doctest::Approx(std::sqrt(0.75) - 0.5));
}

TEST_CASE("colliders: what they refuse is named") {
  CHECK(refusal(SphereCollider{.radius = 0}) == "sphere: radius: 0 is out of range; give a finite number above 0 [m]");
  CHECK(refusal(SphereCollider{.radius = -1}).find("radius: -1") != std::string::npos);
  CHECK(refusal(SphereCollider{.radius = std::nan("")}).find("radius") != std::string::npos);
  CHECK(refusal(CapsuleCollider{.radius = -0.1}).find("capsule: radius") != std::string::npos);
  CHECK(refusal(PlaneCollider{.normal = {0, 0, 0}}) == "plane: normal: its length is zero; give a direction");
  CHECK(refusal(BoxCollider{.size = {1, 0, 1}}).find("box: size") != std::string::npos);
  CHECK(refusal(BoxCollider{.size = {1, 0.5, 1}, .rounding = 0.3}) ==
        "box: rounding: 0.3 is more than half of the least size; give at most 0.25 [m]");
  CHECK(refusal(SphereCollider{.friction = -1}).find("friction: -1") != std::string::npos);
  CHECK(refusal(SphereCollider{.velocity = {std::numeric_limits<Real>::infinity(), 0, 0}}).find("velocity") !=
        std::string::npos);
  CHECK(refusal(SphereCollider{.radius = 1e300}).empty());
}

TEST_CASE("poses: there and back, on the way between two, and on with velocities") {
  const Pose turned = moved_on({{1, 2, 3}}, {0.5, 0, 0}, {0, 0, 2}, 0.25);
  CHECK((turned.position - Vec3(1.125, 2, 3)).norm() < 1e-15);
  CHECK((turned.rotation * Vec3(1, 0, 0) - Vec3(std::cos(0.5), std::sin(0.5), 0)).norm() < 1e-15);
  CHECK((turned.to_frame(turned.to_space({4, 5, 6})) - Vec3(4, 5, 6)).norm() < 1e-14);
  const Pose half = interpolate({{1, 2, 3}}, turned, 0.5);
  CHECK((half.rotation * Vec3(1, 0, 0) - Vec3(std::cos(0.25), std::sin(0.25), 0)).norm() < 1e-14);
  CHECK(interpolate({}, turned, 1) == turned);
}

}  // namespace test_colliders
