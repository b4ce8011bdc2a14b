#include <filesystem>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/materials/material_groups.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "tests/support/changed_session.h"
#include "tests/support/temporary_folder.h"

namespace test_session_edits {

using namespace pliant_tests;

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
  CHECK((positions(session) - positions(other)).cwiseAbs().maxCoeff() < 1e-12);
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
  CHECK((positions(session) - positions(undisturbed)).cwiseAbs().maxCoeff() < 1e-12);
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
  const Vec3f moved = pull.target + Vec3f(0, 0.1F, 0);
  CHECK((place(session, 30) - moved).norm() < 0.12F);  // one corner of the triangle that is held
  CHECK((place(session, 30) - moved).norm() < (place(session, 30) - pull.target).norm());
  session.let_go();
  session.step();
  // What the mouse held is in neither file.
  CHECK(TemporaryFolder::read(folder.path() / "pull.json").find(R"("type": "drag")") == std::string::npos);
  pliant::read_checkpoint(folder.path() / "pull.pliant").step();
}

}  // namespace test_session_edits
