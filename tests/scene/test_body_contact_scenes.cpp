// The contact of a body in scene files: what it is read as, what events make of it, what is refused and how.
#include <array>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant/pliant.h"
#include "pliant_io/scene/scene.h"

namespace test_body_contact_scenes {

using namespace pliant;
using namespace pliant_tests;

namespace {

std::string scene_text(const std::string& shirt, const std::string& events = "") {
  const std::string rest = R"("mesh": {"shape": "grid", "columns": 3, "rows": 3, "plane": "xy"}, "mass": {"total": 1},
    "constraints": [{"type": "edge_spring"}])";
  return R"({"pliant": 1, "contact": {"surfaces": true, "friction": 0.2}, "bodies": [
    {"name": "shirt", )" +
         rest + R"(, "contact": )" + shirt + R"(},
    {"name": "skin", "transform": {"translate": [0, 0, 1]}, )" +
         rest + R"(},
    {"name": "hat", "transform": {"translate": [0, 0, 2]}, )" +
         rest + R"(}], "events": [)" + events + "]}";
}

Scene scene_with(const std::string& shirt, const std::string& events = "") {
  return parse_scene(scene_text(shirt, events), {}, "s.json");
}

BodyContact shirt_of(const Scene& scene) {
  return scene.simulation.contact(BodyId{0});
}

void check_refused(const std::string& shirt, const std::string& events, const std::string& expected) {
  const std::string message = error_of([&] { scene_with(shirt, events); });
  CAPTURE(message);
  CHECK(message.starts_with("s.json: " + expected));
  CHECK(message.find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("contact of a body in a scene: its keys, and bodies that come later in the file") {
  CHECK(shirt_of(scene_with("{}")) == BodyContact{});
  const Scene scene = scene_with(R"({"distance": 0.004, "friction": 0.5, "self": false, "ignores": ["skin", "hat"]})");
  CHECK(shirt_of(scene) ==
        BodyContact{.distance = 0.004, .friction = 0.5, .self = false, .ignores = {BodyId{1}, BodyId{2}}});
  CHECK(scene.simulation.contact(BodyId{1}) == BodyContact{});
  CHECK(scene.simulation.contact_distance(BodyId{0}) == 0.004);
  CHECK(scene.has_surfaces);
  const std::vector<std::string> set = {"bodies[shirt].contact.friction=0", "bodies[hat].contact.ignores=[\"skin\"]"};
  const Scene changed = parse_scene(scene_text("{}"), {}, "s.json", {.set = set});
  CHECK(shirt_of(changed).friction == 0.0);
  CHECK(changed.simulation.contact(BodyId{2}).ignores == std::vector{BodyId{1}});
}

TEST_CASE("contact of a body in a scene: an event changes what it names, and no more") {
  Scene scene = scene_with(R"({"distance": 0.004, "ignores": ["skin"]})", R"(
    {"step": 1, "body": "shirt", "contact": {"friction": 0.7, "self": false}},
    {"step": 2, "body": "shirt", "contact": {"ignores": ["hat"]}},
    {"step": 3, "contact": {"friction": 0.9, "surfaces": false}})");
  scene.step();
  CHECK(shirt_of(scene) == BodyContact{.distance = 0.004, .ignores = {BodyId{1}}});
  scene.step();
  CHECK(shirt_of(scene) == BodyContact{.distance = 0.004, .friction = 0.7, .self = false, .ignores = {BodyId{1}}});
  CHECK(scene.simulation.contact().friction == 0.2);
  scene.step();
  CHECK(shirt_of(scene) == BodyContact{.distance = 0.004, .friction = 0.7, .self = false, .ignores = {BodyId{2}}});
  scene.step();
  CHECK(shirt_of(scene).friction == 0.7);
  CHECK(scene.simulation.contact().friction == 0.9);
  CHECK_FALSE(scene.simulation.contact().surfaces);
}

TEST_CASE("contact of a scene lets surfaces touch, unless it says otherwise; events and --set as well") {
  const std::string start = R"({"pliant": 1, "bodies": [{"mesh": {"shape": "grid"}, "mass": {"total": 1}}])";
  const std::string floor = R"(, "colliders": [{"type": "plane"}])";
  const auto touches = [&](const std::string& rest, const std::vector<std::string>& set = {}) {
    Scene scene = parse_scene(start + rest + "}", {}, "s.json", {.set = set});
    const bool at_start = scene.simulation.contact().surfaces;
    for (int i = 0; i < 3; ++i) scene.step();
    CHECK(scene.has_surfaces == (at_start || scene.simulation.contact().surfaces));
    return std::array{at_start, scene.simulation.contact().surfaces};
  };
  const std::array on{true, true}, off{false, false}, later{false, true};
  CHECK(touches(R"(, "contact": {})") == on);
  CHECK(touches(R"(, "contact": {"friction": 0.5})" + floor) == on);
  CHECK(touches(R"(, "contact": {"friction": 0.5, "surfaces": false})" + floor) == off);
  CHECK(touches(floor) == off);
  CHECK(touches("") == off);
  // What an event does not name stays as it is.
  CHECK(touches(floor + R"(, "events": [{"step": 1, "contact": {"friction": 0.1}}])") == off);
  CHECK(touches(R"(, "contact": {}, "events": [{"step": 1, "contact": {"friction": 0.1}}])") == on);
  CHECK(touches(floor + R"(, "events": [{"step": 1, "contact": {"surfaces": true}}])") == later);
  CHECK(touches(floor, {"contact.friction=0.1"}) == on);  // as if it stood in the file
  CHECK(touches(floor, {"contact.friction=0.1", "contact.surfaces=false"}) == off);
  CHECK(touches("", {"contact.surfaces=true"}) == on);
}

TEST_CASE("contact of a body in a scene: an event that lets surfaces touch is known beforehand") {
  const std::string text = R"({"pliant": 1, "bodies": [{"mesh": {"shape": "grid"}, "mass": {"total": 1}}],
    "events": [{"step": 1, "contact": {"surfaces": )";
  CHECK(parse_scene(text + "true}}]}", {}, "s.json").has_surfaces);
  CHECK_FALSE(parse_scene(text + "false}}]}", {}, "s.json").has_surfaces);
}

TEST_CASE("contact of a body in a scene: what is refused, with its place and a near name") {
  check_refused(R"({"ignores": ["skim"]})", "",
                "bodies[0].contact.ignores[0]: unknown body 'skim'; did you mean 'skin'?");
  check_refused(R"({"ignores": ["skin", "shirt"]})", "", "bodies[0].contact.ignores[1]: this is the body itself");
  check_refused(R"({"ignores": "skin"})", "", "bodies[0].contact.ignores: ");
  check_refused(R"({"ignores": [1]})", "", "bodies[0].contact.ignores[0]: ");
  check_refused(R"({"distance": -0.1})", "", "bodies[0].contact.distance: -0.1 is out of range");
  check_refused(R"({"friction": -1})", "", "bodies[0].contact.friction: -1 is out of range");
  check_refused(R"({"friction": "ice"})", "", "bodies[0].contact.friction: ");
  check_refused(R"({"self": 0})", "", "bodies[0].contact.self: ");
  check_refused(R"({"selfs": true})", "", "bodies[0].contact.selfs: unknown key; did you mean 'self'?");
  check_refused("{}", R"({"step": 1, "body": "shirts", "contact": {"self": false}})",
                "events[0].body: unknown body 'shirts'; did you mean 'shirt'?");
  check_refused("{}", R"({"step": 1, "body": "shirt", "contact": {}})", "events[0].contact: no setting is given");
  check_refused("{}", R"({"step": 1, "body": "shirt", "contact": {"surfaces": true}})",
                "events[0].contact.surfaces: unknown key");
  check_refused("{}", R"({"step": 1, "body": "shirt", "contact": {"ignores": ["shirt"]}})",
                "events[0].contact.ignores[0]: this is the body itself");
}

}  // namespace test_body_contact_scenes
