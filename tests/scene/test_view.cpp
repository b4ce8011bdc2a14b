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
    "background": "#FF8000", "color": "stretch", "color_range": [0.5, 2], "legend": false, "front": [0, 0.5, 1],
    "back": "#000000", "shading": "flat", "wireframe": true, "ground": false, "ground_height": -2, "shadow": false,
    "light": [0, 0, 3], "size": [640, 480]})")
                                .view;
  REQUIRE(view.camera.position.has_value());
  CHECK(*view.camera.position == Vec3(1, 2, 3));
  CHECK(view.camera.target.value_or(Vec3::Zero()) == Vec3(0, 0, 1));
  CHECK(view.camera.field_of_view == 55.5);
  CHECK(view.background.red == 1);
  CHECK(view.background.green == doctest::Approx(128.0 / 255));
  CHECK(view.background.blue == 0);
  CHECK(view.front.green == 0.5);
  CHECK(view.color == ColorBy::stretch);
  CHECK(view.color_range.value_or(std::array<Real, 2>{})[1] == 2);
  CHECK_FALSE(view.legend);
  CHECK(view.shading == Shading::flat);
  CHECK(view.wireframe);
  CHECK_FALSE(view.ground);
  CHECK(view.ground_height.value_or(0) == -2);
  CHECK_FALSE(view.shadow);
  CHECK(view.size == std::array<Index, 2>{640, 480});
  CHECK_FALSE(with_view("{}").view.camera.position.has_value());
}

TEST_CASE("a view that cannot be drawn") {
  const auto check = [](const std::string& view, const std::string& start) {
    CAPTURE(message_of(view));
    CHECK(message_of(view).starts_with("s.json: view" + start));
  };
  check(R"({"color": "stretch"})", ".color: unknown key; known here, the nearest first: color");
  check(R"({"color": "red"})", ".color: 'red' is none of the choices");
  check(R"({"background": "red"})", ".background: is not a color");
  check(R"({"background": "#12345g"})", ".background: is not a color");
  check(R"({"background": [0, 0, 2]})", ".background[2]: is not a color");
  check(R"({"background": [0, 0]})", ".background: the list has 2 entries");
  check(R"({"camera": {"up": [0, 0, 0]}})", ".camera.up: a direction of length 0");
  check(R"({"light": [0, 0, 0]})", ".light: a direction of length 0");
  check(R"({"camera": {"field_of_view": 180}})", ".camera.field_of_view: 180 is out of range");
  check(R"({"camera": {"position": [1, 1, 1], "target": [1, 1, 1]}})", ".camera: the camera stands at its target");
  check(R"({"camera": {"position": [0, 0, 9], "target": [0, 0, 1]}})", ".camera: the camera looks along its up");
  check(R"({"camera": {"positon": [0, 0, 9]}})", ".camera.positon: unknown key");
  check(R"({"color_range": [2, 1]})", ".color_range: the first value is not below the second");
  check(R"({"wireframe": 1})", ".wireframe: found a number; give true or false");
  check(R"({"size": [10, 480]})", ".size[0]: 10 is out of range");
  check("[]", ": found ");
}

}  // namespace

}  // namespace test_view
