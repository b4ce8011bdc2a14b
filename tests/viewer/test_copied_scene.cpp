// Scenes that programs have made, in a session: how they start over, and what of a text still holds.
#include <doctest/doctest.h>

#include "../simulation/own_types.h"
#include "pliant/core/error.h"
#include "pliant/pliant.h"
#include "viewer/copied_scene.h"

namespace test_copied_scene {

using namespace pliant;
using namespace pliant_viewer;

namespace {

constexpr const char* text = R"({ "pliant": 1, "bodies": [ { "name": "sheet", "mass": { "total": 1 },
  "mesh": { "shape": "grid", "columns": 5, "rows": 5, "plane": "xz" },
  "constraints": [ { "type": "position", "on": [20, 24] }, { "type": "edge_spring", "stiffness": 500 } ] } ],
  "colliders": [ { "type": "sphere", "center": [0, 0, -2] } ],
  "forces": [ { "type": "test_force", "name": "push", "vertices": [3], "force": [0, 0, 1] } ],
  "events": [ { "step": 3, "release": "sheet.position", "vertices": [20] } ] })";

/// What goes along a path from the start on.
constexpr const char* dancing = R"({ "pliant": 1, "contact": {}, "bodies": [ { "name": "ball",
  "mesh": { "shape": "sphere", "subdivisions": 1 }, "animation": { "velocity": [1, 0, 0] } } ] })";

Scene read() {
  return parse_scene(text, {}, "sheet");
}

/// Whether a session with it can write a scene file.
bool has_text(Scene scene, bool is_program = false) {
  return Session(maker_of(std::move(scene), is_program)).has_text();
}

/// Made by a program, with a type of its own and an event that lets a pin go.
Scene make() {
  Scene scene;
  scene.name = "made";
  scene.simulation.set_settings({.iterations = 5, .threads = 1});
  const BodyId sheet =
      scene.simulation.add_body(grid({.columns = 5, .rows = 5}), Mass::area_density(0.2), {.name = "sheet"});
  scene.simulation.add(sheet, EdgeSpring{.stiffness = 300});
  const GroupId pins = scene.simulation.add(sheet, Position{.on = {20, 24}}, "sheet.pins");
  scene.simulation.add(pliant_tests::Whirl{}, "whirl");
  scene.simulation.add(pliant_tests::EggCollider{.center = {0, 0, -3}, .velocity = {0, 0, 1}}, "egg");
  scene.simulation.add(Gravity{});
  scene.timeline.add(When::at_step(3), [pins](Simulation& simulation) { simulation.release(pins, std::array{20}); });
  return scene;
}

Positions positions_after(Session& session, int steps) {
  for (int i = 0; i < steps; ++i) session.step();
  return session.simulation().state().positions;
}

}  // namespace

TEST_CASE("a scene keeps its text where nothing was changed since it was read, and loses it otherwise") {
  CHECK(has_text(read()));
  CHECK_FALSE(has_text(read(), true));
  CHECK_FALSE(has_text(make()));
  const auto is_text_after = [](const std::function<void(Scene&)>& change) {
    Scene scene = read();
    change(scene);
    return has_text(std::move(scene));
  };
  CHECK(is_text_after([](Scene& scene) { scene.view.color = ColorBy::stretch; }));
  CHECK_FALSE(is_text_after([](Scene& scene) { scene.step(); }));
  CHECK_FALSE(is_text_after([](Scene& scene) { scene.simulation.set_settings({.iterations = 77}); }));
  CHECK_FALSE(is_text_after([](Scene& scene) { scene.simulation.add(pliant_tests::Whirl{}); }));
  CHECK_FALSE(is_text_after([](Scene& scene) {
    scene.simulation.set_stiffness(scene.simulation.find_group("sheet.edge_spring").value(), 501);
  }));
  CHECK_FALSE(is_text_after([](Scene& scene) {
    scene.simulation.set_target(scene.simulation.find_group("sheet.position").value(), 1, {1, 0.2, 1});
  }));
  CHECK_FALSE(is_text_after([](Scene& scene) {
    Positions moved = scene.simulation.state().positions;
    moved(3, 2) += 0.01;
    scene.simulation.set_state(moved, scene.simulation.state().velocities);
  }));
  CHECK_FALSE(is_text_after([](Scene& scene) {
    scene.simulation.set_target(scene.simulation.find_collider("sphere").value(), {{0, 0, -1}});
  }));
  CHECK_FALSE(is_text_after([](Scene& scene) { scene.timeline.add(When::at_step(5), [](Simulation&) {}); }));
  CHECK_FALSE(is_text_after([](Scene& scene) {
    const GroupId pins = scene.simulation.find_group("sheet.position").value();
    scene.timeline.start(scene.simulation, pins, straight_path(MoveKind::offset, Vec3(0, 1, 0), 1));
  }));
  CHECK_FALSE(is_text_after([](Scene& scene) {
    const GroupId springs = scene.simulation.find_group("sheet.edge_spring").value();
    scene.simulation.set_stiffness_factors(springs, std::vector<Real>(25, 2));
  }));
  CHECK_FALSE(is_text_after([](Scene& scene) {
    const ForceId push = scene.simulation.find_force("push").value();
    scene.simulation.replace(push, BodyId{0}, TestForce{.vertices = {3}, .force = Vec3(0, 0, 2)});
  }));
  CHECK(Session(maker_of(parse_scene(dancing, {}, "dancing"), false)).has_text());
}

TEST_CASE("what a program has made starts over with the same bits, its events and its own types as well") {
  Session session(maker_of(make(), true));
  const Positions first = positions_after(session, 10);
  CHECK(session.pinned_vertices().size() == 1);
  session.restart(false);
  CHECK(session.simulation().state().step == 0);
  CHECK(session.pinned_vertices().size() == 2);
  CHECK(positions_after(session, 10) == first);
}

TEST_CASE("pins by hand, and what they are called, do not mix with groups that a program has named alike") {
  Session session(maker_of(make(), true));
  session.pin(12);
  CHECK(session.pinned_vertices().size() == 3);
  CHECK(session.simulation().target_count(session.simulation().find_group("sheet.pins").value()) == 2);
  session.undo();
  CHECK(session.pinned_vertices().size() == 2);
  session.redo();
  session.step();
  session.unpin(20);
  session.undo();
  CHECK(session.is_pinned(20));
  session.set("force:whirl.strength", {5, 0, 0});
  session.switch_on("whirl", false);
  CHECK_FALSE(session.simulation().find_force("whirl").has_value());
  session.undo();
  CHECK(session.simulation().options<pliant_tests::Whirl>(*session.simulation().find_force("whirl"))->strength == 5);
}

TEST_CASE("a collider of a program's own type that is moved by hand stops where it is left") {
  Session session(maker_of(make(), true));
  positions_after(session, 2);
  const ColliderId egg = session.simulation().find_collider("egg").value();
  session.move_collider(egg, {1, 0, -3});
  positions_after(session, 200);
  CHECK(session.simulation().pose(egg).position == Vec3(1, 0, -3));
}

TEST_CASE("a scene that stands elsewhere than at its start starts over from there") {
  Scene scene = make();
  for (int i = 0; i < 5; ++i) scene.step();
  const Positions there = scene.simulation.state().positions;
  Session session(maker_of(std::move(scene), false));
  const Positions then = positions_after(session, 5);
  session.restart(true);
  CHECK(session.simulation().state().step == 5);
  CHECK(session.simulation().state().positions == there);
  CHECK(session.pinned_vertices().size() == 1);  // the event has acted, and does not act again
  CHECK(positions_after(session, 5) == then);
  session.pin(12);
  session.undo();
  CHECK_FALSE(session.is_pinned(12));
  session.switch_on("whirl", false);
  session.step();
  session.undo();
  CHECK(session.simulation().find_force("whirl").has_value());
  CHECK(session.pinned_vertices().size() == 1);
}

TEST_CASE("groups that a program has left without a name are not mixed up") {
  Scene scene;
  scene.simulation.set_settings({.iterations = 5, .threads = 1});
  std::vector<GroupId> springs;
  for (const Real height : {0.0, 1.0}) {
    Mesh mesh = grid({.columns = 5, .rows = 5, .plane = Plane::xy});
    mesh.vertices.col(2).array() += height;
    const BodyId sheet = scene.simulation.add_body(std::move(mesh), Mass::area_density(0.2));
    springs.push_back(scene.simulation.add(sheet, EdgeSpring{.stiffness = 100 * (1 + 9 * height)}));
    scene.simulation.add(sheet, Position{.on = {0, 4}});
    scene.simulation.add(sheet, Position{.on = {20}});
  }
  Session session(maker_of(std::move(scene), false));
  positions_after(session, 2);
  session.pin(12);
  session.undo();
  CHECK(session.simulation().stiffness(springs[0]) == 100);
  CHECK(session.simulation().stiffness(springs[1]) == 1000);
  session.set("group:edge_spring:2.stiffness", {5000, 0, 0});
  session.pin(12);
  session.undo();
  CHECK(session.simulation().stiffness(springs[1]) == 5000);
  session.undo();
  CHECK(session.simulation().stiffness(springs[1]) == 1000);
  session.unpin(25 + 4);   // of the first group of the second body
  session.unpin(25 + 20);  // of its second one
  session.restart(true);
  CHECK_FALSE(session.is_pinned(25 + 4));
  CHECK_FALSE(session.is_pinned(25 + 20));
  for (const Index pinned : {0, 4, 20, 25}) CHECK(session.is_pinned(pinned));
  session.move_pin(20, {3, 0, 0});
  session.drop_pin(20);
  session.restart(true);
  for (const PinnedVertex& pin : session.pinned_vertices()) {
    if (pin.vertex == 20) CHECK(pin.target == Vec3f(3, 0, 0));
    if (pin.vertex == 0) CHECK(pin.target != Vec3f(3, 0, 0));
  }
}

TEST_CASE("hooks: before each step, after restarts and rebuilds; a body that is added is there") {
  Session session(maker_of(make(), true));
  int steps = 0, restarts = 0, rebuilds = 0;
  session.set_hooks({.before_step = [&](Simulation&) { ++steps; },
                     .restarted = [&](Simulation& now) { restarts += now.state().step == 0 ? 1 : 100; },
                     .rebuilt = [&](Simulation& now) { rebuilds += now.state().step == 4 ? 1 : 100; }});
  positions_after(session, 4);
  session.pin(12);
  session.undo();
  session.set("force:whirl.strength", {3, 0, 0});
  session.undo();
  session.step();
  session.restart(true);
  session.step();
  CHECK(std::array{steps, restarts, rebuilds} == std::array{6, 1, 1});
  session.set_hooks(
      {.before_step = [](Simulation& now) { now.add_body(grid({.columns = 3, .rows = 3}), Mass::total(1)); }});
  session.step();
  CHECK(session.simulation().bodies().size() == 2);
  session.pin(26);  // of the new one
  session.set_hooks({});
  CHECK_THROWS_AS(session.undo(), Error);  // it is not in the copy
  session.step();
  CHECK(session.is_pinned(26));
  session.set_hooks({.before_step = [](Simulation&) { throw 7; }});
  CHECK_THROWS_WITH_AS(session.step(), "before_step has thrown something that is no std::exception",
                       std::runtime_error);
}

TEST_CASE("what cannot be copied runs, and says why it does not start over") {
  class Wave final : public Force {
   public:
    std::string_view type() const override { return "wave"; }
    void add_to(Positions& forces, const StateView&, Real) override { forces.col(0).array() += 0.01; }
  };
  Scene scene = make();
  scene.simulation.add_force(std::make_unique<Wave>(), "surf");
  Session session(maker_of(std::move(scene), false));
  positions_after(session, 3);
  CHECK_THROWS_WITH_AS(session.restart(true),
                       "this cannot start over: force 'surf': its type 'wave' cannot be copied; override copy() in it, "
                       "or make a second simulation as the first was made",
                       Error);
  CHECK(session.simulation().state().step == 3);
  positions_after(session, 3);
  session.set("force:whirl.strength", {5, 0, 0});
  session.undo();  // of a number, which needs no other scene
  CHECK(session.simulation().state().step == 6);
  const Scene closed = session.close();
  CHECK(closed.simulation.state().step == 6);
  CHECK(closed.simulation.find_force("surf").has_value());
}

}  // namespace test_copied_scene
