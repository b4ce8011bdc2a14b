#include <doctest/doctest.h>

#include "../core/random.h"
#include "render/camera.h"

namespace test_camera {

using namespace pliant_render;
using pliant_tests::Random;

namespace {

Vec3f vector_of(Random& random, pliant::Real size) {
  return random.vector(size).cast<float>();
}

Bounds random_box(Random& random) {
  Bounds bounds;
  const Vec3f middle = vector_of(random, 5);
  for (int i = 0; i < 3; ++i) bounds.add(middle + vector_of(random, std::pow(10.0, random.uniform(-2, 2))));
  return bounds;
}

/// Normalized device coordinates of a point, from -1 to 1 where it is in the picture.
Vec3f project(const Viewpoint& view, float aspect, const Vec3f& point) {
  const Eigen::Vector4f clip = view.projection(aspect) * view.view() * point.homogeneous();
  REQUIRE(clip.w() > 0);
  return clip.head<3>() / clip.w();
}

/// Of all corners of the box.
Bounds in_picture(const Viewpoint& view, float aspect, const Bounds& box) {
  Bounds seen;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3f p = box.low;
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) != 0) p[axis] = box.high[axis];
    }
    seen.add(project(view, aspect, p));
  }
  return seen;
}

}  // namespace

TEST_CASE("an automatic camera has the whole box in the picture, and fills it in one direction") {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const Bounds box = random_box(random);
    const auto aspect = static_cast<float>(random.uniform(0.4, 2.5));
    const auto inset = static_cast<float>(random.uniform(0, 0.3));
    pliant::Camera camera;
    camera.field_of_view = random.uniform(10, 90);
    camera.up = i % 3 == 0 ? random.unit_vector() : pliant::Vec3(0, 0, 1);
    const Viewpoint view = place_camera(camera, box, aspect, inset);
    const Bounds seen = in_picture(view, aspect, box);
    CAPTURE(aspect);
    CAPTURE(inset);
    CHECK(seen.low.x() > -1);
    CHECK(seen.high.x() < 1 - 2 * inset);
    CHECK(seen.low.y() > -1);
    CHECK(seen.high.y() < 1);
    CHECK(seen.low.z() > -1);
    CHECK(seen.high.z() < 1);
    const bool fills_width = seen.high.x() - seen.low.x() > 0.85F * 2 * (1 - inset);
    const bool fills_height = seen.high.y() - seen.low.y() > 0.85F * 2;
    CHECK((fills_width || fills_height));
    CHECK(view.up.norm() == doctest::Approx(1));
    CHECK(std::abs(view.up.dot(view.forward())) < 1e-5F);
  }
}

TEST_CASE("a camera that the scene places stands there, and what it looks at is in the middle") {
  Random random;
  for (int i = 0; i < 50; ++i) {
    const Bounds box = random_box(random);
    pliant::Camera camera;
    camera.position = random.vector(10);
    camera.target = random.vector(10);
    const Viewpoint view = place_camera(camera, box, 1.5F);
    CHECK((view.eye - camera.position->cast<float>()).norm() < 1e-5F);
    const Vec3f middle = project(view, 1.5F, camera.target->cast<float>());
    CHECK(std::abs(middle.x()) < 1e-3F);
    CHECK(std::abs(middle.y()) < 1e-3F);
  }
}

TEST_CASE("a target alone is in the middle as well, and nothing is divided by zero") {
  pliant::Camera camera;
  camera.target = pliant::Vec3(1, 2, 3);
  Bounds box;
  box.add({0, 0, 0});
  box.add({1, 1, 1});
  const Vec3f middle = project(place_camera(camera, box, 1), 1, {1, 2, 3});
  CHECK(middle.head<2>().norm() < 1e-4F);

  for (const bool is_empty : {true, false}) {
    Bounds point;
    if (!is_empty) point.add({3, 3, 3});
    CHECK(place_camera({}, point, 1).view().allFinite());
    pliant::Camera on_itself;
    on_itself.position = pliant::Vec3(3, 3, 3);
    on_itself.up = pliant::Vec3(0, 1, 0);
    const Viewpoint view = place_camera(on_itself, point, 1);
    CHECK(view.view().allFinite());
    CHECK(view.projection(1).allFinite());
  }
}

}  // namespace test_camera
