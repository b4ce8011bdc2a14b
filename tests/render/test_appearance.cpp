// What bodies look like: their colors and patterns, from the scene to the picture.
#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant_io/scene/scene.h"
#include "render/clip.h"
#include "studio.h"

namespace test_appearance {

using namespace pliant_render;
using namespace pliant_tests;
using pliant::BodyAppearance;
using pliant::BodyId;
using pliant::Color;
using pliant::Pattern;

namespace {

const Color green{0.2, 0.7, 0.3}, blue{0.2, 0.3, 0.8}, white{0.95, 0.95, 0.95};

/// None where the machine has no OpenGL.
std::optional<Image> draw(const Studio& studio, const BodyAppearance& appearance) {
  RenderMesh render_mesh = make_render_mesh(studio.bodies);
  render_mesh.looks = body_looks(studio.bodies, {{BodyId{0}, appearance}});
  try {
    return PictureMaker(std::move(render_mesh), studio.options).draw(studio.frame, {});
  } catch (const pliant::Error& error) {
    MESSAGE("skipped: ", std::string(error.what()));
    return {};
  }
}

bool is_green(const Rgb& color) {
  return color[1] > color[0] + 20 && color[1] > color[2] + 20;
}

bool is_white(const Rgb& color) {
  return std::abs(color[0] - color[1]) < 25 && std::abs(color[1] - color[2]) < 25 && color[1] > 90;
}

pliant::Scene scene_with(const std::string& appearance) {
  return pliant::parse_scene(R"({ "pliant": 1, "steps": 3, "bodies": [ { "name": "sheet", "mass": { "total": 1 },
      "mesh": { "shape": "grid", "columns": 3, "rows": 3, "size": [1, 1], "plane": "xz" },
      "appearance": )" + appearance +
                                 R"( }, { "name": "plain", "mass": { "total": 1 },
      "mesh": { "shape": "grid", "columns": 3, "rows": 3 } } ] })",
                             {}, "dressed");
}

}  // namespace

TEST_CASE("a body has the colors of its appearance, on both sides the front's where the back has none") {
  Studio studio;
  const std::optional<Image> image = draw(studio, {.front = green});
  if (!image) return;
  CHECK(is_green(at(*image, 0.1, 0.1)));
  studio.options.appearance.front = Color{0.9, 0.1, 0.1};  // of bodies without an appearance
  CHECK(is_green(at(*draw(studio, {.front = green}), 0.1, 0.1)));
  for (std::uint32_t i = 0; i < 81; ++i) studio.frame.held.push_back(i);
  CHECK(is_green(at(*draw(studio, {.front = green}), 0.1, 0.1)));
  studio.options.appearance.camera.position = pliant::Vec3(0, 3, 0);
  const std::optional<Image> behind = draw(studio, {.front = green});
  CHECK(is_green(at(*behind, 0.1, 0.1)));
  const std::optional<Image> other = draw(studio, {.front = green, .back = blue});
  studio.options.appearance.camera.position = pliant::Vec3(0, -3, 0);
  const std::optional<Image> one = draw(studio, {.front = green, .back = blue});
  CHECK(is_green(at(*one, 0.1, 0.1)) != is_green(at(*other, 0.1, 0.1)));
  // Values are told by the map of colors, whatever the body looks like.
  studio.options.appearance.color = pliant::ColorBy::speed;
  studio.frame.values.assign(81, 0);
  CHECK(difference(*draw(studio, {.front = green}), *studio.draw()) == 0);
}

TEST_CASE("fields of a checker and stripes have their size on the body at rest, and go with it") {
  Studio studio;
  BodyAppearance appearance{.front = green, .pattern = Pattern::checker, .pattern_color = white, .pattern_size = 0.25};
  const std::optional<Image> checker = draw(studio, appearance);
  if (!checker) return;
  appearance.pattern = Pattern::stripes;
  const std::optional<Image> stripes = draw(studio, appearance);
  const double to_u = 0.75 * 1 / (3 * std::tan(20 * 3.14159265358979 / 180)), to_v = to_u / 0.75;
  const auto place = [](double share) { return -0.5 + share - 0.37 * 0.25; };  // fields begin a third before the border
  for (int i = 1; i < 4; ++i) {
    for (int j = 1; j < 4; ++j) {
      CAPTURE(i);
      CAPTURE(j);
      const double u = to_u * place(0.25 * i + 0.125), v = to_v * place(0.25 * j + 0.125);
      const Rgb in_field = at(*checker, u, v), in_stripe = at(*stripes, u, v);
      CHECK(is_white(in_field) != is_green(in_field));
      CHECK(is_white(in_stripe) != is_green(in_stripe));
      if (j > 1) {
        const double below = to_v * place(0.25 * j - 0.125);
        CHECK(is_white(in_field) != is_white(at(*checker, u, below)));
        CHECK(is_white(in_stripe) == is_white(at(*stripes, u, below)));
      }
      if (i > 1) {
        const double left = to_u * place(0.25 * i - 0.125);
        CHECK(is_white(in_field) != is_white(at(*checker, left, v)));
        CHECK(is_white(in_stripe) != is_white(at(*stripes, left, v)));
      }
    }
  }
  // What is smaller than a pixel is their mean, not noise.
  appearance.pattern_size = 1e-5;
  const std::optional<Image> fine = draw(studio, appearance);
  CHECK(distance(at(*fine, 0.1, 0.1), at(*fine, 0.13, 0.12)) < 12);
  // Moved aside, the pattern is where the body is.
  appearance.pattern_size = 0.25;
  studio.options.bounds.add({2, 0, 0});
  const Rgb before = at(*stripes, to_u * place(0.375), 0);
  for (Vec3f& p : studio.frame.positions) p.x() += 0.25F;
  CHECK(is_white(at(*draw(studio, appearance), to_u * (place(0.375) + 0.25), 0)) == is_white(before));
}

TEST_CASE("ropes have the front's color") {
  Studio studio;
  studio.show_rope();
  const std::optional<Image> image = draw(studio, {.front = green});
  if (!image) return;
  CHECK(is_green(at(*image, 0.1, 0)));
}

TEST_CASE("scenes have appearances of bodies, and pictures of scenes and of their runs show them") {
  const pliant::Scene scene =
      scene_with(R"({ "front": "#33b34d", "pattern": "checker", "pattern_color": [1, 1, 1], "pattern_size": 0.2 })");
  REQUIRE(scene.appearances.size() == 1);
  const BodyAppearance& read = scene.appearances.at(BodyId{0});
  CHECK(read.front->green == doctest::Approx(179 / 255.0));
  CHECK_FALSE(read.back.has_value());
  CHECK(read.pattern == Pattern::checker);
  CHECK(read.pattern_size == 0.2);
  const RenderMesh render_mesh = make_render_mesh(scene);
  REQUIRE(render_mesh.looks.vertices.size() == 18);
  CHECK(render_mesh.looks.vertices.front().front[3] == 255);
  CHECK(render_mesh.looks.vertices.front().front[1] == 179);
  CHECK(render_mesh.looks.vertices.back().front[3] == 0);
  CHECK(make_render_mesh(scene_with("{}")).looks.vertices.front().front[3] == 255);
  CHECK(body_looks(scene.simulation.bodies(), {}).vertices.empty());

  const pliant::Animation animation{
      "run",
      scene.simulation.bodies(),
      pliant::PointCache::from_frames(std::array{scene.simulation.state().positions}, {0}),
      {0},
      {}};
  const pliant_render::RunFrames frames(animation, annotate_run(scene_with(R"({ "front": "#33b34d" })"), animation));
  REQUIRE(frames.render_mesh().looks.vertices.size() == 18);
  CHECK(frames.render_mesh().looks.vertices.front().front[1] == 179);
  CHECK(RunFrames(animation).render_mesh().looks.vertices.empty());
}

TEST_CASE("wrong appearances are refused with their place and what would be right") {
  const auto refused = [](const std::string& appearance) { return error_of([&] { scene_with(appearance); }); };
  CHECK(contains(refused(R"({ "colour": "#ffffff" })"), "bodies[0].appearance.colour"));
  CHECK(contains(refused(R"({ "front": "red-ish" })"), "bodies[0].appearance.front"));
  CHECK(contains(refused(R"({ "pattern": "chequer" })"), "checker"));
  CHECK(contains(refused(R"({ "pattern_size": 0 })"), "bodies[0].appearance.pattern_size"));
  CHECK(contains(refused("[]"), "bodies[0].appearance"));
}

}  // namespace test_appearance
