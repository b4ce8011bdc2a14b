#include <filesystem>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/materials/material_groups.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "tests/support/changed_session.h"
#include "tests/support/temporary_folder.h"

namespace test_saved_scenes {

using namespace pliant_tests;

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

TEST_CASE("a camera that moves is saved with all of its moments") {
  const TemporaryFolder folder;
  Session session(make_scene);
  pliant::ViewSettings view = session.scene().view;
  view.camera = {
      .keyframes = {{.time = 0, .position = {0, 0, 0}},
                    {.time = 2, .position = {1, -4, 2}, .target = pliant::Vec3(0, 0, 1), .field_of_view = 30}}};
  session.save(folder.path() / "seen.json", view);
  const std::vector<pliant::CameraKeyframe> read =
      pliant::load_scene(folder.path() / "seen.json").view.camera.keyframes;
  REQUIRE(read.size() == 2);
  CHECK(read[0].time == 0);
  CHECK(read[0].position == pliant::Vec3(0, 0, 0));
  CHECK_FALSE(read[0].target.has_value());
  CHECK(read[1].time == 2);
  CHECK(read[1].target == pliant::Vec3(0, 0, 1));
  CHECK(read[1].field_of_view == 30);
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

TEST_CASE("a pin of the scene that was let go and set again can be let go again, and moved") {
  const TemporaryFolder folder;
  for (const int first : {0, 6}) {
    CAPTURE(first);
    Session session(make_scene);
    steps(session, first);
    session.unpin(72);
    session.pin(72);
    session.unpin(72);
    session.restart(true);
    CHECK_FALSE(session.is_pinned(72));
    session.pin(72);
    const Vec3f to = place(session, 72) + Vec3f(0, 0.1F, 0);
    session.move_pin(72, to);
    session.drop_pin(72);
    session.restart(true);
    session.step();
    CHECK((place(session, 72) - to).norm() < 1e-6F);
    session.save(folder.path() / "again.json", session.scene().view);
    session.undo();  // the move
    session.step();
    CHECK(session.is_pinned(72));
    session.undo();
    CHECK_FALSE(session.is_pinned(72));
    session.undo();
    CHECK(session.is_pinned(72));
  }
}

TEST_CASE("the factor of a list of stiffnesses is a factor after a restart, and in the list of a saved scene") {
  const TemporaryFolder folder;
  const std::string text = R"({"pliant": 1, "bodies": [{"name": "rope", "mass": {"total": 1},
    "mesh": {"vertices": [[0, 0, 0], [0.1, 0, 0], [0.2, 0, 0]], "edges": [[0, 1], [1, 2]]},
    "constraints": [{"type": "position", "on": [0]},
      {"type": "edge_spring", "name": "s", "stencils": [[0, 1], [1, 2]], "stiffness": [50, 70]}]}]})";
  const auto make = [&] { return pliant::parse_scene(text, {}, "rope"); };
  Session session(make), other(make);
  session.set("group:s.stiffness", {2, 0, 0});
  session.restart(true);
  CHECK(value(session, "group:s.stiffness") == 2);
  steps(session, 5);
  session.save(folder.path() / "rope.json", session.scene().view);
  CHECK(value(session, "group:s.stiffness") == 2);
  CHECK(TemporaryFolder::read(folder.path() / "rope.json").find("[100.0, 140.0]") != std::string::npos);
  pliant::Scene resumed = pliant::read_checkpoint(folder.path() / "rope.pliant");
  steps(session, 20);
  for (int i = 0; i < 20; ++i) resumed.step();
  CHECK(positions(resumed.simulation) == positions(session));
  session.undo();
  CHECK(value(session, "group:s.stiffness") == 1);
  session.restart(true);
  steps(session, 10);
  steps(other, 10);
  CHECK(positions(session) == positions(other));
}

TEST_CASE("what is undone after a restart is as the scene has it, not as its events had made it") {
  Session session(make_scene);
  steps(session, 50);  // bending is ten times as stiff by now
  CHECK(value(session, "group:bend.stiffness") == doctest::Approx(0.01));
  session.set("group:bend.stiffness", {0.05, 0, 0});
  session.undo();
  CHECK(value(session, "group:bend.stiffness") == doctest::Approx(0.01));
  session.redo();
  session.restart(true);
  session.undo();
  CHECK(value(session, "group:bend.stiffness") == 0.001);
}

TEST_CASE("a scene that is saved at its start has no checkpoint of another time beside it") {
  const TemporaryFolder folder;
  Session session(make_scene);
  steps(session, 5);
  CHECK_FALSE(session.has_unsaved_changes());
  session.pin(3);
  CHECK(session.has_unsaved_changes());
  session.save(folder.path() / "a.json", session.scene().view);
  CHECK_FALSE(session.has_unsaved_changes());
  CHECK(folder.file_count() == 2);
  session.restart(true);
  session.save(folder.path() / "a.json", session.scene().view);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("ties of a solid's surface keep what was set, and are not in the file") {
  const TemporaryFolder folder;
  const auto make = [] {
    return pliant::parse_scene(R"({"pliant": 1, "bodies": [{"name": "ball", "solid": {"spacing": 0.2},
      "mesh": {"shape": "sphere", "radius": 0.3}, "material": "foam"}]})",
                               {}, "ball");
  };
  Session session(make);
  session.set("group:ball.surface.stiffness", {1234, 0, 0});
  session.restart(true);
  CHECK(value(session, "group:ball.surface.stiffness") == 1234);
  session.save(folder.path() / "ball.json", session.scene().view);
  CHECK(session.note().find("ball.surface") != std::string::npos);
  CHECK(value(session, "group:ball.surface.stiffness") == 1234);
  session.undo();
  CHECK(value(session, "group:ball.surface.stiffness") != 1234);
}

TEST_CASE("constraints without a name keep theirs when a material takes others away") {
  const auto make = [] {
    return pliant::parse_scene(R"({"pliant": 1, "bodies": [{"name": "sheet", "mass": {"area_density": 0.2},
      "mesh": {"shape": "grid", "columns": 5, "rows": 5, "size": [1, 1]},
      "constraints": [{"type": "edge_spring"}, {"type": "edge_spring", "on": [0, 1, 2, 3, 4], "stiffness": 9},
                      {"type": "position", "on": [0]}]}],
      "events": [{"step": 3, "change": "sheet.edge_spring 2", "stiffness": 11}]})",
                               {}, "sheet");
  };
  Session session(make);
  session.set_material("sheet", "silk");
  session.set("group:sheet.edge_spring 2.stiffness", {10, 0, 0});
  session.restart(true);
  CHECK(session.note().empty());
  CHECK(value(session, "group:sheet.edge_spring 2.stiffness") == 10);
  steps(session, 5);
  CHECK(value(session, "group:sheet.edge_spring 2.stiffness") == 11);
}

TEST_CASE("a session may begin with a checkpoint, goes on from there, and starts over at the start") {
  const TemporaryFolder folder;
  Session first(make_scene);
  steps(first, 20);
  first.pin(40);
  first.save(folder.path() / "first.json", first.scene().view);
  bool is_begun = false;
  pliant::SceneSource source;
  Session second([&] {
    if (is_begun) return pliant::parse_scene(source);
    is_begun = true;
    pliant::Scene scene = pliant::read_checkpoint(folder.path() / "first.pliant");
    source = scene.source;
    return scene;
  });
  CHECK(second.simulation().state().step == 20);
  CHECK(second.is_pinned(40));
  for (Session* each : {&first, &second}) steps(*each, 10);
  CHECK(positions(first) == positions(second));
  second.set_material("sheet", "wool");
  second.unpin(40);
  steps(second, 5);
  second.undo();
  second.undo();
  CHECK(second.is_pinned(40));
  second.save(folder.path() / "second.json", second.scene().view);
  for (Session* each : {&first, &second}) {
    each->restart(true);
    steps(*each, 30);
  }
  CHECK(positions(first) == positions(second));
}

}  // namespace test_saved_scenes
