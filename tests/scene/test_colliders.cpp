// Colliders of scene files: each does what the same call would, moves as its path says, and says what is wrong with it.
#include <numbers>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant/collision/colliders/builtin.h"
#include "pliant/pliant.h"
#include "pliant_io/scene/scene.h"
#include "tests/support/temporary_folder.h"

namespace test_colliders {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr std::string_view ball_and_floor = R"("colliders": [
    {"type": "sphere", "name": "ball", "center": [0.5, 0.5, -0.32], "radius": 0.3, "friction": 0.4},
    {"type": "plane", "position": [0, 0, -0.7]}],)";

/// A sheet that falls on a ball and on a floor, in steps of 0.05 s.
std::string scene_text(std::string_view events, std::string_view colliders) {
  return R"({"pliant": 1, "settings": {"time_step": 0.05, "iterations": 6, "threads": 1}, "bodies": [
    {"name": "sheet", "mesh": {"shape": "grid", "columns": 6, "rows": 6, "plane": "xy"}, "mass": {"total": 0.3},
     "constraints": [{"type": "triangle_strain", "name": "skin", "stiffness": 200}]}],)" +
         std::string(colliders) + R"("events": [)" + std::string(events) + "]}";
}

Scene scene_with(std::string_view events, std::string_view colliders = ball_and_floor) {
  return parse_scene(scene_text(events, colliders), {}, "s.json");
}

void add_by_hand(Simulation& simulation) {
  simulation.add(SphereCollider{.center = {0.5, 0.5, -0.32}, .radius = 0.3, .friction = 0.4}, "ball");
  simulation.add(PlaneCollider{.position = {0, 0, -0.7}});
}

ColliderId id(const Simulation& simulation, std::string_view name) {
  const auto found = simulation.find_collider(name);
  REQUIRE(found);
  return *found;
}

/// Compares a run by events with one in which `edit` is made by hand before the step `step`. What it leads to must not
/// be what a run without it does, lest nothing were compared.
void check_same(std::string_view event, int step, const std::function<void(Simulation&)>& edit) {
  CAPTURE(event);
  Scene by_events = scene_with(event);
  Scene by_hand = scene_with("");
  Scene without = scene_with("");
  for (int i = 0; i < 14; ++i) {
    if (i == step) edit(by_hand.simulation);
    by_events.step();
    by_hand.simulation.step();
    without.step();
    CHECK(by_events.simulation.state().positions == by_hand.simulation.state().positions);
  }
  CHECK(by_events.simulation.state().positions != without.simulation.state().positions);
}

void check_refused(std::string_view event, std::string_view colliders, const std::string& start) {
  const std::string message = error_of([&] { scene_with(event, colliders); });
  CAPTURE(message);
  CHECK(message.starts_with("s.json: " + start));
  CHECK(message.find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("colliders of a scene are those of the same calls") {
  Scene scene =
      scene_with("", std::string(R"("contact": {"friction": 0.7, "distance": 0.03},)").append(ball_and_floor));
  Scene by_hand = scene_with("", "");
  add_by_hand(by_hand.simulation);
  by_hand.simulation.set_contact({.distance = 0.03, .friction = 0.7});
  CHECK(scene.collider_names == std::vector<std::string>{"ball", "plane"});
  Index contacts = 0;
  for (int i = 0; i < 20; ++i) {
    contacts += scene.step().contact.contacts;
    by_hand.simulation.step();
    CHECK(scene.simulation.state().positions == by_hand.simulation.state().positions);
  }
  CHECK(contacts > 50);
}

TEST_CASE("events of colliders do what the calls do") {
  check_same(R"({"step": 4, "change": "ball", "radius": 0.2})", 4, [](Simulation& s) {
    s.replace(id(s, "ball"), SphereCollider{.center = {0.5, 0.5, -0.32}, .radius = 0.2, .friction = 0.4});
  });
  check_same(R"({"step": 4, "change": "ball", "center": [0.6, 0.5, -0.3]})", 4, [](Simulation& s) {
    s.set_target(id(s, "ball"), {{0.6, 0.5, -0.3}});
  });
  check_same(R"({"step": 7, "remove": "ball"})", 7, [](Simulation& s) { s.remove(id(s, "ball")); });
  check_same(R"({"time": 0.2, "add": {"type": "capsule", "from": [0, 0, -0.2], "to": [1, 0, -0.2]}})", 4,
             [](Simulation& s) {
               s.add(CapsuleCollider{.from = {0, 0, -0.2}, .to = {1, 0, -0.2}});
             });
  check_same(R"({"step": 5, "contact": {"distance": 0.01}})", 5,
             [](Simulation& s) { s.set_contact({.distance = 0.01, .surfaces = false}); });
  check_same(R"({"step": 3, "move": "ball", "offset": [0, 0.1, 0.1]})", 3, [](Simulation& s) {
    s.set_target(id(s, "ball"), {{0.5, 0.6, -0.22}});
  });
}

TEST_CASE("a collider goes along its path, turns about its center, and stays at the end") {
  Scene scene = scene_with(R"(
    {"step": 2, "move": "ball", "offset": [0.2, 0, 0], "over": 0.2},
    {"step": 8, "move": "ball", "rotate": {"axis": [0, 0, 2], "degrees": 180}, "center": [0.5, 0.5, 0], "over": 0.3},
    {"step": 16, "move": "ball", "target": [0, 0, -2], "over": 1},
    {"step": 18, "stop": "ball"})");
  const ColliderId ball = id(scene.simulation, "ball");
  const Vec3 begin{0.5, 0.5, -0.32};
  for (int i = 1; i <= 20; ++i) {
    scene.step();
    const Pose& pose = scene.simulation.pose(ball);
    Vec3 expected = begin + Vec3(0.05 * std::clamp(i - 2, 0, 4), 0, 0);
    const Real angle = std::numbers::pi * std::clamp(i - 8, 0, 6) / 6;
    if (i > 8) expected = begin + 0.2 * Vec3(std::cos(angle), std::sin(angle), 0);
    if (i > 16) expected += 0.05 * std::min(i - 16, 2) * (Vec3(0, 0, -2) - (begin - Vec3(0.2, 0, 0)));
    CAPTURE(i);
    CHECK((pose.position - expected).norm() < 1e-12);
    CHECK((pose.rotation * Vec3(1, 0, 0) - Vec3(std::cos(angle), std::sin(angle), 0)).norm() < 1e-12);
  }
  CHECK(scene.timeline.is_over());
}

TEST_CASE("behind its path a collider goes on with its velocities") {
  Scene scene = scene_with(R"({"step": 1, "move": "ball", "offset": [0, 0, -1], "over": 0.1})", R"("colliders": [
    {"type": "sphere", "name": "ball", "center": [0, 0, -5], "velocity": [2, 0, 0]}],)");
  const ColliderId ball = id(scene.simulation, "ball");
  for (const Vec3& expected : {Vec3(0.1, 0, -5), Vec3(0.1, 0, -5.5), Vec3(0.1, 0, -6), Vec3(0.2, 0, -6)}) {
    scene.step();
    CHECK((scene.simulation.pose(ball).position - expected).norm() < 1e-14);
  }
}

TEST_CASE("a collider follows a vertex and keeps its distance") {
  Scene scene = scene_with(R"({"step": 1, "follow": "ball", "body": "sheet", "vertices": 3})", R"("colliders": [
    {"type": "sphere", "name": "ball", "center": [5, 0, 0]}],)");
  const ColliderId ball = id(scene.simulation, "ball");
  scene.step();
  const Vec3 distance = scene.simulation.pose(ball).position - row(scene.simulation.state().positions, 3);
  for (int i = 0; i < 4; ++i) {
    const Vec3 vertex = row(scene.simulation.state().positions, 3);
    scene.step();
    CHECK((scene.simulation.pose(ball).position - vertex - distance).norm() < 1e-14);
  }
}

TEST_CASE("a step that fails takes the targets of colliders back") {
  const std::string_view events = R"({"step": 1, "move": "ball", "offset": [0, 0, 1], "over": 1},
                                     {"step": 4, "change": "ball", "radius": 0.1})";
  for (const int steps : {2, 4}) {
    Scene scene = scene_with(events);
    Scene untouched = scene_with(events);
    for (int i = 0; i < steps; ++i) {
      scene.step();
      untouched.step();
    }
    const State state = scene.simulation.state();
    const ColliderId ball = id(scene.simulation, "ball");
    scene.simulation.set_state(state.positions, Positions::Constant(state.vertex_count(), 3, 1e200));
    CHECK_THROWS_AS(scene.step(), Error);
    CHECK(!scene.simulation.target(ball));
    CHECK(scene.simulation.pose(ball) == untouched.simulation.pose(ball));
    scene.simulation.restore(state);
    for (int i = 0; i < 5; ++i) {
      scene.step();
      untouched.step();
      CHECK(scene.simulation.state().positions == untouched.simulation.state().positions);
      CHECK(scene.simulation.pose(ball) == untouched.simulation.pose(ball));
    }
  }
}

TEST_CASE("reading a scene leaves its colliders where they begin") {
  const Scene scene = scene_with(R"({"step": 0, "move": "ball", "offset": [0, 0, 1]},
    {"step": 3, "add": {"type": "box", "name": "step"}}, {"step": 4, "contact": {"friction": 0.9}},
    {"step": 5, "remove": "ball"}, {"step": 6, "add": {"type": "box", "name": "ball"}})");
  CHECK(scene.simulation.colliders().size() == 2);
  CHECK(!scene.simulation.target(id(scene.simulation, "ball")));
  CHECK(scene.simulation.contact() == ContactSettings{.surfaces = false});
  CHECK(scene.collider_names == std::vector<std::string>{"ball", "plane", "step"});
}

TEST_CASE("colliders and contact of included scenes: lists are joined, settings merged") {
  const TemporaryFolder folder;
  folder.write("base.json", scene_text("", std::string(R"("contact": {"friction": 0.7},)").append(ball_and_floor)));
  const Scene scene =
      load_scene(folder.write("scene.json", R"({"pliant": 1, "include": "base.json", "contact": {"distance": 0.02},
        "colliders": [{"type": "box"}]})"),
                 {.set = {"colliders[ball].radius=0.2", "contact.friction=0.1", "colliders[box].size=[1, 2, 3]"}});
  CHECK(scene.collider_names == std::vector<std::string>{"ball", "plane", "box"});
  CHECK(scene.simulation.contact() == ContactSettings{.distance = 0.02, .friction = 0.1});
  const auto* ball = scene.simulation.options<SphereCollider>(id(scene.simulation, "ball"));
  REQUIRE(ball != nullptr);
  CHECK(ball->radius == 0.2);
  CHECK(scene.simulation.options<BoxCollider>(id(scene.simulation, "box"))->size == Vec3(1, 2, 3));
}

TEST_CASE("colliders of a scene, and those that events add, have an appearance of their own") {
  const Scene scene = scene_with(
      R"({"step": 1, "add": {"type": "box", "name": "crate", "center": [9, 0, 0], "appearance": {"finish": "metal"}}})",
      R"("colliders": [{"type": "sphere", "name": "ball", "center": [0, 0, -3], "appearance":
           {"front": "#ff8000", "finish": "glossy"}}, {"type": "plane", "position": [0, 0, -4]}],)");
  REQUIRE(scene.collider_appearances.size() == 2);
  const ColliderAppearance& ball = scene.collider_appearances.at("ball");
  REQUIRE(ball.front);
  CHECK(ball.front->red == 1);
  CHECK(ball.front->green == doctest::Approx(128.0 / 255));
  CHECK(ball.front->blue == 0);
  CHECK(ball.finish == Finish::glossy);
  CHECK(scene.collider_appearances.at("crate") == ColliderAppearance{{}, Finish::metal});
}

TEST_CASE("what is wrong with a collider is said with its place") {
  const auto check_look = [](const std::string& appearance, const std::string& start) {
    check_refused("", R"("colliders": [{"type": "sphere", "appearance": )" + appearance + "}],",
                  "colliders[0].appearance" + start);
  };
  check_look(R"({"frnt": "#102030"})", ".frnt: unknown key; did you mean 'front'?");
  check_look(R"({"texture": "wood.png"})", ".texture: unknown key;");
  check_look(R"({"front": "brown"})", ".front: ");
  check_look(R"({"finish": "shiny"})", ".finish: ");
  check_look(R"("#102030")", ": ");
  check_refused(R"({"step": 1, "add": {"type": "sphere", "appearance": {"front": [2, 0, 0]}}})", ball_and_floor,
                "events[0].add.appearance.front");
  check_refused(R"({"step": 1, "change": "ball", "appearance": {"front": "#102030"}})", ball_and_floor,
                "events[0].appearance: unknown key;");
  check_refused("", R"("colliders": [{"type": "spher"}],)",
                "colliders[0].type: unknown collider 'spher'; did you mean 'sphere'? (known: plane, sphere, capsule, ");
  check_refused("", R"("colliders": [{"type": "sphere", "radius": 0}],)", "colliders[0].radius: 0 is out of range;");
  check_refused("", R"("colliders": [{"type": "sphere", "radios": 1}],)", "colliders[0].radios: unknown key; did you");
  check_refused("", R"("colliders": [{"type": "plane", "name": "skin"}],)",
                "colliders[0].name: the name 'skin' is another group's; choose another");
  check_refused("", R"("colliders": [{"type": "box", "rounding": 2}],)", "colliders[0]: box: rounding: 2 is more than");
  check_refused("", R"("contact": {"fricton": 1},)", "contact.fricton: unknown key; did you mean 'friction'?");
  check_refused(R"({"step": 1, "remove": "bal"})", ball_and_floor,
                "events[0].remove: no group, force or collider is called 'bal' then; did you mean 'ball'?");
  check_refused(R"({"step": 1, "remove": "ball"}, {"step": 2, "change": "ball", "radius": 1})", ball_and_floor,
                "events[1].change: no group, force or collider is called 'ball' then");
  check_refused(R"({"step": 1, "stop": "ball", "index": 2})", ball_and_floor,
                "events[0].index: a collider has no constraints");
}

}  // namespace test_colliders
