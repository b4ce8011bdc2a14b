#include <numbers>
#include <span>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "pliant/mesh/shapes.h"
#include "render/camera_path.h"
#include "render/choose_direction.h"
#include "render/outline.h"

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
    pliant::Camera aimed = camera;
    aimed.target = random.vector(5);
    const Bounds around = in_picture(place_camera(aimed, box, aspect, inset), aspect, box);
    CHECK(around.low.head<2>().minCoeff() > -1);
    CHECK(around.high.x() < 1 - 2 * inset);
    CHECK(around.high.y() < 1);
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

TEST_CASE("what moves through the frames fills the picture, however empty the corners of its box are") {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const Vec3f middle = vector_of(random, 5), half = vector_of(random, std::pow(10.0, random.uniform(-2, 2)));
    const Vec3f across = half.unitOrthogonal() * half.norm() * static_cast<float>(random.uniform(0, 0.5));
    const auto aspect = static_cast<float>(random.uniform(0.4, 2.5));
    Outline outline;
    std::vector<Vec3f> all;
    for (int frame = 0; frame < 4; ++frame) {  // an ellipse, aslant, that gets larger
      FrameContent content;
      for (int k = 0; k < 100; ++k) {
        const float angle = 0.0628F * static_cast<float>(k), size = 0.25F * static_cast<float>(frame + 1);
        content.positions.emplace_back(middle + size * (std::cos(angle) * half + std::sin(angle) * across));
      }
      content.positions.push_back(Vec3f::Constant(std::numeric_limits<float>::infinity()));  // was too far away
      all.insert(all.end(), content.positions.begin(), content.positions.end() - 1);
      outline.add(content, {});
    }
    const Viewpoint view = place_camera({}, outline.bounds(), aspect);
    Bounds seen;
    for (const Vec3f& point : all) seen.add(project(view, aspect, point));
    CHECK(seen.low.head<2>().minCoeff() > -1);
    CHECK(seen.high.head<2>().maxCoeff() < 1);
    const Vec3f size = seen.high - seen.low;
    CHECK(std::max(size.x(), size.y()) > 0.85F * 2);
  }
  CHECK(Outline().bounds().is_empty());
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

TEST_CASE("azimuth and elevation say from where it looks, whatever is up") {
  Bounds box;
  box.add({-1, -1, -1});
  box.add({1, 1, 1});
  pliant::Camera camera;
  const auto from = [&](pliant::Real azimuth, pliant::Real elevation) -> Vec3f {
    camera.azimuth = azimuth;
    camera.elevation = elevation;
    return -place_camera(camera, box, 1).forward();
  };
  CHECK((from(0, 0) - Vec3f(0, -1, 0)).norm() < 1e-5F);
  CHECK((from(90, 0) - Vec3f(1, 0, 0)).norm() < 1e-5F);
  CHECK((from(180, 0) - Vec3f(0, 1, 0)).norm() < 1e-5F);
  CHECK((from(90, 30) - Vec3f(std::sqrt(3.0F) / 2, 0, 0.5F)).norm() < 1e-5F);
  camera.up = pliant::Vec3(0, 2, 0);
  CHECK((from(0, 0) - Vec3f(0, 0, 1)).norm() < 1e-5F);
  CHECK((from(90, 0) - Vec3f(1, 0, 0)).norm() < 1e-5F);
  CHECK(from(0, 80).y() == doctest::Approx(std::sin(80 * std::numbers::pi / 180)));
}

TEST_CASE("a camera that turns keeps its height and distance, has all in the picture, and is back after a turn") {
  Random random;
  for (int i = 0; i < 60; ++i) {
    const Bounds box = random_box(random);
    const auto aspect = static_cast<float>(random.uniform(0.4, 2.5));
    pliant::Camera camera;
    camera.turn_rate = random.uniform(5, 90) * (i % 2 == 0 ? 1 : -1);
    if (i % 3 == 0) camera.up = random.unit_vector();
    const CameraPath path(camera, box, aspect);
    const Vec3f up = camera.up.cast<float>().normalized();
    const Viewpoint start = path.at(0);
    for (const double turn : {0.0, 0.1, 0.25, 0.6}) {
      const Viewpoint view = path.at(360 * turn / std::abs(camera.turn_rate));
      const Bounds seen = in_picture(view, aspect, box);
      CHECK(seen.low.head<2>().minCoeff() > -1);
      CHECK(seen.high.head<2>().maxCoeff() < 1);
      CHECK(seen.low.z() > -1);
      CHECK(seen.high.z() < 1);
      const Vec3f way = view.eye - start.eye;
      CHECK(std::abs(way.dot(up)) < 1e-3F * box.radius());
      CHECK((view.eye - box.center()).norm() == doctest::Approx((start.eye - box.center()).norm()).epsilon(1e-3));
    }
    const Viewpoint end = path.at(360 / camera.turn_rate);
    CHECK((end.eye - start.eye).norm() < 1e-3F * (start.eye - box.center()).norm());
  }
  pliant::Camera camera;
  camera.position = pliant::Vec3(0, -4, 1);
  camera.target = pliant::Vec3(0, 0, 1);
  camera.turn_rate = 45;
  Bounds box;
  box.add({-1, -1, 0});
  box.add({1, 1, 2});
  CHECK((CameraPath(camera, box, 1).at(2).eye - Vec3f(4, 0, 1)).norm() < 1e-4F);
}

TEST_CASE("keyframes are met, nothing swings past them, and it moves smoothly from one to the next") {
  pliant::Camera camera;
  camera.target = pliant::Vec3(0, 0, 0);
  camera.keyframes = {{.time = 1, .position = {0, -4, 1}},
                      {.time = 2, .position = {4, 0, 1}, .field_of_view = 20},
                      {.time = 2.5, .position = {4, 0, 3}, .target = pliant::Vec3(0, 0, 2)},
                      {.time = 6, .position = {9, 0, 3}}};
  Bounds box;
  box.add({-1, -1, -1});
  box.add({1, 1, 1});
  const CameraPath path(camera, box, 1.5F);
  for (const pliant::CameraKeyframe& each : camera.keyframes) {
    const Viewpoint view = path.at(each.time);
    CHECK((view.eye - each.position.cast<float>()).norm() < 1e-5F);
    CHECK((view.target - each.target.value_or(pliant::Vec3::Zero()).cast<float>()).norm() < 1e-5F);
    CHECK(view.field_of_view == doctest::Approx(each.field_of_view.value_or(40) * std::numbers::pi / 180));
  }
  CHECK((path.at(0).eye - path.at(1).eye).norm() == 0);
  CHECK((path.at(60).eye - path.at(6).eye).norm() == 0);
  Vec3f before = path.at(1).eye, step = Vec3f::Zero();
  for (int i = 1; i <= 5000; ++i) {
    const Vec3f eye = path.at(1 + i / 1000.0).eye;
    CHECK_MESSAGE((eye - before - step).norm() < 1e-4F, i);  // the speed has no jumps
    step = eye - before;
    before = eye;
    CHECK_MESSAGE((eye.array() >= Eigen::Array3f(0, -4, 1) && eye.array() <= Eigen::Array3f(9, 0, 3)).all(), i);
  }
}

/// A sheet that stands upright, its normal turned about z from the front by these degrees.
struct Screen {
  RenderMesh render_mesh;
  FrameContent frame;

  explicit Screen(float degrees) {
    pliant::Mesh mesh = pliant::grid({.columns = 5, .rows = 5, .size = {1, 1}});
    const Eigen::Matrix3f turn =
        Eigen::AngleAxisf(degrees * std::numbers::pi_v<float> / 180, Vec3f::UnitZ()).toRotationMatrix();
    for (pliant::Index i = 0; i < mesh.vertex_count(); ++i) {
      const Vec3f x = mesh.vertices.row(i).transpose().cast<float>();
      frame.positions.push_back(turn * Vec3f(x.x() - 0.5F, 0, x.y() + x.z() - 0.5F));
    }
    render_mesh = make_render_mesh({{"sheet", mesh, 0}});
  }

  pliant::Camera choose(const pliant::Camera& camera = {}) const {
    return choose_direction(camera, render_mesh, std::span(&frame, 1), bounds_of(frame.positions), 1.5F);
  }
};

TEST_CASE("an open camera looks from where most of the bodies is seen") {
  CHECK(Screen(24).choose().azimuth == 24.2);
  CHECK(Screen(-24).choose().azimuth == -24.2);
  CHECK(Screen(80).choose().azimuth == 65.8);
  CHECK(Screen(-80).choose().azimuth == -65.8);
  CHECK(Screen(0).choose().azimuth == 24.2);  // as much as from the other side: the first
  CHECK(Screen(0).choose().elevation == 21);

  pliant::Camera given;
  given.elevation = 5;
  CHECK(Screen(-80).choose(given).elevation == 5);
  CHECK_FALSE(Screen(-80).choose(given).azimuth.has_value());
  given = {.position = pliant::Vec3(1, 1, 1)};
  CHECK_FALSE(Screen(-80).choose(given).azimuth.has_value());

  Screen lying(0);
  for (Vec3f& x : lying.frame.positions) x = Vec3f(x.x(), x.z(), 0);
  CHECK(lying.choose().elevation == 38);
}

TEST_CASE("two small bodies count for more than a large one") {
  const pliant::Mesh mesh = pliant::grid({.columns = 5, .rows = 5, .size = {1, 1}});
  Screen all(-65.8F);
  const Screen small(24.2F);
  all.render_mesh = make_render_mesh({{"large", mesh, 0}, {"left", mesh, 25}, {"right", mesh, 50}});
  for (const float z : {0.9F, 1.4F}) {
    for (const Vec3f& x : small.frame.positions) all.frame.positions.push_back(0.3F * x + Vec3f(0, 0, z));
  }
  CHECK(all.choose().azimuth == 24.2);
  for (std::uint32_t i = 25; i < 75; ++i) all.frame.held.push_back(i);
  CHECK(all.choose().azimuth == -65.8);
}

TEST_CASE("a rope of a body that is held does not count") {
  pliant::Mesh rope;
  rope.vertices.resize(2, 3);
  rope.vertices << 0, -1, 0, 0, 1, 0;  // best seen from the right
  rope.edges = {{0, 1}};
  Screen screen(24);
  const pliant::Mesh mesh = pliant::grid({.columns = 5, .rows = 5, .size = {1, 1}});
  screen.render_mesh = make_render_mesh({{"sheet", mesh, 0}, {"rope", rope, 25}});
  screen.frame.positions.insert(screen.frame.positions.end(), {Vec3f(0, -1, 2), Vec3f(0, 1, 2)});
  screen.frame.held = {25, 26};
  CHECK(screen.choose().azimuth == 24.2);
}

TEST_CASE("what is held does not count, and hides what is behind it") {
  Screen screen(-80);
  for (std::uint32_t i = 0; i < screen.frame.positions.size(); ++i) screen.frame.held.push_back(i);
  CHECK(screen.choose().azimuth == 24.2);  // nothing is seen from anywhere

  // A held wall on the right of the sheet, which the first direction looks through.
  Screen both(0), wall(90);
  pliant::Mesh mesh = pliant::grid({.columns = 5, .rows = 5, .size = {1, 1}});
  both.render_mesh = make_render_mesh({{"sheet", mesh, 0}, {"wall", mesh, 25}});
  for (const Vec3f& x : wall.frame.positions) {
    both.frame.held.push_back(static_cast<std::uint32_t>(both.frame.positions.size()));
    both.frame.positions.push_back(x * 1.5F + Vec3f(0.55F, -0.5F, 0));
  }
  CHECK(both.choose().azimuth == -24.2);
}

}  // namespace test_camera
