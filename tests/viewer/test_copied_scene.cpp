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
  "events": [ { "step": 3, "release": "sheet.position", "vertices": [20] } ] })";

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
