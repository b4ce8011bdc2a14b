// Timed events of scene files: each does what the same call would, and what is wrong with one is said when it is read.
#include <algorithm>
#include <array>
#include <cstring>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant/pliant.h"
#include "pliant_io/scene/scene.h"
#include "tests/support/temporary_folder.h"

namespace test_events {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// A sheet of 3 × 3 with pins, springs and wind, a chain of 3 vertices beside it; steps of 0.1 s.
std::string scene_text(const std::string& events, const std::string& more = "") {
  return R"({"pliant": 1, "settings": {"time_step": 0.1, "iterations": 3, "threads": 1}, "bodies": [
    {"name": "sheet", "mesh": {"shape": "grid", "columns": 3, "rows": 3}, "mass": {"total": 1},
     "constraints": [{"type": "position", "name": "pins", "on": [6, 7, 8]},
                     {"type": "triangle_strain", "name": "skin", "stiffness": 100, "max_stretch": 1.1},
                     {"type": "drag", "name": "hand", "stencils": [[0, 1], [2]]}]},
    {"name": "rope", "mesh": {"shape": "chain", "links": 2}, "mass": {"total": 1},
     "constraints": [{"type": "edge_spring", "name": "rope", "stiffness": [10, 20]}]}],
   "forces": [{"type": "wind", "velocity": [0, 1, 0]},
              {"type": "test_force", "name": "push", "body": "rope", "vertex": 2, "force": [1, 0, 0]},
              {"type": "mouse_spring", "body": "rope", "vertex": 0, "anchor": [0, 0, 1], "stiffness": 5}],)" +
         more + R"("events": [)" + events + "]}";
}

Scene scene_with(const std::string& events, const std::string& more = "") {
  return parse_scene(scene_text(events, more), {}, "s.json");
}

/// The scene after a number of steps.
Scene run(const std::string& events, int steps) {
  Scene scene = scene_with(events);
  for (int i = 0; i < steps; ++i) scene.step();
  return scene;
}

GroupId id(const Scene& scene, const char* name) {
  const auto found = scene.simulation.find_group(name);
  REQUIRE(found);
  return *found;
}

/// Compares a run by events with one in which `edit` is made by hand before the step `step`.
void check_same(const std::string& events, int step, const std::function<void(Simulation&)>& edit, int steps = 8) {
  CAPTURE(events);
  Scene by_events = scene_with(events);
  Scene by_hand = scene_with("");
  for (int i = 0; i < steps; ++i) {
    if (i == step) edit(by_hand.simulation);
    by_events.step();
    by_hand.simulation.step();
    CHECK(by_events.simulation.state().positions == by_hand.simulation.state().positions);
  }
}

std::string message_of(const std::string& events, const std::string& more = "") {
  return error_of([&] { scene_with(events, more); });
}

void check_refused(const std::string& event, const std::string& start, const std::string& rest = "") {
  const std::string message = message_of(event);
  CAPTURE(event);
  CAPTURE(message);
  CHECK(message.starts_with("s.json: " + start));
  CHECK(message.find(rest) != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("a scene without events has none, and reading leaves no trace") {
  Scene scene = scene_with("");
  CHECK(scene.timeline.is_over());
  Scene eventful =
      scene_with(R"({"step": 100, "remove": "skin"}, {"time": 99, "add": {"body": "sheet", "type": "hinge"}},
    {"time": 50, "settings": {"time_step": 0.2}}, {"time": 2, "gravity": null})");
  CHECK(eventful.simulation.groups().size() == 4);
  CHECK(eventful.simulation.forces().size() == 4);
  CHECK(eventful.simulation.settings().time_step == 0.1);
  CHECK(eventful.simulation.warnings() == scene.simulation.warnings());
  CHECK(eventful.group_names.back() == "sheet.hinge");
  CHECK(eventful.timeline.event_count() == 4);
  for (int i = 0; i < 5; ++i) {
    scene.step();
    eventful.step();
    CHECK(scene.simulation.state().positions == eventful.simulation.state().positions);
  }
}

TEST_CASE("every event does what the call does") {
  const auto group = [](Simulation& s, const char* name) { return s.find_group(name).value(); };
  check_same(R"({"step": 2, "change": "skin", "stiffness": 900})", 2,
             [&](Simulation& s) { s.set_stiffness(group(s, "skin"), 900); });
  check_same(R"({"time": 0.25, "change": "skin", "min_stretch": 0.9})", 3, [&](Simulation& s) {
    s.replace(group(s, "skin"), TriangleStrain{.stiffness = 100, .min_stretch = 0.9, .max_stretch = 1.1});
  });
  check_same(R"({"step": 1, "change": "rope", "stiffness": 40})", 1,
             [&](Simulation& s) { s.replace(group(s, "rope"), EdgeSpring{.stiffness = 40}); });
  check_same(R"({"step": 1, "change": "skin", "stiffness": [1, 2, 3, 4, 5, 6, 7, 8]})", 1, [&](Simulation& s) {
    s.replace(group(s, "skin"),
              TriangleStrain{.stiffness = std::vector<Real>{1, 2, 3, 4, 5, 6, 7, 8}, .max_stretch = 1.1});
  });
  check_same(R"({"step": 4, "change": "pins", "hold": "soft", "stiffness": 30})", 4, [&](Simulation& s) {
    s.replace(group(s, "pins"), Position{.on = {6, 7, 8}, .hold = Hold::soft, .stiffness = 30});
  });
  check_same(R"({"step": 4, "change": "wind", "velocity": [0, 9, 0], "drag": 2})", 4, [](Simulation& s) {
    s.replace(*s.find_force("wind"), Wind{.velocity = {0, 9, 0}, .drag = 2});
  });
  check_same(R"({"step": 4, "change": "push", "force": [0, 5, 0]})", 4, [](Simulation& s) {
    s.replace(*s.find_force("push"), TestForce{.vertices = {2}, .force = Vec3(0, 5, 0)});
  });
  check_same(R"({"step": 4, "change": "mouse_spring", "anchor": [1, 1, 1]})", 4, [](Simulation& s) {
    s.replace(*s.find_force("mouse_spring"), MouseSpring{.vertices = {0}, .anchor = {1, 1, 1}, .stiffness = 5});
  });
  check_same(R"({"step": 3, "settings": {"time_step": 0.03, "iterations": 7}})", 3, [](Simulation& s) {
    SolverSettings settings = s.settings();
    settings.time_step = 0.03;
    settings.iterations = 7;
    s.set_settings(settings);
  });
  check_same(R"({"step": 3, "gravity": [0, 0, 2]})", 3,
             [](Simulation& s) { s.replace(*s.find_force("gravity"), Gravity{Vec3(0, 0, 2)}); });
  check_same(R"({"step": 3, "gravity": null})", 3, [](Simulation& s) { s.remove(*s.find_force("gravity")); });
  check_same(R"({"step": 2, "add": {"body": "sheet", "type": "position", "on": [0], "hold": "soft"}})", 2,
             [](Simulation& s) { s.add(BodyId{0}, Position{.on = {0}, .hold = Hold::soft}); });
  check_same(R"({"step": 2, "add": {"type": "wind", "body": "sheet", "velocity": [0, 0, 3]}})", 2, [](Simulation& s) {
    s.add(BodyId{0}, Wind{.velocity = {0, 0, 3}});
  });
  check_same(R"({"step": 2, "remove": "skin"})", 2, [&](Simulation& s) { s.remove(group(s, "skin")); });
  check_same(R"({"step": 2, "remove": "wind"})", 2, [](Simulation& s) { s.remove(*s.find_force("wind")); });
  check_same(R"({"step": 2, "release": "pins", "vertices": [6, 8]})", 2, [&](Simulation& s) {
    s.release(group(s, "pins"), std::array<Index, 2>{6, 8});
  });
  check_same(R"({"step": 2, "release": "pins", "index": 1})", 2,
             [&](Simulation& s) { s.release(group(s, "pins"), std::array<Index, 1>{7}); });
  check_same(
      R"({"step": 2, "release": "pins", "vertices": {"half_space": {"point": [0.9, 0, 0], "normal": [1, 0, 0]}}})", 2,
      [&](Simulation& s) { s.release(group(s, "pins"), std::array<Index, 1>{8}); });
  check_same(R"({"step": 2, "release": "pins", "vertices": "all"})", 2, [&](Simulation& s) {
    s.release(group(s, "pins"), std::array<Index, 3>{6, 7, 8});
  });
  check_same(R"({"step": 2, "move": "hand", "index": 1, "target": [1, 2, 3]})", 2, [&](Simulation& s) {
    s.set_target(group(s, "hand"), 1, {1, 2, 3});
  });
  check_same(R"({"step": 2, "move": "pins", "index": [0, 2], "offset": [0, 0, 1]})", 2, [&](Simulation& s) {
    for (const Index i : {0, 2}) s.set_target(group(s, "pins"), i, s.target(group(s, "pins"), i) + Vec3(0, 0, 1));
  });
}

TEST_CASE("moves turn, run along keyframes, follow and stop") {
  const Scene turned =
      run(R"({"step": 0, "move": "pins", "rotate": {"axis": [0, 0, 1], "degrees": 90}, "over": 0.5})", 6);
  CHECK((turned.simulation.target(id(turned, "pins"), 0) - Vec3(0.5, -0.5, 1)).norm() < 1e-15);
  const Scene centered = run(R"({"step": 0, "move": "pins", "rotate": {"axis": [0, 0, 1], "degrees": 90},
    "center": [0, 0, 0], "over": 0.5})",
                             6);
  CHECK((centered.simulation.target(id(centered, "pins"), 2) - Vec3(0, 1, 1)).norm() < 1e-15);
  const Scene keyed = run(R"({"time": 0.2, "move": "pins", "ease": "smooth", "keyframes": [
    {"time": 0.2, "translate": [0, 1, 0]}, {"time": 0.4, "translate": [0, 1, 1], "rotate": {"axis": [0, 1, 0], "degrees": 180}}]})",
                          6);
  CHECK((keyed.simulation.target(id(keyed, "pins"), 0) - Vec3(1, 1, 2)).norm() < 1e-15);
  const Scene following =
      run(R"({"step": 1, "follow": "pins", "body": "rope", "vertices": 2, "index": 0, "attach": "exact"})", 4);
  const Scene before = run("", 3);
  CHECK((following.simulation.target(id(following, "pins"), 0) - row(before.simulation.state().positions, 11)).norm() <
        0.2);
  CHECK(following.simulation.target(id(following, "pins"), 1) == Vec3(0.5, 0, 1));
  const Scene stopped =
      run(R"({"step": 0, "move": "pins", "offset": [0, 1, 0], "over": 1}, {"step": 3, "stop": "pins"})", 6);
  CHECK(stopped.simulation.target(id(stopped, "pins"), 0)[1] == doctest::Approx(0.3));
  const Scene partly = run(R"({"step": 0, "move": "pins", "offset": [0, 1, 0], "over": 1},
    {"step": 3, "stop": "pins", "index": [1, 2]})",
                           6);
  CHECK(partly.simulation.target(id(partly, "pins"), 0)[1] == doctest::Approx(0.6));
  CHECK(partly.simulation.target(id(partly, "pins"), 1)[1] == doctest::Approx(0.3));
}

TEST_CASE("ramps lead the stiffness; other options change at once and leave it where it is") {
  const Scene scene = run(R"({"step": 0, "change": "skin", "stiffness": 1600, "over": 0.4, "min_stretch": 0.5},
    {"step": 2, "change": "skin", "max_stretch": 1.3})",
                          3);
  CHECK(*scene.simulation.stiffness(id(scene, "skin")) == doctest::Approx(800));
  const Scene later = run(R"({"step": 0, "change": "skin", "stiffness": 1600, "over": 0.4},
    {"step": 2, "change": "skin", "stiffness": 7})",
                          4);
  CHECK(later.simulation.stiffness(id(later, "skin")) == 7);
}

TEST_CASE("changes of pins keep where they have come, unless they say otherwise") {
  const std::string up = R"({"step": 0, "move": "pins", "offset": [0, 0, 1]})";
  const Scene soft = run(up + R"(, {"step": 1, "change": "pins", "hold": "soft", "stiffness": 5})", 2);
  CHECK(soft.simulation.target(id(soft, "pins"), 2) == Vec3(1, 0, 2));
  const Scene others = run(up + R"(, {"step": 1, "change": "pins", "on": [5, 8]})", 2);
  CHECK(others.simulation.target_count(id(others, "pins")) == 2);
  CHECK(others.simulation.target(id(others, "pins"), 1) == Vec3(1, 0, 2));
  const Scene given = run(up + R"(, {"step": 1, "change": "pins", "targets": [7, 7, 7]})", 2);
  CHECK(given.simulation.target(id(given, "pins"), 1) == Vec3(7, 7, 7));
  // What is released stays so.
  const Scene released = run(up + R"(, {"step": 1, "release": "pins", "vertices": [7]},
    {"step": 2, "change": "pins", "hold": "soft", "stiffness": [5, 6]}, {"step": 3, "release": "pins", "index": 0},
    {"step": 4, "change": "pins", "stiffness": 9})",
                             6);
  CHECK(released.simulation.target_count(id(released, "pins")) == 1);
  CHECK(released.simulation.target(id(released, "pins"), 0) == Vec3(1, 0, 2));
  const Scene all =
      run(R"({"step": 1, "release": "pins", "vertices": "all"}, {"step": 2, "change": "pins", "hold": "soft"})", 4);
  CHECK(all.simulation.target_count(id(all, "pins")) == 0);
}

TEST_CASE("names are followed through the events in the order in which they act, not in that of the file") {
  const Scene scene = run(R"({"step": 6, "change": "extra", "stiffness": 40},
    {"step": 4, "move": "extra", "offset": [0, 0, 1]}, {"time": 0.2, "add": {"body": "sheet", "name": "extra",
    "type": "position", "on": [0], "hold": "soft"}}, {"step": 1, "remove": "skin"},
    {"time": 0.15, "add": {"body": "rope", "type": "edge_strain", "name": "skin"}}, {"step": 3, "remove": "hand"})",
                          8);
  CHECK(scene.simulation.stiffness(id(scene, "extra")) == 40);
  CHECK(scene.simulation.groups().at(id(scene, "skin")).type == "edge_strain");
  CHECK(std::ranges::count(scene.group_names, "extra") == 1);
  CHECK(std::ranges::count(scene.group_names, "skin") == 1);
  check_refused(R"({"step": 2, "change": "extra", "stiffness": 4}, {"step": 3, "add": {"body": "sheet", "name": "extra",
    "type": "hinge"}})",
                "events[0].change: no group, force or collider is called 'extra' then", "known: ");
  check_refused(R"({"step": 5, "move": "pins", "offset": [0, 0, 1]}, {"step": 3, "remove": "pins"})",
                "events[0].move: unknown group 'pins'");
  // A longer step brings a time before a step.
  check_refused(R"({"time": 1, "remove": "pins"}, {"step": 2, "settings": {"time_step": 1}},
    {"step": 4, "remove": "pins"})",
                "events[2].remove: no group, force or collider");
  check_refused(R"({"step": 4, "add": {"body": "sheet", "name": "skin", "type": "hinge"}})",
                "events[0].add.name: the name 'skin' is another group's");
  check_refused(R"({"step": 1, "remove": "skin"}, {"step": 1, "remove": "skin"})",
                "events[1].remove: no group, force or collider");
}

TEST_CASE("what is wrong with an event is said with its place") {
  check_refused(R"({"step": 1})",
                "events[0]: no key says which it is; give one of the keys change, settings, contact, gravity, add,");
  check_refused(R"({"change": "skin", "stiffness": 1})",
                "events[0]: no key says which it is; give one of the keys step, time");
  check_refused(R"({"step": 1, "time": 2, "remove": "skin"})", "events[0]: has both 'step' and 'time'");
  check_refused(R"({"step": -1, "remove": "skin"})", "events[0].step: -1 is out of range");
  check_refused(R"({"time": -0.1, "remove": "skin"})", "events[0].time: -0.1 is out of range");
  check_refused(R"({"time": "now", "remove": "skin"})", "events[0].time: found a string; give a number");
  check_refused(R"({"step": 1, "remove": "skin", "move": "pins"})", "events[0]: has both");
  check_refused(R"(7)", "events[0]: found a number; give an object");
  check_refused(R"({"step": 1, "change": "skn", "stiffness": 1})",
                "events[0].change: no group, force or collider is called 'skn' then", "did you mean 'skin'");
  check_refused(R"({"step": 1, "change": "skin", "stifness": 1})", "events[0].stifness: unknown key",
                "did you mean 'stiffness'");
  check_refused(R"({"step": 1, "change": "skin", "stiffness": -1})", "events[0].stiffness: -1 is out of range");
  check_refused(R"({"step": 1, "change": "skin", "stiffness": [1, 2]})",
                "events[0]: triangle_strain: stiffness has 2 entries for 8");
  check_refused(R"({"step": 1, "change": "skin", "on": [99]})", "events[0].on[0]: vertex 99 is out of range");
  check_refused(R"({"step": 1, "change": "hand", "stencils": [[0, 99]]})",
                "events[0].stencils[0][1]: vertex 99 is out of range");
  check_refused(R"({"step": 1, "change": "skin"})", "events[0]: nothing is changed");
  check_refused(R"({"step": 1, "change": "skin", "type": "hinge"})", "events[0].type: unknown key");
  check_refused(R"({"step": 1, "change": "skin", "max_stretch": 2, "over": 1})", "events[0]: 'over' and 'ease' lead");
  check_refused(R"({"step": 1, "change": "rope", "stiffness": 5, "over": 1})", "events[0]: 'over' and 'ease' lead");
  check_refused(R"({"step": 1, "change": "pins", "stiffness": 5, "over": 1})", "events[0]: 'over' and 'ease' lead");
  check_refused(R"({"step": 1, "change": "skin", "stiffness": 5, "over": -1})", "events[0].over: -1 is out of range");
  check_refused(R"({"step": 1, "change": "skin", "min_stretch": 1.2})",
                "events[0]: triangle_strain: min_stretch 1.2 is above");
  check_refused(R"({"step": 1, "change": "wind", "velocty": [0, 0, 1]})", "events[0].velocty: unknown key",
                "did you mean 'velocity'");
  check_refused(R"({"step": 1, "change": "wind", "drag": -1})", "events[0].drag: -1 is out of range");
  check_refused(R"({"step": 1, "change": "push", "vertex": 3})", "events[0].vertex: vertex 3 is out of range");
  check_refused(R"({"step": 1, "change": "gravity", "acceleration": [0, 0, 1]})",
                "events[0]: gravity has an event of its own");
  check_refused(R"({"step": 1, "settings": {"time_step": 0}})", "events[0].settings.time_step: 0 is out of range");
  check_refused(R"({"step": 1, "settings": {"timestep": 1}})", "events[0].settings.timestep: unknown key");
  check_refused(R"({"step": 1, "settings": {}})", "events[0].settings: no setting is given");
  check_refused(R"({"step": 1, "gravity": 9.81})", "events[0].gravity: found a number; give a list");
  check_refused(R"({"step": 1, "gravity": null, "over": 1})", "events[0].over: unknown key");
  check_refused(R"({"step": 1, "add": {"type": "hinge"}})", "events[0].add: there are several bodies");
  check_refused(R"({"step": 1, "add": {"body": "sheet"}})", "events[0].add: the key 'type' is missing");
  check_refused(R"({"step": 1, "add": {"body": "sheet", "type": "hing"}})",
                "events[0].add.type: unknown constraint 'hing'; did you mean 'hinge'?", "did you mean 'hinge'");
  check_refused(R"({"step": 1, "add": {"body": "rope", "type": "hinge"}})", "events[0].add: makes no constraint");
  check_refused(R"({"step": 1, "add": {"body": "sheet", "type": "position", "on": [6]}})",
                "events[0]: ", "is already pinned by 'pins'");
  check_refused(R"({"step": 1, "add": {"type": "wind", "body": "rope"}})", "events[0]: wind: there are no triangles");
  check_refused(R"({"step": 1, "add": {"type": "wind", "name": "gravity"}})", "events[0].add.name: the name 'gravity'");
  check_refused(R"({"step": 1, "remove": "wnd"})", "events[0].remove: no group, force or collider is called 'wnd' then",
                "did you mean 'wind'");
  check_refused(R"({"step": 1, "release": "skin", "vertices": [0]})",
                "events[0].release: 'skin' is a group of type triangle_strain");
  check_refused(R"({"step": 1, "release": "pins", "vertices": [0]})", "events[0]: vertex 0 is not pinned here");
  check_refused(R"({"step": 1, "release": "pins", "vertices": {"nearest": [0, 0, 0]}})",
                "events[0].vertices: the group holds none");
  check_refused(R"({"step": 1, "release": "pins", "index": 3})", "events[0].index: the group has no constraint 3");
  check_refused(R"({"step": 1, "release": "pins"})",
                "events[0]: no key says which it is; give one of the keys vertices, index");
  check_refused(R"({"step": 1, "move": "skin", "offset": [0, 0, 1]})", "events[0]: the group 'skin' has no targets");
  check_refused(R"({"step": 1, "move": "wind", "offset": [0, 0, 1]})", "events[0].move: unknown group 'wind'");
  check_refused(R"({"step": 1, "move": "pins"})",
                "events[0]: no key says which it is; give one of the keys target, offset, rotate, keyframes");
  check_refused(R"({"step": 1, "move": "pins", "index": 3, "offset": [0, 0, 1]})",
                "events[0]: index 3 is out of range");
  check_refused(R"({"step": 1, "move": "pins", "index": [], "offset": [0, 0, 1]})",
                "events[0].index: the list is empty");
  check_refused(
      R"({"step": 1, "release": "pins", "index": 1}, {"step": 2, "move": "pins", "index": 1, "offset": [0, 0, 1]})",
      "events[1]: constraint 1 of the group 'pins' was released");
  check_refused(R"({"step": 1, "move": "pins", "rotate": {"degrees": 9}})",
                "events[0].rotate: the key 'axis' is missing");
  check_refused(R"({"step": 1, "move": "pins", "rotate": {"axis": [0, 0, 1]}})",
                "events[0].rotate: the key 'degrees' is missing");
  check_refused(R"({"step": 1, "move": "pins", "rotate": {"axis": [0, 0, 0], "degrees": 9}})",
                "events[0].rotate.axis: an axis of length 0");
  check_refused(R"({"step": 1, "move": "pins", "rotate": {"axis": [0, 0, 1], "degrees": 9}, "over": -1})",
                "events[0].over: -1 is out of range");
  check_refused(R"({"step": 1, "move": "pins", "offset": [0, 0, 1], "center": [0, 0, 0]})",
                "events[0].center: 'offset' turns nothing");
  check_refused(R"({"step": 1, "move": "pins", "keyframes": [{"time": 1}], "over": 1})",
                "events[0].over: the times of the keyframes");
  check_refused(R"({"step": 1, "move": "pins", "keyframes": []})", "events[0].keyframes: the list is empty");
  check_refused(R"({"step": 1, "move": "pins", "keyframes": [{}]})",
                "events[0].keyframes[0]: the key 'time' is missing");
  check_refused(R"({"step": 1, "move": "pins", "keyframes": [{"time": 1}, {"time": 0.5}]})",
                "events[0]: keyframes[1]: the time 0.5 s");
  check_refused(R"({"step": 1, "move": "pins", "keyframes": [{"time": 1, "turn": 2}]})",
                "events[0].keyframes[0].turn: unknown key");
  check_refused(R"({"step": 1, "follow": "pins"})",
                "events[0]: no key says which it is; give one of the keys body, file");
  check_refused(R"({"step": 1, "follow": "pins", "body": "ropes"})", "events[0].body: unknown body 'ropes'",
                "did you mean 'rope'");
  check_refused(R"({"step": 1, "follow": "pins", "body": "sheet"})",
                "events[0]: a group cannot follow the body that it holds");
  check_refused(R"({"step": 1, "follow": "pins", "body": "rope", "vertices": [0, 1]})",
                "events[0]: 2 vertices for 3 constraints");
  check_refused(R"({"step": 1, "follow": "pins", "body": "rope", "vertices": 5})",
                "events[0]: vertex 5 is out of range");
  check_refused(R"({"step": 1, "follow": "pins", "file": "missing.pc2"})", "events[0].file: missing.pc2: ");
  check_refused(R"({"step": 1, "follow": "pins", "file": "missing.pc2", "frames_per_second": 0})",
                "events[0].frames_per_second: 0 is out of range");
  check_refused(R"({"step": 1, "stop": "skn"})", "events[0].stop: unknown group 'skn'");
  CHECK(message_of("", R"("moves": [{"group": "pins", "step": 1, "turn": 1}],)")
            .starts_with("s.json: moves[0].turn: unknown key"));
}

TEST_CASE("an event that a program has made impossible says its place, and can be made possible again") {
  Scene scene = scene_with(R"({"step": 1, "change": "skin", "stiffness": 5})");
  scene.step();
  scene.simulation.remove(id(scene, "skin"));
  CHECK(contains(error_of([&] { scene.step(); }), "s.json: events[0]: the group 'skin' no longer exists"));
  CHECK(scene.simulation.state().step == 1);
  scene.simulation.add(BodyId{0}, TriangleStrain{}, "skin");
  scene.step();
  CHECK(scene.simulation.stiffness(id(scene, "skin")) == 5);
}

TEST_CASE("pins follow a file of frames") {
  const TemporaryFolder folder;
  // MDD: frames, vertices, times, then positions, all big-endian.
  std::string bytes;
  const auto put = [&bytes](auto number) {
    std::array<char, 4> four;
    std::memcpy(four.data(), &number, 4);
    for (std::size_t i = 4; i-- > 0;) bytes += four[i];
  };
  put(std::int32_t{2});
  put(std::int32_t{1});
  for (const float time : {0.F, 0.5F}) put(time);
  for (const float x : {0.F, 0.F, 0.F, 0.F, 2.F, 0.F}) put(x);
  folder.write("hand.mdd", bytes);
  const std::string events = R"({"step": 1, "follow": "pins", "file": "hand.mdd"})";
  Scene scene = parse_scene(scene_text(events), folder.path(), "s.json");
  for (int i = 0; i < 3; ++i) scene.step();
  CHECK(scene.simulation.target(id(scene, "pins"), 0)[1] == doctest::Approx(0.8).epsilon(1e-7));
  CHECK(scene.simulation.target(id(scene, "pins"), 2)[0] == 1);
  for (int i = 0; i < 9; ++i) scene.step();
  CHECK(scene.simulation.target(id(scene, "pins"), 1) == Vec3(0.5, 2, 1));
}

TEST_CASE("times beyond all steps are read, and never come") {
  Scene scene = scene_with(R"({"time": 1.7e308, "remove": "skin"}, {"time": 1e308, "settings": {"time_step": 1e-300}},
    {"step": 9223372036854775807, "remove": "hand"}, {"time": 1e18, "stop": "pins"})");
  for (int i = 0; i < 3; ++i) scene.step();
  CHECK(scene.simulation.find_group("skin").has_value());
  CHECK(!scene.timeline.is_over());
}

}  // namespace test_events
