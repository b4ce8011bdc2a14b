#include <filesystem>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/materials/material_groups.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "tests/support/temporary_folder.h"
#include "viewer/session.h"

namespace test_session_edits {

using namespace pliant_viewer;
using pliant_tests::TemporaryFolder;

namespace {

constexpr std::string_view sheet_text = R"({
  "pliant": 1,
  "settings": { "iterations": 10 },
  "bodies": [ {
    "name": "sheet",
    "mesh": { "shape": "grid", "columns": 9, "rows": 9, "size": [1, 1], "plane": "xz" },
    "mass": { "area_density": 0.3 },
    "constraints": [
      { "type": "position", "name": "hooks", "on": [72, 80] },
      { "type": "triangle_strain", "name": "stretch", "stiffness": 500 },
      { "type": "hinge", "name": "bend", "stiffness": 0.001 }
    ]
  }, {
    "name": "scarf",
    "mesh": { "shape": "grid", "columns": 6, "rows": 4, "size": [0.6, 0.4], "plane": "xz" },
    "transform": { "translate": [0, 1, 0] },
    "material": { "name": "silk", "direction": [1, 0, 0], "angle": 15 },
    "constraints": [ { "type": "position", "on": "corners" } ]
  } ],
  "forces": [ { "type": "wind", "velocity": [0, 0.5, 0], "drag": 1 } ],
  "colliders": [ { "type": "sphere", "name": "ball", "center": [0, 0.4, 0], "radius": 0.15, "velocity": [0, 0.1, 0] },
                 { "type": "capsule", "name": "bar", "from": [-1, 2, 0], "to": [1, 2, 0] } ],
  "moves": [ { "group": "hooks", "index": 1, "time": 0.2, "over": 1, "offset": [0.2, 0, 0] },
             { "group": "ball", "time": 0.3, "over": 0.5, "offset": [0, -0.6, 0] } ],
  "events": [ { "time": 0.25, "change": "bend", "stiffness": 0.01, "over": 0.3 } ]
})";

pliant::Scene make_scene() {
  return pliant::parse_scene(sheet_text, {}, "sheet");
}

const pliant::Positions& positions(const pliant::Simulation& simulation) {
  return simulation.state().positions;
}
const pliant::Positions& positions(const Session& session) {
  return positions(session.simulation());
}

void steps(Session& session, int count) {
  for (int i = 0; i < count; ++i) session.step();
}

double value(const Session& session, std::string_view key) {
  const std::vector<Slider> list = session.sliders();
  const auto found = std::ranges::find(list, key, &Slider::key);
  REQUIRE(found != list.end());
  return found->parameter.value[0];
}

Vec3f place(const Session& session, Index vertex) {
  return positions(session).row(vertex).transpose().cast<float>();
}

pliant::ColliderId collider(const Session& session, const char* name) {
  return session.simulation().find_collider(name).value();
}

/// One change of every kind; what is moved is moved before the first step.
void change_everything(Session& session) {
  const bool is_start = session.simulation().state().step == 0;
  session.set("settings.iterations", {14, 0, 0});
  session.set("contact.friction", {0.7, 0, 0});
  session.set("contact:scarf.distance", {0.013, 0, 0});
  session.set("group:bend.stiffness", {0.004, 0, 0});
  session.set("group:stretch.max_stretch", {1.03, 0, 0});
  session.set("group:scarf.bend.stiffness", {2e-5, 0, 0});
  session.set("force:gravity.acceleration", {0, 0.5, -8});
  session.set("force:wind.velocity", {0.3, 0.8, 0});
  session.set("collider:ball.radius", {0.2, 0, 0});
  session.pin(40);
  session.pin(90);
  session.unpin(72);
  if (is_start) {
    session.move_pin(90, place(session, 90) + Vec3f(0.02F, 0, 0.05F));
    session.drop_pin(90);
    session.move_pin(80, place(session, 80) + Vec3f(0, 0.1F, 0));
    session.drop_pin(80);
    for (const char* name : {"ball", "bar"}) {
      session.move_collider(collider(session, name), Vec3f(0.1F, 0.6F, 0.1F));
      session.drop_collider(collider(session, name));
    }
  }
}

}  // namespace

TEST_CASE("a saved scene, read again, runs with the bits of the session that starts over") {
  const TemporaryFolder folder;
  for (const bool with_material : {false, true}) {
    CAPTURE(with_material);
    Session session(make_scene);
    if (with_material) session.set_material("sheet", "wool");
    if (!with_material) change_everything(session);
    if (with_material) session.set("group:sheet.bend.stiffness", {3e-5, 0, 0});
    session.restart(true);
    const std::filesystem::path file = folder.path() / "saved.json";
    const pliant::Positions start = positions(session);
    CHECK(session.save(file, session.scene().view).size() == 1);
    CHECK(positions(session) == start);
    session.restart(true);
    pliant::Scene read = pliant::load_scene(file);
    CHECK(read.name == "saved");
    CHECK(positions(read.simulation) == start);
    for (int i = 0; i < 100; ++i) {
      CAPTURE(i);
      session.step();
      read.step();
      REQUIRE(positions(read.simulation) == positions(session));
    }
    CHECK_FALSE(positions(session) == start);
  }
}

TEST_CASE("a scene saved later goes on from its checkpoint with the bits of the session") {
  const TemporaryFolder folder;
  for (const int first : {3, 15, 30}) {
    CAPTURE(first);
    Session session(make_scene);
    steps(session, first);
    change_everything(session);
    session.set_material("scarf", "denim");
    steps(session, 7);
    const pliant::Positions before = positions(session);
    const auto files = session.save(folder.path() / "later.json", session.scene().view);
    REQUIRE(files.size() == 2);
    CHECK(files[1].filename() == "later.pliant");
    CHECK(positions(session) == before);
    CHECK(session.is_pinned(40));
    CHECK_FALSE(session.is_pinned(72));
    CHECK(value(session, "group:stretch.max_stretch") == 1.03);
    pliant::Scene resumed = pliant::read_checkpoint(files[1]);
    for (int i = 0; i < 100; ++i) {
      CAPTURE(i);
      session.step();
      resumed.step();
      REQUIRE(positions(resumed.simulation) == positions(session));
    }
  }
}

TEST_CASE("to save changes nothing of what goes on") {
  const TemporaryFolder folder;
  Session session(make_scene), other(make_scene);
  for (Session* each : {&session, &other}) {
    steps(*each, 18);
    change_everything(*each);
  }
  session.save(folder.path() / "on.json", session.scene().view);
  steps(session, 40);
  steps(other, 40);
  // The order of the groups, and with it rounding, may be another.
  CHECK((positions(session) - positions(other)).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("every change can be taken back and done again, one after the other, while time goes on") {
  for (const int first : {0, 20}) {
    CAPTURE(first);
    Session session(make_scene);
    steps(session, first);
    change_everything(session);
    session.set_material("sheet", "felt");
    const SceneChanges all = session.changes();
    CHECK(session.undone_next() == "sheet: felt");
    std::vector<std::string> undone;
    while (!session.undone_next().empty()) {
      undone.push_back(session.undone_next());
      const pliant::Positions before = positions(session);
      session.undo();
      CHECK((first == 0 || positions(session) == before));
      session.step();
      REQUIRE(positions(session).allFinite());
    }
    CHECK(session.changes().is_empty());
    CHECK(value(session, "settings.iterations") == 10);
    CHECK(value(session, "force:wind.velocity") == 0);
    CHECK(value(session, "group:stretch.max_stretch") == 1);
    CHECK(value(session, "collider:ball.radius") == 0.15);
    CHECK_FALSE(session.is_pinned(40));
    CHECK(session.is_pinned(72));
    CHECK(session.materials().front().material.empty());
    session.undo();  // nothing is left
    while (!session.redone_next().empty()) {
      CHECK(session.redone_next() == undone.back());
      undone.pop_back();
      session.redo();
      session.step();
    }
    CHECK(undone.empty());
    CHECK(session.changes() == all);
    CHECK(session.materials().front().material == "felt");
    CHECK(session.is_pinned(40));
    CHECK_FALSE(session.is_pinned(72));
    steps(session, 30);
    REQUIRE(positions(session).allFinite());
  }
}

TEST_CASE("what is taken back leaves the motion of an undisturbed session") {
  Session session(make_scene), undisturbed(make_scene);
  for (Session* each : {&session, &undisturbed}) steps(*each, 22);
  change_everything(session);
  session.set_material("scarf", "felt");
  while (!session.undone_next().empty()) session.undo();
  steps(session, 60);
  steps(undisturbed, 60);
  // Vertex 72 was let go and is a pin again, where it was; vertex 80 has been under way all the time.
  CHECK((positions(session) - positions(undisturbed)).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("a slider that goes on is one change; a new change drops what could be done again") {
  Session session(make_scene);
  session.set("group:bend.stiffness", {0.002, 0, 0});
  session.set("group:bend.stiffness", {0.003, 0, 0}, true);
  session.set("group:bend.stiffness", {0.004, 0, 0}, true);
  CHECK(session.undone_next() == "bend: stiffness");
  session.undo();
  CHECK(value(session, "group:bend.stiffness") == 0.001);
  CHECK(session.undone_next().empty());
  session.redo();
  CHECK(value(session, "group:bend.stiffness") == 0.004);
  session.undo();
  session.pin(3);
  CHECK(session.redone_next().empty());
  session.redo();
  CHECK(value(session, "group:bend.stiffness") == 0.001);
  session.set("group:bend.stiffness", {0.001, 0, 0});  // no change
  CHECK(session.undone_next() == "pin");
}

TEST_CASE("a restart keeps pins that were set, where their vertices begin; with all values as the file has them none") {
  Session session(make_scene);
  const Vec3f start = place(session, 4);
  steps(session, 30);
  session.pin(4);
  session.unpin(80);
  CHECK((place(session, 4) - start).norm() > 1e-3F);
  session.restart(true);
  CHECK(session.is_pinned(4));
  CHECK_FALSE(session.is_pinned(80));
  steps(session, 30);
  CHECK((place(session, 4) - start).norm() < 1e-6F);
  // What the mouse pinned has no row.
  for (const Slider& slider : session.sliders()) CHECK(slider.parameter.name != "sheet.pins");
  session.unpin(4);
  session.undo();
  CHECK(session.is_pinned(4));
  session.restart(false);
  CHECK_FALSE(session.is_pinned(4));
  CHECK(session.is_pinned(80));
  CHECK(session.undone_next().empty());
}

TEST_CASE("what is moved before the first step begins there; what is moved later does not") {
  Session session(make_scene);
  const auto ball = [&] { return session.simulation().pose(collider(session, "ball")).position; };
  session.move_collider(collider(session, "ball"), Vec3f(0.25F, 0.5F, -0.25F));
  session.drop_collider(collider(session, "ball"));
  CHECK(ball() == pliant::Vec3(0.25, 0.5, -0.25));
  CHECK(session.undone_next() == "move a collider");
  steps(session, 10);
  CHECK(ball().y() > 0.5);  // it has its velocity
  const Vec3f pin = place(session, 80);
  session.move_pin(80, pin + Vec3f(0, 0.2F, 0));
  session.drop_pin(80);
  session.move_collider(collider(session, "ball"), Vec3f(0.5F, 0.5F, 0));
  session.drop_collider(collider(session, "ball"));
  CHECK(session.undone_next() == "move a collider");
  steps(session, 20);
  session.restart(true);
  CHECK(ball() == pliant::Vec3(0.25, 0.5, -0.25));
  CHECK((place(session, 80) - pin).norm() < 1e-6F);
  steps(session, 5);
  session.undo();
  steps(session, 60);
  CHECK(ball().y() < 0.3);  // on its way again, from where the scene has it
}

TEST_CASE("a session under a pull can be saved and taken back, and still pulls") {
  const TemporaryFolder folder;
  Session session(make_scene);
  steps(session, 5);
  session.pin(10);
  Pull pull{{{30, 31, 40}, {0.4F, 0.3F, 0.3F}}, place(session, 30) + Vec3f(0, 0.3F, 0), 1e4};
  session.grab(pull);
  steps(session, 5);
  session.save(folder.path() / "pull.json", session.scene().view);
  REQUIRE(session.pull().has_value());
  session.pull_to(pull.target + Vec3f(0, 0.1F, 0));
  session.undo();
  steps(session, 60);
  CHECK((place(session, 30) - pull.target).norm() < 0.2F);
  session.let_go();
  session.step();
  // What the mouse held is in neither file.
  CHECK(TemporaryFolder::read(folder.path() / "pull.json").find("drag\"") ==
        TemporaryFolder::read(folder.path() / "pull.json").rfind("drag\""));
  pliant::read_checkpoint(folder.path() / "pull.pliant").step();
}

TEST_CASE("a saved scene stands by itself: included scenes are in it, files are found from its folder") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "meshes");
  folder.write("meshes/quad.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3\nf 1 3 4\n");
  folder.write("part.json", R"({"pliant": 1, "bodies": [{"name": "quad", "mesh": {"file": "meshes/quad.obj"},
    "mass": {"total": 1}, "constraints": [{"type": "edge_spring"}]}],
    "forces": [{"type": "test_force", "vertex": 2, "force": [0, 1, 0]}]})");
  folder.write("whole.json", R"({"pliant": 1, "include": "part.json", "bodies": [{"name": "rope",
    "mesh": {"vertices": [[0, 1, 0], [0.1, 1, 0], [0.2, 1, 0]], "edges": [[0, 1], [1, 2]]}, "mass": {"total": 1}, "constraints": [{"type": "edge_spring"}]}],
    "events": [{"step": 2, "add": {"type": "position", "body": "rope", "on": [0]}}]})");
  Session session([&] { return pliant::load_scene(folder.path() / "whole.json"); });
  session.pin(0);
  session.restart(true);
  session.save(folder.path() / "mine.json", session.scene().view);
  const std::string text = TemporaryFolder::read(folder.path() / "mine.json");
  CHECK(text.find("include") == text.npos);
  CHECK(text.find(R"("file": "meshes/quad.obj")") != text.npos);
  std::filesystem::create_directories(folder.path() / "elsewhere");
  session.save(folder.path() / "elsewhere/mine.json", session.scene().view);
  CHECK(
      TemporaryFolder::read(folder.path() / "elsewhere/mine.json").find((folder.path() / "meshes/quad.obj").string()) !=
      text.npos);
  std::filesystem::remove(folder.path() / "part.json");
  for (const char* name : {"mine.json", "elsewhere/mine.json"}) {
    pliant::Scene read = pliant::load_scene(folder.path() / name);
    Session again([&] { return pliant::load_scene(folder.path() / name); });
    for (int i = 0; i < 10; ++i) read.step();
    steps(again, 10);
    CHECK(positions(read.simulation) == positions(again));
  }
}

TEST_CASE("every built-in scene can be saved, and is the same scene then") {
  const TemporaryFolder folder;
  for (const pliant::BuiltinScene& builtin : pliant::builtin_scenes()) {
    CAPTURE(builtin.name);
    const auto make = [&] { return pliant::parse_scene(builtin.text, {}, builtin.name); };
    pliant::Scene scene = make();
    if (scene.simulation.state().vertex_count() > 3000) continue;
    Session session(make);
    session.save(folder.path() / "saved.json", session.scene().view);
    pliant::Scene read = pliant::load_scene(folder.path() / "saved.json");
    CHECK(read.view.camera.position == scene.view.camera.position);
    CHECK(read.steps == scene.steps);
    for (int i = 0; i < 3; ++i) {
      scene.step();
      read.step();
    }
    CHECK(positions(read.simulation) == positions(scene.simulation));
  }
}

TEST_CASE("how it is shown is saved with it") {
  const TemporaryFolder folder;
  Session session(make_scene);
  pliant::ViewSettings view = session.scene().view;
  view.color = pliant::ColorBy::stretch;
  view.wireframe = true;
  view.background = {0.1, 0.2, 0.3};
  view.camera = {.position = pliant::Vec3(1, -4, 2), .target = pliant::Vec3(0, 0, 0.5)};
  session.save(folder.path() / "seen.json", view);
  const pliant::ViewSettings read = pliant::load_scene(folder.path() / "seen.json").view;
  CHECK(read.color == pliant::ColorBy::stretch);
  CHECK(read.wireframe);
  CHECK(read.background.green == 0.2);
  CHECK(read.camera.position == view.camera.position);
  CHECK(read.camera.target == view.camera.target);
  CHECK(read.shadow);
}

TEST_CASE("a scene that a program has made keeps its changes, and takes them back; it has no text to save") {
  const auto make = [] {
    pliant::Scene scene = make_scene();
    scene.source = {};
    scene.places.clear();
    return scene;
  };
  const TemporaryFolder folder;
  Session session(make), read(make_scene);
  for (Session* each : {&session, &read}) {
    change_everything(*each);
    each->set_material("scarf", "denim");
    each->set("group:scarf.bend.stiffness", {3e-5, 0, 0});
    each->restart(true);
  }
  CHECK_THROWS_WITH_AS(session.save(folder.path() / "none.json", session.scene().view), doctest::Contains("program"),
                       pliant::Error);
  CHECK(session.is_pinned(40));
  CHECK_FALSE(session.is_pinned(72));
  CHECK(session.materials().at(1).material == "denim");
  for (const char* key : {"group:scarf.bend.stiffness", "force:wind.velocity", "settings.iterations"}) {
    CHECK(value(session, key) == value(read, key));
  }
  steps(session, 20);
  while (!session.undone_next().empty()) session.undo();
  CHECK(session.changes().is_empty());
  CHECK(session.is_pinned(72));
  CHECK(value(session, "settings.iterations") == 10);
  steps(session, 20);
  REQUIRE(positions(session).allFinite());
}

TEST_CASE("what cannot be saved leaves the session as it is") {
  const TemporaryFolder folder;
  Session session(make_scene);
  steps(session, 4);
  CHECK_THROWS_AS(session.save(folder.path() / "none/saved.json", session.scene().view), pliant::Error);
  CHECK(session.simulation().state().step == 4);
  session.step();
}

TEST_CASE("events that cannot act any longer are left out of what is saved, and said") {
  const TemporaryFolder folder;
  for (const int first : {0, 4, 20}) {
    CAPTURE(first);
    Session session(make_scene);
    steps(session, first);
    session.unpin(80);
    session.set_material("sheet", "wool");
    const std::filesystem::path file = folder.path() / "saved.json";
    session.save(file, session.scene().view);
    CHECK(session.note().find("left out") != std::string::npos);
    const std::string text = TemporaryFolder::read(file);
    CHECK(text.find(R"("group": "hooks")") == text.npos);
    CHECK(text.find(R"("group": "ball")") != text.npos);
    CHECK(text.find(R"("change": "bend")") == text.npos);
    pliant::Scene read = pliant::load_scene(file);
    CHECK(read.timeline.event_count() == 2);  // the ball's, and the pin that is let go
    session.undo();
    session.undo();
    CHECK(session.is_pinned(80));
    steps(session, 40);
    session.restart(true);
    CHECK(session.scene().timeline.event_count() == 3);
    Session other(make_scene);
    steps(session, 40);
    steps(other, 40);
    CHECK(positions(session) == positions(other));
  }
}

}  // namespace test_session_edits
