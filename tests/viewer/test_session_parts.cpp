// What is switched off, and what is added, by hand: undone, saved, recorded.
#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/pliant.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "tests/support/changed_session.h"
#include "tests/support/replayed_session.h"
#include "tests/support/temporary_folder.h"
#include "viewer/added_parts.h"

namespace test_session_parts {

using namespace pliant_tests;
namespace {

bool has_group(const Session& session, const std::string& name) {
  return session.simulation().find_group(name).has_value();
}

bool has_force(const Session& session, const std::string& name) {
  return session.simulation().find_force(name).has_value();
}

/// Holds what a replay, the saved scene, its checkpoint and a restart come to against each other; returns the saved
/// one.
pliant::Scene check_kept(Session& session, const TemporaryFolder& folder) {
  const Session again = replayed(session, folder);
  CHECK(positions(again) == positions(session));
  CHECK(again.changes() == session.changes());
  const auto files = session.save(folder.path() / "kept.json", session.scene().view);
  REQUIRE(files.size() == 2);
  pliant::Scene saved = pliant::load_scene(files[0]);
  pliant::Scene resumed = pliant::read_checkpoint(files[1]);
  for (int i = 0; i < 20; ++i) {
    session.step();
    resumed.step();
    saved.step();
  }
  CHECK(positions(resumed.simulation) == positions(session));
  session.restart(true);
  steps(session, 20);
  CHECK(positions(saved.simulation) == positions(session));
  return saved;
}

}  // namespace

TEST_CASE("a constraint and a force are switched off and on while time goes on") {
  Session session(make_scene);
  steps(session, 5);
  session.set("group:bend.stiffness", {0.02, 0, 0});
  const std::size_t groups = session.simulation().groups().size();
  CHECK(session.switches().at("bend"));
  const pliant::Positions before = positions(session);
  session.switch_on("bend", false);
  CHECK_FALSE(has_group(session, "bend"));
  CHECK(session.simulation().groups().size() == groups - 1);
  CHECK_FALSE(session.switches().at("bend"));
  CHECK(session.changes().switched_off.at("bend").body == "sheet");
  CHECK(positions(session) == before);
  CHECK(session.simulation().state().step == 5);
  session.switch_on("bend", false);  // no change
  CHECK(session.undone_next() == "bend off");
  for (const auto& [name, on] : session.switches()) {
    if (on && has_force(session, name)) session.switch_on(name, false);
  }
  CHECK(session.simulation().forces().empty());
  steps(session, 5);
  session.undo();
  CHECK(session.simulation().forces().size() == 1);
  session.switch_on("bend", true);
  CHECK(value(session, "group:bend.stiffness") == 0.02);
  CHECK(session.undone_next() == "bend on");
  session.undo();
  CHECK_FALSE(has_group(session, "bend"));
  session.restart(true);
  CHECK_FALSE(has_group(session, "bend"));
  session.restart(false);
  CHECK(has_group(session, "bend"));
  CHECK(session.switches().at("bend"));
}

TEST_CASE("pins that are switched off let go, and hold again where the scene has them") {
  Session session(make_scene);
  steps(session, 3);
  const Vec3f held = place(session, 72);
  session.switch_on("hooks", false);
  steps(session, 30);
  CHECK((place(session, 72) - held).norm() > 0.1F);
  session.switch_on("hooks", true);
  steps(session, 3);
  CHECK((place(session, 72) - held).norm() < 1e-5F);
}

TEST_CASE("what is switched off is off in the saved scene, in its checkpoint and in a replay, with the same bits") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.switch_on("bend", false);
  steps(session, 12);
  session.switch_on("gravity", false);
  steps(session, 6);
  const pliant::Scene saved = check_kept(session, folder);
  CHECK_FALSE(saved.simulation.find_group("bend").has_value());
  CHECK_FALSE(saved.simulation.find_force("gravity").has_value());
}

TEST_CASE("what the scene's own events have acted on from the start on is switched off while they go on") {
  const TemporaryFolder folder;
  std::string text(sheet_text);
  text.replace(text.find("\"time\": 0.2,"), 12, "\"time\": 0, ");
  text.replace(text.find("\"time\": 0.25"), 12, "\"time\": 0.02");
  Session session([text] { return pliant::parse_scene(text, {}, "sheet"); });
  steps(session, 10);
  session.switch_on("hooks", false);
  session.switch_on("bend", false);  // whose stiffness is on its way
  session.switch_on("wind", false);
  session.switch_on("ball", false);
  steps(session, 30);
  session.set("settings.iterations", {12, 0, 0});
  session.pin(30);
  const auto files = session.save(folder.path() / "off.json", session.scene().view);
  steps(session, 5);
  for (const char* name : {"hooks", "bend", "wind", "ball"}) session.switch_on(name, true);
  steps(session, 5);
  CHECK(has_group(session, "hooks"));
  for (int i = 0; i < 6; ++i) session.undo();
  CHECK_FALSE(has_group(session, "hooks"));
  const Session again = replayed(session, folder);
  CHECK(positions(again) == positions(session));
  pliant::Scene saved = pliant::load_scene(files.at(0));
  CHECK_FALSE(saved.simulation.find_group("hooks").has_value());
  CHECK_FALSE(saved.simulation.find_collider("ball").has_value());
  saved.step();
}

TEST_CASE("the stiffness of a material's group is on its way while that is switched off") {
  const TemporaryFolder folder;
  Session session([] {
    return pliant::parse_scene(R"({ "pliant": 1, "bodies": [ { "name": "scarf", "material": "silk",
      "mesh": { "shape": "grid", "columns": 6, "rows": 6 }, "constraints": [ { "type": "position", "on": "corners" } ]
      } ], "events": [ { "step": 0, "change": "scarf.bend", "stiffness": 1e-4, "over": 1 } ] })",
                               {}, "scarf");
  });
  steps(session, 5);
  session.switch_on("scarf.bend", false);
  steps(session, 5);
  session.pin(8);  // which makes the scene anew
  const auto files = session.save(folder.path() / "off.json", session.scene().view);
  CHECK_FALSE(pliant::read_checkpoint(files.at(1)).simulation.find_group("scarf.bend").has_value());
  steps(session, 5);
  CHECK_FALSE(has_group(session, "scarf.bend"));
  session.switch_on("scarf.bend", true);
  steps(session, 5);
  CHECK(has_group(session, "scarf.bend"));
}

TEST_CASE("vertices of pins that are switched off are pinned by hand as any other") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.switch_on("hooks", false);
  steps(session, 10);
  session.pin(72);
  steps(session, 10);
  session.restart(true);
  CHECK(session.is_pinned(72));
  CHECK_FALSE(session.is_pinned(80));
  const auto files = session.save(folder.path() / "pinned.json", session.scene().view);
  CHECK_FALSE(pliant::load_scene(files.at(0)).simulation.find_group("hooks").has_value());
  session.undo();
  session.undo();
  CHECK(session.is_pinned(80));
  // Let go, pinned again, and then the others are switched off.
  session.unpin(72);
  session.pin(72);
  session.switch_on("hooks", false);
  CHECK(session.is_pinned(72));
  CHECK_FALSE(session.is_pinned(80));
  session.restart(true);
  CHECK(session.is_pinned(72));
  session.unpin(72);
  session.switch_on("hooks", true);
  CHECK_FALSE(session.is_pinned(72));
  CHECK(session.is_pinned(80));
}

TEST_CASE("pins that are switched on again hold the vertices that were pinned by hand meanwhile") {
  Session session(make_scene);
  const Vec3f held = place(session, 72);
  session.switch_on("hooks", false);
  session.pin(72);
  session.pin(40);
  steps(session, 5);
  session.switch_on("hooks", true);
  steps(session, 5);
  CHECK(session.is_pinned(72));
  CHECK(session.is_pinned(40));
  CHECK((place(session, 72) - held).norm() < 1e-5F);
  session.unpin(72);
  CHECK_FALSE(session.is_pinned(72));
  session.undo();
  session.undo();
  CHECK(session.is_pinned(72));
  CHECK_FALSE(session.is_pinned(80));
}

TEST_CASE("what events add later keeps its name, and what they set again cannot be switched off") {
  const TemporaryFolder folder;
  Session session([] {
    return pliant::parse_scene(R"({ "pliant": 1, "bodies": [ { "name": "sheet", "mass": { "total": 1 },
      "mesh": { "shape": "grid", "columns": 5, "rows": 5 } } ],
      "colliders": [ { "type": "sphere", "center": [0, 0, -2] } ],
      "events": [ { "step": 2, "add": { "type": "sphere", "center": [0, 0, -7] } },
                  { "step": 2, "add": { "type": "wind", "velocity": [1, 0, 0] } },
                  { "step": 4, "gravity": [0, 0, -1] } ] })",
                               {}, "sheet");
  });
  CHECK_FALSE(session.switches().contains("gravity"));
  session.add("wind");
  CHECK(has_force(session, "wind 2"));  // the first is to come
  steps(session, 3);
  CHECK(has_force(session, "wind"));
  CHECK(value(session, "force:wind.velocity") == 1);
  session.switch_on("sphere", false);
  CHECK(session.simulation().pose(collider(session, "sphere 2")).position.z() == -7);
  session.switch_on("sphere", true);
  CHECK(session.simulation().pose(collider(session, "sphere")).position.z() == -2);
  steps(session, 3);
  CHECK(session.note().empty());
}

TEST_CASE("a collider that would be under the floor is added above the bodies") {
  Session session([] {
    return pliant::parse_scene(R"({ "pliant": 1, "bodies": [ { "name": "sheet", "mass": { "total": 1 },
      "mesh": { "shape": "grid", "columns": 5, "rows": 5 } } ],
      "colliders": [ { "type": "plane", "position": [0, 0, -0.1] } ] })",
                               {}, "sheet");
  });
  session.add("sphere");
  CHECK(session.simulation().pose(collider(session, "sphere")).position.z() > 0.1);
}

TEST_CASE("what is added is left out where the scene's file has come to have its name") {
  const TemporaryFolder folder;
  const std::string text = R"({ "pliant": 1, "bodies": [ { "name": "ball", "mass": { "total": 1 },
      "mesh": { "shape": "sphere" } } ])";
  const auto file = folder.write("ball.json", text + "}");
  Session session([file] { return pliant::load_scene(file); });
  session.add("wind");
  session.add("pressure", "ball");
  folder.write("ball.json", R"({ "pliant": 1, "bodies": [ { "name": "globe", "mass": { "total": 1 },
      "mesh": { "shape": "sphere" } } ], "forces": [ { "type": "wind", "velocity": [7, 0, 0] } ] })");
  session.restart(true);
  CHECK(session.simulation().forces().size() == 2);  // gravity, and the file's wind
  CHECK(value(session, "force:wind.velocity") == 7);
}

TEST_CASE("names that follow from an order stay when one of them is switched off") {
  const TemporaryFolder folder;
  Session session([] {
    return pliant::parse_scene(R"({ "pliant": 1, "bodies": [ { "name": "sheet", "mass": { "total": 1 },
      "mesh": { "shape": "grid", "columns": 5, "rows": 5 } } ],
      "forces": [ { "type": "wind" }, { "type": "wind", "velocity": [1, 0, 0] } ],
      "colliders": [ { "type": "sphere", "center": [0, 0, -2] }, { "type": "sphere", "center": [0, 0, -5] } ] })",
                               {}, "sheet");
  });
  session.switch_on("wind", false);
  session.switch_on("sphere", false);
  steps(session, 2);
  CHECK_FALSE(has_force(session, "wind"));
  CHECK(has_force(session, "wind 2"));
  CHECK(session.simulation().pose(collider(session, "sphere 2")).position.z() == -5);
  const auto files = session.save(folder.path() / "one.json", session.scene().view);
  CHECK(pliant::load_scene(files.at(0)).simulation.find_force("wind 2").has_value());
}

TEST_CASE("another material forgets what was set of groups that are switched off") {
  Session session(make_scene);
  session.set_material("sheet", "denim");
  const double usual = value(session, "group:sheet.bend.stiffness");
  session.undo();
  session.set_material("sheet", "wool");
  session.set("group:sheet.bend.stiffness", {0.5, 0, 0});
  session.switch_on("sheet.bend", false);
  session.set_material("sheet", "denim");
  session.restart(true);
  CHECK(value(session, "group:sheet.bend.stiffness") == doctest::Approx(usual));
}

TEST_CASE("groups of a material are switched off by name, and forgotten with it") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.set_material("sheet", "wool");
  session.switch_on("sheet.bend", false);
  CHECK_FALSE(has_group(session, "sheet.bend"));
  const auto files = session.save(folder.path() / "wool.json", session.scene().view);
  Session saved([&] { return pliant::load_scene(files.at(0)); });
  saved.step();
  CHECK_FALSE(has_group(saved, "sheet.bend"));
  session.set_material("sheet", "denim");
  CHECK(has_group(session, "sheet.bend"));
  CHECK(session.switches().at("sheet.bend"));
  session.undo();
  CHECK_FALSE(has_group(session, "sheet.bend"));
}

TEST_CASE("a constraint of the scene's own that a material takes the place of is no longer switched off") {
  Session session(make_scene);
  session.switch_on("bend", false);
  session.set_material("sheet", "wool");
  CHECK_FALSE(session.switches().contains("bend"));
  steps(session, 3);
  session.undo();
  CHECK_FALSE(session.switches().at("bend"));
  session.undo();
  CHECK(has_group(session, "bend"));
}

TEST_CASE("what cannot be switched off is told, and nothing has changed") {
  Session session(make_scene);
  CHECK_THROWS_AS(session.switch_on("nothing", false), pliant::Error);
  session.switch_on("nothing", true);
  session.pin(4);
  CHECK_THROWS_AS(session.switch_on("sheet.pins", false), pliant::Error);
  CHECK_FALSE(session.switches().contains("sheet.pins"));
  CHECK(session.undone_next() == "pin");
  CHECK(session.is_pinned(4));
}

TEST_CASE("forces and colliders are added, changed, switched off, undone, saved and recorded") {
  const TemporaryFolder folder;
  Session session(make_scene);
  steps(session, 10);
  const pliant::Positions before = positions(session);
  const auto pose = [&](const char* name) { return session.simulation().pose(collider(session, name)).position; };
  const pliant::Vec3 ball = pose("ball");
  session.add("wind");
  session.add("sphere");
  session.add("box");  // whose name comes before that of the sphere
  session.add("sphere");
  CHECK(positions(session) == before);
  CHECK(has_force(session, "wind 2"));  // the scene has one
  CHECK(session.undone_next() == "add sphere 2");
  CHECK(pose("ball") == ball);
  // They stand beneath all bodies.
  for (const char* name : {"sphere", "box", "sphere 2"}) CHECK(pose(name).z() < before.col(2).minCoeff());
  session.set("force:wind 2.velocity", {0, -3, 0});
  session.set("collider:sphere.radius", {0.05, 0, 0});
  session.move_collider(collider(session, "sphere 2"), pose("sphere 2").cast<float>() + Vec3f(0.3F, 0, 0));
  const pliant::Vec3 start = pose("sphere 2");
  session.step();
  session.add("capsule");  // while another one is on its way
  steps(session, 60);
  CHECK((pose("sphere 2") - start).isApprox(pliant::Vec3(0.3, 0, 0), 1e-5));
  session.drop_collider(collider(session, "sphere 2"));
  session.switch_on("box", false);
  CHECK_FALSE(session.simulation().find_collider("box").has_value());
  session.switch_on("wind 2", false);
  CHECK_FALSE(has_force(session, "wind 2"));
  session.undo();
  const pliant::Scene saved = check_kept(session, folder);
  CHECK(saved.simulation.find_force("wind 2").has_value());
  CHECK_FALSE(saved.simulation.find_collider("box").has_value());
  CHECK(saved.simulation.options<pliant::SphereCollider>(*saved.simulation.find_collider("sphere"))->radius == 0.05);
  for (int i = 0; i < 9; ++i) session.undo();
  CHECK_FALSE(has_force(session, "wind 2"));
  CHECK_FALSE(session.simulation().find_collider("sphere").has_value());
  CHECK(session.changes().is_empty());
}

TEST_CASE("what is added is moved before the first step, and begins there") {
  const TemporaryFolder folder;
  Session session(make_scene);
  for (const char* type : {"sphere", "capsule", "box"}) {
    CAPTURE(type);
    session.add(type);
    const pliant::ColliderId id = collider(session, type);
    const Vec3f to = session.simulation().pose(id).position.cast<float>() + Vec3f(0.25F, 0.5F, -0.25F);
    session.move_collider(id, to);
    session.drop_collider(id);
    CHECK(session.simulation().pose(collider(session, type)).position.isApprox(to.cast<double>(), 1e-7));
    const auto files = session.save(folder.path() / "moved.json", session.scene().view);
    const pliant::Scene saved = pliant::load_scene(files.at(0));
    CHECK(saved.simulation.pose(*saved.simulation.find_collider(type)).position.isApprox(to.cast<double>(), 1e-7));
  }
}

TEST_CASE("selected vertices are pushed by a test force of each body") {
  const TemporaryFolder folder;
  Session session(make_scene);
  steps(session, 5);
  session.push({3, 4, 5, 90});
  CHECK(session.undone_next() == "push");
  CHECK(has_force(session, "test_force"));
  CHECK(has_force(session, "test_force 2"));
  const auto* force = session.simulation().options<pliant::TestForce>(*session.simulation().find_force("test_force"));
  REQUIRE(force != nullptr);
  const std::vector<Real>& masses = session.simulation().state().masses;
  Real weight = 0;
  for (std::size_t i = 0; i < 81; ++i) weight += 9.81 * masses[i];
  CHECK(3 * force->force[0].z() == doctest::Approx(weight));
  const float before = place(session, 4).z();
  steps(session, 10);
  CHECK(place(session, 4).z() > before + 0.01F);
  const Session again = replayed(session, folder);
  CHECK(positions(again) == positions(session));
  const auto files = session.save(folder.path() / "pushed.json", session.scene().view);
  CHECK(pliant::load_scene(files.at(0)).simulation.find_force("test_force 2").has_value());
  session.undo();
  CHECK_FALSE(has_force(session, "test_force"));
  CHECK_THROWS_AS(session.push({100'000}), pliant::Error);
  session.push({});
  CHECK(session.undone_next().empty());
}

TEST_CASE("all that is offered can be added, or says why not") {
  for (const AddableType& type : addable_types()) {
    CAPTURE(type.name);
    Session session([] {
      return pliant::parse_scene(R"({ "pliant": 1, "bodies": [
        { "name": "ball", "mesh": { "shape": "sphere" }, "mass": { "total": 1 } },
        { "name": "rope", "mesh": { "shape": "chain" }, "mass": { "total": 1 } } ] })",
                                 {}, "two");
    });
    session.add(std::string(type.name), type.is_of_body ? "ball" : "");
    session.step();
    CHECK(session.changes().added.size() == 1);
    const SceneChanges changes = session.changes();
    if (type.is_of_body) CHECK_THROWS_AS(session.add(std::string(type.name), "rope"), pliant::Error);
    if (type.is_of_body) CHECK_THROWS_AS(session.add(std::string(type.name)), pliant::Error);
    if (type.is_of_body) CHECK_THROWS_AS(session.add(std::string(type.name), "nobody"), pliant::Error);
    CHECK(session.changes() == changes);
  }
  Session session(make_scene);
  CHECK_THROWS_AS(session.add("gravity"), pliant::Error);
  CHECK_THROWS_AS(session.add("hurricane"), pliant::Error);
}

TEST_CASE("names that a program has given twice are not switched") {
  Session session([] {
    pliant::Scene scene;
    for (int i = 0; i < 2; ++i) {
      const pliant::BodyId sheet =
          scene.simulation.add_body(pliant::grid({.columns = 3, .rows = 3}), pliant::Mass::total(1));
      scene.simulation.add(sheet, pliant::EdgeSpring{.stiffness = 100}, "springs");
    }
    return scene;
  });
  CHECK(session.switches().empty());
  CHECK_THROWS_AS(session.switch_on("springs", false), pliant::Error);
}

TEST_CASE("scenes that a program has made switch, too") {
  Session session([] {
    pliant::Scene scene;
    const pliant::BodyId sheet =
        scene.simulation.add_body(pliant::grid({.columns = 5, .rows = 5}), pliant::Mass::total(1), {.name = "sheet"});
    scene.simulation.add(sheet, pliant::EdgeSpring{.stiffness = 100}, "springs");
    scene.simulation.add(pliant::Gravity{}, "down");
    return scene;
  });
  session.switch_on("springs", false);
  session.switch_on("down", false);
  CHECK(session.simulation().groups().empty());
  CHECK(session.simulation().forces().empty());
  steps(session, 2);
  session.undo();
  session.undo();
  CHECK(has_group(session, "springs"));
  CHECK(has_force(session, "down"));
  CHECK_FALSE(session.has_text());
  CHECK_THROWS_AS(session.add("wind"), pliant::Error);
}

}  // namespace test_session_parts
