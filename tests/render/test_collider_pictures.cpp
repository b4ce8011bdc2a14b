// Colliders in pictures: where they are, and where they are not.
#include <optional>

#include <doctest/doctest.h>

#include "pliant/collision/colliders/builtin.h"
#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "render/clip.h"
#include "render/picture_maker.h"

namespace test_collider_pictures {

using namespace pliant_render;
using pliant::ColliderId;
using pliant::Vec3;

namespace {

using Rgb = std::array<int, 3>;

/// A small upright square at the origin, seen from 3 m in front of it, with 40 degrees.
struct Stage {
  pliant::Simulation simulation;
  PictureOptions options;
  std::map<std::string, pliant::ColliderAppearance, std::less<>> looks;

  Stage() {
    pliant::Mesh mesh = pliant::grid({.columns = 5, .rows = 5, .size = {0.2, 0.2}});
    for (pliant::Index i = 0; i < mesh.vertex_count(); ++i) {
      const Vec3 x = mesh.vertices.row(i).transpose();
      mesh.vertices.row(i) << x.x() - 0.1, 0, x.y() + x.z() - 0.1;
    }
    simulation.add_body(mesh, pliant::Mass::total(1));
    options.appearance.size = {320, 240};
    options.appearance.camera.position = Vec3(0, -3, 0);
    options.appearance.camera.target = Vec3(0, 0, 0);
    options.appearance.shadow = options.appearance.ground = false;
  }

  FrameContent frame() const {
    return capture_frame(simulation, make_render_mesh(simulation.bodies()), pliant::ColorBy::none).content;
  }
  /// None where the machine has no OpenGL.
  std::optional<Image> draw() {
    try {
      options.bounds = bounds_of(frame());
      RenderMesh mesh = make_render_mesh(simulation.bodies());
      mesh.looks = body_looks(simulation.bodies(), {}, {}, looks);
      PictureMaker maker(std::move(mesh), options);
      return maker.draw(frame(), {});
    } catch (const pliant::Error& error) {
      MESSAGE("skipped: ", std::string(error.what()));
      return {};
    }
  }
};

/// The pixel at which a point of the plane y = 0 is seen.
Rgb at(const Image& image, double x, double z) {
  const double scale = 120 / std::tan(20 * 3.14159265358979 / 180) / 3;  // pixels per meter
  const auto column = static_cast<std::size_t>(std::lround(159.5 + scale * x));
  const auto row = static_cast<std::size_t>(std::lround(119.5 - scale * z));
  const std::uint8_t* pixel = image.pixels.data() + 3 * (row * static_cast<std::size_t>(image.width) + column);
  return {pixel[0], pixel[1], pixel[2]};
}

int distance(const Rgb& a, const Rgb& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

/// Neither the red of bodies nor the background.
bool is_neutral(const Rgb& color) {
  return color[0] < color[1] && color[1] < color[2] && color[2] - color[0] < 40 && color[2] < 205;
}

}  // namespace

TEST_CASE("a sphere is seen where it is, in its neutral tone, round, and nowhere else") {
  Stage stage;
  const std::optional<Image> without = stage.draw();
  const ColliderId ball = stage.simulation.add(pliant::SphereCollider{.center = {0.6, 0, 0.3}, .radius = 0.3});
  const std::optional<Image> with = stage.draw();
  if (!without || !with) return;
  CHECK(is_neutral(at(*with, 0.6, 0.3)));
  for (const double angle : {0.0, 0.8, 1.6, 2.4, 3.2, 4.0, 4.8, 5.6}) {
    CAPTURE(angle);
    const double c = std::cos(angle), s = std::sin(angle);
    CHECK(is_neutral(at(*with, 0.6 + 0.27 * c, 0.3 + 0.27 * s)));
    CHECK(at(*with, 0.6 + 0.34 * c, 0.3 + 0.34 * s) == at(*without, 0.6 + 0.34 * c, 0.3 + 0.34 * s));
  }
  CHECK(at(*with, 0, 0) == at(*without, 0, 0));  // the body
  CHECK(at(*with, 0, 0)[0] > 2 * at(*with, 0, 0)[2]);
  // Lit from the upper left.
  CHECK(at(*with, 0.5, 0.45)[1] > at(*with, 0.7, 0.1)[1] + 20);

  pliant::State moved = stage.simulation.state();
  moved.contact.colliders.front().pose.position = {-0.6, 0, 0.3};
  stage.simulation.restore(moved);
  CHECK(stage.simulation.pose(ball).position.x() == -0.6);
  const std::optional<Image> after = stage.draw();
  CHECK(is_neutral(at(*after, -0.6, 0.3)));
  CHECK(at(*after, 0.6, 0.3) == at(*without, 0.6, 0.3));
}

TEST_CASE("what is nearer hides what is behind, colliders and bodies alike, turned as the pose says") {
  Stage stage;
  stage.simulation.add(pliant::SphereCollider{.center = {0, 0.5, 0}, .radius = 0.3});
  const std::optional<Image> behind = stage.draw();
  if (!behind) return;
  CHECK_FALSE(is_neutral(at(*behind, 0, 0)));
  CHECK(is_neutral(at(*behind, 0.17, 0)));
  // A bar along x, turned by a right angle about y: it stands.
  stage.simulation.add(
      pliant::BoxCollider{.center = {0, -0.2, 0}, .size = {1.2, 0.1, 0.1}, .rounding = 0.02, .rotation = {0, 90, 0}});
  stage.simulation.add(pliant::CapsuleCollider{.from = {-0.8, 0, -0.5}, .to = {-0.8, 0, 0.5}, .radius = 0.05});
  const std::optional<Image> before = stage.draw();
  CHECK(is_neutral(at(*before, 0, 0)));
  CHECK(is_neutral(at(*before, 0, 0.55)));
  CHECK_FALSE(is_neutral(at(*before, 0.55, 0)));
  CHECK(is_neutral(at(*before, -0.8, 0.5)));
  CHECK_FALSE(is_neutral(at(*before, -0.7, 0.5)));
}

TEST_CASE("a plane is drawn in place of the ground, with a shadow, and not from behind") {
  Stage stage;
  stage.options.appearance.camera.position = Vec3(0, -3, 1);
  stage.options.appearance.light = Vec3(0, -1, 1);
  const std::optional<Image> nothing = stage.draw();
  stage.simulation.add(pliant::PlaneCollider{.position = {0, 0, -0.3}});
  const std::optional<Image> floor = stage.draw();
  stage.options.appearance.ground = true;
  stage.options.ground_height = -0.1F;
  const std::optional<Image> no_second = stage.draw();
  stage.options.appearance.shadow = true;
  const std::optional<Image> shaded = stage.draw();
  stage.options.appearance.camera.position = Vec3(0, -3, -2);
  const std::optional<Image> from_below = stage.draw();
  stage.options.appearance.ground = false;
  stage.simulation.remove(ColliderId{0});
  const std::optional<Image> bare_from_below = stage.draw();
  if (!nothing) return;
  CHECK(distance(at(*nothing, 0.5, -0.5), at(*floor, 0.5, -0.5)) > 40);
  CHECK(floor->pixels == no_second->pixels);
  std::size_t darker = 0;
  for (std::size_t i = 0; i < floor->pixels.size(); i += 3) darker += shaded->pixels[i] + 20 < floor->pixels[i];
  CHECK(darker > 50);  // behind the square
  CHECK(darker < 2000);
  CHECK(from_below->pixels == bare_from_below->pixels);
}

TEST_CASE("colliders have their own colors and finishes, spheres as well as planes, others stay neutral") {
  Stage stage;
  stage.simulation.add(pliant::SphereCollider{.center = {0.6, 0, 0.3}, .radius = 0.3}, "ball");
  stage.simulation.add(pliant::SphereCollider{.center = {-0.6, 0, 0.3}, .radius = 0.3}, "other");
  stage.simulation.add(pliant::PlaneCollider{.position = {0, 0, -0.3}}, "floor");
  stage.options.appearance.camera.position = Vec3(0, -3, 1);
  stage.options.appearance.camera.target = Vec3(0, 0, 0);
  const std::optional<Image> plain = stage.draw();
  stage.looks = {{"ball", {.front = pliant::Color{0.1, 0.7, 0.2}}}, {"floor", {.front = pliant::Color{0.7, 0.5, 0.2}}}};
  const std::optional<Image> colored = stage.draw();
  stage.looks["ball"].finish = pliant::Finish::metal;
  const std::optional<Image> of_metal = stage.draw();
  if (!plain) return;
  const Rgb green = at(*colored, 0.6, 0.3);
  CHECK(green[1] > 2 * green[0]);
  CHECK(green[1] > green[2] + 50);
  CHECK(at(*colored, -0.6, 0.3) == at(*plain, -0.6, 0.3));
  CHECK(is_neutral(at(*colored, -0.6, 0.3)));
  const Rgb wood = at(*colored, 0, -0.6);
  CHECK(std::abs(wood[0] - 178) < 12);  // in full light as it was given
  CHECK(std::abs(wood[1] - 127) < 12);
  CHECK(std::abs(wood[2] - 51) < 12);
  CHECK(distance(at(*of_metal, 0.6, 0.3), green) > 40);
  CHECK(at(*of_metal, -0.6, 0.3) == at(*plain, -0.6, 0.3));
}

TEST_CASE("looks of colliders reach the frames of a scene and of its recorded run") {
  const auto make = [] {
    return pliant::parse_scene(R"({"pliant": 1, "steps": 1, "gravity": null,
      "bodies": [{"mesh": {"shape": "grid", "columns": 3, "rows": 3}, "mass": {"total": 1},
        "constraints": [{"type": "edge_spring", "stiffness": 1}]}],
      "colliders": [{"type": "sphere", "name": "ball", "center": [0, 0, 9], "appearance": {"front": "#ff0000"}}]})",
                               {}, "s.json");
  };
  pliant::Scene live = make();
  const Clip clip = clip_from_scene(live, 1, [](std::int64_t) { return true; });
  REQUIRE(clip.render_mesh.looks.colliders.size() == 1);
  CHECK(clip.render_mesh.looks.colliders.at("ball").tone == Vec3f(1, 0, 0));
  CHECK(clip.frames[0].content.colliders.at(0).name == "ball");
  const std::vector<pliant::Positions> frames = {live.simulation.state().positions};
  const std::vector<pliant::Real> times = {0};
  const pliant::Animation animation = pliant::animate(live.simulation.body(pliant::BodyId{0}).mesh, "run",
                                                      pliant::PointCache::from_frames(frames, times));
  const RunFrames run(animation, annotate_run(make(), animation));
  CHECK(run.render_mesh().looks.colliders == clip.render_mesh.looks.colliders);
}

TEST_CASE("the camera takes colliders into the picture, but for what has no end or dwarfs the bodies") {
  Stage stage;
  const Bounds bodies = bounds_of(stage.frame());
  stage.simulation.add(pliant::PlaneCollider{});
  CHECK(bounds_of(stage.frame()).radius() == bodies.radius());
  stage.simulation.add(pliant::SphereCollider{.center = {0, 0, -100}, .radius = 100});
  CHECK(bounds_of(stage.frame()).radius() == bodies.radius());
  stage.simulation.add(pliant::SphereCollider{.center = {1, 0, 0}, .radius = 0.25});
  const Bounds with = bounds_of(stage.frame());
  CHECK(with.high.x() == doctest::Approx(1.25));
  CHECK(with.low.z() == doctest::Approx(-0.25));
  CHECK(with.low.x() == bodies.low.x());
  CHECK(floor_height(stage.frame().colliders) == 0.0F);
}

TEST_CASE("hidden colliders leave the picture as it is without them, and the camera too") {
  Stage stage;
  stage.options.appearance.camera = {};
  stage.options.appearance.ground = stage.options.appearance.shadow = true;
  stage.options.ground_height = -0.2F;
  const auto draw = [&]() -> std::optional<Image> {
    try {
      stage.options.bounds = bounds_of(stage.frame(), stage.options.appearance);
      PictureMaker maker(make_render_mesh(stage.simulation.bodies()), stage.options);
      return maker.draw(stage.frame(), {});
    } catch (const pliant::Error& error) {
      MESSAGE("skipped: ", std::string(error.what()));
      return {};
    }
  };
  const std::optional<Image> without = draw();
  stage.simulation.add(pliant::SphereCollider{.center = {0.4, 0, 0.1}, .radius = 0.1});
  stage.simulation.add(pliant::PlaneCollider{.position = {0, 0, -0.15}});
  CHECK(stage.frame().colliders.size() == 2);
  const std::optional<Image> shown = draw();
  stage.options.appearance.colliders = false;
  const std::optional<Image> hidden = draw();
  CHECK(bounds_of(stage.frame(), stage.options.appearance).high.x() == doctest::Approx(0.1));
  if (!without) return;
  CHECK(shown->pixels != without->pixels);
  CHECK(hidden->pixels == without->pixels);
}

TEST_CASE("a shape is made into triangles once; another one in its place is another surface") {
  Stage stage;
  const ColliderId ball = stage.simulation.add(pliant::SphereCollider{.radius = 0.3});
  ColliderSurfaces surfaces;
  const auto first = surfaces.find(stage.simulation), second = surfaces.find(stage.simulation);
  REQUIRE(first.size() == 1);
  CHECK(first[0].surface == second[0].surface);
  stage.simulation.replace(ball, pliant::SphereCollider{.radius = 0.4});
  const auto other = surfaces.find(stage.simulation);
  CHECK(other[0].surface != first[0].surface);
  CHECK(other[0].surface->points.front().norm() == doctest::Approx(0.4));
}

TEST_CASE("colliders of a recorded run are where they were when it was simulated") {
  const auto make = [] {
    pliant::Scene scene = pliant::parse_scene(R"({"pliant": 1, "steps": 20, "gravity": [0, 0, 0],
      "bodies": [{"mesh": {"shape": "grid", "columns": 4, "rows": 3}, "mass": {"total": 1},
        "constraints": [{"type": "edge_spring", "stiffness": 100}]}]})",
                                              {}, "s.json");
    scene.simulation.add(pliant::SphereCollider{
        .center = {0, 0, 5}, .radius = 0.2, .velocity = {1, 0, 0.5}, .angular_velocity = {0, 3, 0}});
    scene.simulation.add(pliant::BoxCollider{.center = {0, 0, -5}});
    scene.timeline.add(pliant::When::at_step(8), [](pliant::Simulation& simulation) {
      simulation.set_target(ColliderId{1}, {{1, 2, -6}});
      simulation.add(pliant::CapsuleCollider{.from = {0, 0, 7}, .to = {0, 0, 8}});
    });
    return scene;
  };
  pliant::Scene live = make();
  const Clip clip = clip_from_scene(live, 1, [](std::int64_t) { return true; });
  std::vector<pliant::Positions> frames(clip.frames.size(), live.simulation.state().positions);
  std::vector<pliant::Real> times;
  for (const ClipFrame& frame : clip.frames) times.push_back(frame.time);
  const pliant::Animation animation = pliant::animate(live.simulation.body(pliant::BodyId{0}).mesh, "run",
                                                      pliant::PointCache::from_frames(frames, times));
  const RunFrames run(animation, annotate_run(make(), animation));
  for (std::size_t i = 0; i < run.count(); ++i) {
    CAPTURE(i);
    const auto& wanted = clip.frames[i].content.colliders;
    const auto found = run.frame(i, pliant::ColorBy::none).content.colliders;
    REQUIRE(found.size() == (i < 9 ? 2 : 3));
    REQUIRE(found.size() == wanted.size());
    for (std::size_t c = 0; c < found.size(); ++c) {
      CHECK(found[c].number == wanted[c].number);
      CHECK((found[c].pose.position - wanted[c].pose.position).norm() < 1e-12);
      CHECK(found[c].pose.rotation.angularDistance(wanted[c].pose.rotation) < 1e-7);
    }
  }
  CHECK(run.frame(20, pliant::ColorBy::none).content.colliders[1].pose.position.x() == 1);
}

}  // namespace test_collider_pictures
