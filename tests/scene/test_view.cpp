// The view block reaches ViewSettings, and a view that cannot be drawn is refused.
#include <string>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant_io/scene/scene.h"

namespace test_view {

namespace {

using namespace pliant;

Scene with_view(const std::string& view) {
  return parse_scene(
      R"({"pliant": 1, "bodies": [{"mesh": {"shape": "grid"}, "mass": {"total": 1}}], "view": )" + view + "}", {},
      "s.json");
}

std::string message_of(const std::string& view) {
  try {
    with_view(view);
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

TEST_CASE("every key of a view") {
  const ViewSettings view = with_view(R"({
    "camera": {"position": [1, 2, 3], "target": [0, 0, 1], "up": [0, 1, 0], "field_of_view": 55.5},
    "background": "#FF8000", "color": "stretch", "color_range": [0.5, 2], "legend": false, "wind_arrow": false, "front": [0, 0.5, 1],
    "back": "#000000", "shading": "flat", "wireframe": true, "colliders": false, "ground": false, "ground_height": -2,
    "shadow": false, "light": [0, 0, 3], "size": [640, 480]})")
                                .view;
  REQUIRE(view.camera.position.has_value());
  CHECK(*view.camera.position == Vec3(1, 2, 3));
  CHECK(view.camera.target.value_or(Vec3::Zero()) == Vec3(0, 0, 1));
  CHECK(view.camera.field_of_view == 55.5);
  CHECK(view.background.red == 1);
  CHECK(view.background.green == doctest::Approx(128.0 / 255));
  CHECK(view.background.blue == 0);
  REQUIRE(view.front.has_value());
  CHECK(view.front->green == 0.5);
  CHECK(view.color == ColorBy::stretch);
  CHECK(view.color_range.value_or(std::array<Real, 2>{})[1] == 2);
  CHECK_FALSE(view.legend);
  CHECK_FALSE(view.wind_arrow);
  CHECK(view.shading == Shading::flat);
  CHECK(view.wireframe);
  CHECK_FALSE(view.colliders);
  CHECK_FALSE(view.ground);
  CHECK(view.ground_height.value_or(0) == -2);
  CHECK_FALSE(view.shadow);
  CHECK(view.size == std::array<Index, 2>{640, 480});
  CHECK_FALSE(with_view("{}").view.camera.position.has_value());
  CHECK_FALSE(with_view("{}").view.front.has_value());
  CHECK(with_view("{}").view.colliders);
}

TEST_CASE("a camera by its direction, that turns, or goes through keyframes") {
  const Camera turning = with_view(R"({"camera": {"azimuth": 200, "elevation": -10, "turn_rate": -36}})").view.camera;
  CHECK(turning.azimuth == 200);
  CHECK(turning.elevation == -10);
  CHECK(turning.turn_rate == -36);
  CHECK(turning.keyframes.empty());
  const Camera moving = with_view(R"({"camera": {"keyframes": [{"time": 0, "position": [1, 2, 3]},
    {"time": 0.5, "position": [2, 2, 3], "target": [0, 1, 0], "field_of_view": 20}]}})")
                            .view.camera;
  REQUIRE(moving.keyframes.size() == 2);
  CHECK(moving.keyframes[0].position == Vec3(1, 2, 3));
  CHECK_FALSE(moving.keyframes[0].target.has_value());
  CHECK(moving.keyframes[1].time == 0.5);
  CHECK(moving.keyframes[1].target.value_or(Vec3::Zero()) == Vec3(0, 1, 0));
  CHECK(moving.keyframes[1].field_of_view.value_or(0) == 20);
}

TEST_CASE("keys of 0.1.0 are read, with a warning that names both") {
  const auto scene = [](const std::string& view, const SceneOverrides& overrides = {}) {
    return parse_scene(R"({"pliant": 1, "view": )" + view + R"(, "bodies": [{"mesh": {"shape": "chain", "links": 2},
      "mass": {"total": 1}}]})",
                       {}, "s.json", overrides);
  };
  const Scene old = scene(R"({"legend": false, "colour": "speed", "colour_range": [1, 2]})");
  CHECK(old.view.color == ColorBy::speed);
  CHECK(old.view.color_range == std::array<Real, 2>{1, 2});
  CHECK_FALSE(old.view.legend);
  REQUIRE(old.warnings.size() == 2);
  CHECK(old.warnings[0] ==
        "s.json: view.colour: 'colour' is called 'color' now; rename it, since the next version refuses the old name");
  CHECK(old.warnings[1].starts_with("s.json: view.colour_range: 'colour_range' is called 'color_range' now;"));
  CHECK(scene(R"({"color": "speed"})").warnings.empty());
  const Scene set = scene(R"({"color": "speed"})",
                          {.set = {"view.colour=energy", "view.colour_range=[1,3]", "view.colour_range[0]=2"}});
  CHECK(set.view.color == ColorBy::energy);
  CHECK(set.view.color_range == std::array<Real, 2>{2, 3});
  REQUIRE(set.warnings.size() == 3);
  CHECK(set.warnings[0].starts_with("--set view.colour=energy: 'colour' is called 'color' now;"));
  CHECK(scene(R"({"color": "speed"})", {.set = {R"(view={"colour": "energy"})"}}).view.color == ColorBy::energy);
  CHECK_THROWS_WITH(
      scene(R"({"colour": "red"})"),
      "s.json: view.colour: unknown choice 'red'; known: none, stretch, energy, speed, gap, contact_force");
  CHECK_THROWS_WITH(scene(R"({"colour": "speed", "color": "speed"})"),
                    "s.json: view.colour: 'colour' is called 'color' now, and both stand here; keep 'color'");
  CHECK_THROWS_AS(scene(R"({"colours": "speed"})"), Error);
}

TEST_CASE("a view that cannot be drawn") {
  const auto check = [](const std::string& view, const std::string& start) {
    CAPTURE(message_of(view));
    CHECK(message_of(view).starts_with("s.json: view" + start));
  };
  check(R"({"colr": "stretch"})", ".colr: unknown key; did you mean 'color'? (known: ");
  check(R"({"color": "red"})", ".color: unknown choice 'red'; known: none, ");
  check(R"({"background": "red"})", ".background: is not a color");
  check(R"({"background": "#12345g"})", ".background: is not a color");
  check(R"({"background": [0, 0, 2]})", ".background[2]: is not a color");
  check(R"({"background": [0, 0]})", ".background: the list has 2 entries");
  check(R"({"camera": {"up": [0, 0, 0]}})", ".camera.up: the direction has length 0");
  check(R"({"light": [0, 0, 0]})", ".light: the direction has length 0");
  check(R"({"camera": {"field_of_view": 180}})", ".camera.field_of_view: 180 is out of range");
  check(R"({"camera": {"position": [1, 1, 1], "target": [1, 1, 1]}})", ".camera: the camera stands at its target");
  check(R"({"camera": {"position": [0, 0, 9], "target": [0, 0, 1]}})", ".camera: the camera looks along its up");
  check(R"({"camera": {"positon": [0, 0, 9]}})", ".camera.positon: unknown key");
  check(R"({"camera": {"elevation": 90}})", ".camera.elevation: 90 is out of range");
  check(R"({"camera": {"position": [1, 1, 1], "azimuth": 20}})",
        ".camera.azimuth: 'position' says already where the camera is; keep one of the two, or replace the whole "
        "'camera'");
  const std::string here = R"({"time": 0, "position": [1, 1, 1]})";
  check(R"({"camera": {"turn_rate": 5, "keyframes": [)" + here + "]}}",
        ".camera.turn_rate: 'keyframes' says already where the camera is");
  check(R"({"camera": {"keyframes": {}}})", ".camera.keyframes: found an object; give a list");
  check(R"({"camera": {"keyframes": [{"time": 1}]}})", ".camera.keyframes[0]: the key 'position' is missing");
  check(R"({"camera": {"keyframes": [{"position": [0, 0, 1]}]}})", ".camera.keyframes[0]: the key 'time' is missing");
  check(R"({"camera": {"keyframes": [{"time": 1, "position": [0, 0, 1], "fov": 3}]}})",
        ".camera.keyframes[0].fov: unknown key");
  check(R"({"camera": {"keyframes": [)" + here + ", " + here + "]}}",
        ".camera.keyframes[1].time: 0 s is not later than the keyframe before, 0 s; give them in order of time");
  check(R"({"camera": {"target": [1, 1, 1], "keyframes": [)" + here + "]}}",
        ".camera.keyframes[0]: the camera stands at its target");
  check(R"({"color_range": [2, 1]})", ".color_range: the first value is not below the second");
  check(R"({"wireframe": 1})", ".wireframe: found a number; give true or false");
  check(R"({"size": [10, 480]})", ".size[0]: 10 is out of range");
  check("[]", ": found ");
}

}  // namespace

}  // namespace test_view
