// What bodies look like, and what is switched off, by hand: set, undone, saved, recorded.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/pliant.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "tests/support/changed_session.h"
#include "tests/support/temporary_folder.h"

namespace test_session_bodies {

using namespace pliant_tests;
using pliant::BodyAppearance;
using pliant::Pattern;

namespace {

const BodyAppearance striped = {.front = pliant::Color{0.1, 0.2, 0.75},
                                .back = pliant::Color{1, 1, 1},
                                .pattern = Pattern::stripes,
                                .pattern_color = {0.5, 0, 0},
                                .pattern_size = 0.05};

std::optional<BodyAppearance> appearance(const Session& session, const std::string& body) {
  for (const auto& [id, looks] : session.scene().appearances) {
    if (session.simulation().body(id).name == body) return looks;
  }
  return {};
}

bool has_group(const Session& session, const std::string& name) {
  return session.simulation().find_group(name).has_value();
}

bool has_force(const Session& session, const std::string& name) {
  return session.simulation().find_force(name).has_value();
}

/// The session that a file of this one makes, run for so many steps.
Session replayed(const Session& session, const TemporaryFolder& folder) {
  const auto file = folder.path() / "some.session";
  write_session_record(file, session.record(file, session.scene().view));
  const SessionRecord record = read_session_record(file);
  Session again(scene_maker_of(record, file));
  again.replay(record);
  while (again.is_replaying()) again.step();
  CHECK(again.replayed().has_ended);
  CHECK_FALSE(again.replayed().differs_from.has_value());
  return again;
}

}  // namespace

TEST_CASE("an appearance is set, undone, done again, kept by a restart, saved and recorded") {
  const TemporaryFolder folder;
  Session session(make_scene);
  const auto original = appearance(session, "sheet");
  const std::uint64_t looks = session.look_changes(), rebuilds = session.rebuilds();
  session.set_appearance("sheet", {.front = pliant::Color{1, 0, 0}});
  session.set_appearance("sheet", striped, true);
  CHECK(session.look_changes() == looks + 2);
  CHECK(appearance(session, "sheet") == striped);
  CHECK(session.undone_next() == "sheet: appearance");
  session.undo();
  CHECK(appearance(session, "sheet") == original);
  CHECK(session.undone_next().empty());  // both were one change
  session.redo();
  CHECK(appearance(session, "sheet") == striped);
  CHECK(session.rebuilds() == rebuilds);
  steps(session, 5);
  session.set_material("scarf", "wool");
  session.pin(4);
  CHECK(appearance(session, "sheet") == striped);
  session.restart(true);
  CHECK(appearance(session, "sheet") == striped);
  steps(session, 5);

  const auto files = session.save(folder.path() / "striped.json", session.scene().view);
  CHECK(appearance(session, "sheet") == striped);
  Session saved([&] { return pliant::load_scene(files.at(0)); });
  CHECK(appearance(saved, "sheet") == striped);
  Session resumed([&] { return pliant::read_checkpoint(files.at(1)); });
  CHECK(appearance(resumed, "sheet") == striped);
  CHECK(appearance(replayed(session, folder), "sheet") == striped);

  session.restart(false);
  CHECK(appearance(session, "sheet") == original);
  CHECK_THROWS_AS(session.set_appearance("nobody", striped), pliant::Error);
  CHECK(session.undone_next().empty());
}

TEST_CASE("a change of an appearance that something else follows is one of its own") {
  Session session(make_scene);
  session.set_appearance("sheet", {.front = pliant::Color{1, 0, 0}});
  session.set("group:bend.stiffness", {0.01, 0, 0});
  session.set_appearance("sheet", striped, true);
  session.undo();
  CHECK(appearance(session, "sheet")->front == pliant::Color{1, 0, 0});
  CHECK(value(session, "group:bend.stiffness") == 0.01);
}

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
  const Session again = replayed(session, folder);
  CHECK(positions(again) == positions(session));
  CHECK(again.changes() == session.changes());
  const auto files = session.save(folder.path() / "off.json", session.scene().view);
  REQUIRE(files.size() == 2);
  pliant::Scene resumed = pliant::read_checkpoint(files[1]);
  pliant::Scene saved = pliant::load_scene(files[0]);
  for (int i = 0; i < 20; ++i) {
    session.step();
    resumed.step();
    saved.step();
  }
  CHECK(positions(resumed.simulation) == positions(session));
  CHECK_FALSE(saved.simulation.find_group("bend").has_value());
  CHECK_FALSE(saved.simulation.find_force("gravity").has_value());
  session.restart(true);
  steps(session, 20);
  CHECK(positions(saved.simulation) == positions(session));
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

TEST_CASE("scenes that a program has made switch, and show bodies otherwise, too") {
  Session session([] {
    pliant::Scene scene;
    const pliant::BodyId sheet =
        scene.simulation.add_body(pliant::grid({.columns = 5, .rows = 5}), pliant::Mass::total(1), {.name = "sheet"});
    scene.simulation.add(sheet, pliant::EdgeSpring{.stiffness = 100}, "springs");
    scene.simulation.add(pliant::Gravity{}, "down");
    return scene;
  });
  session.set_appearance("sheet", striped);
  session.switch_on("springs", false);
  session.switch_on("down", false);
  CHECK(session.simulation().groups().empty());
  CHECK(session.simulation().forces().empty());
  CHECK(appearance(session, "sheet") == striped);
  steps(session, 2);
  session.undo();
  session.undo();
  CHECK(has_group(session, "springs"));
  CHECK(has_force(session, "down"));
  CHECK(appearance(session, "sheet") == striped);
  session.undo();
  CHECK(session.scene().appearances.empty());
}

TEST_CASE("a session file tells what is wrong with an appearance") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.set_appearance("sheet", striped);
  const auto file = folder.path() / "some.session";
  write_session_record(file, session.record(file, session.scene().view));
  const auto json = nlohmann::ordered_json::parse(TemporaryFolder::read(file));
  const auto message_with = [&](const char* key, const nlohmann::ordered_json& value) {
    auto changed = json;
    changed["actions"][0]["appearance"][key] = value;
    folder.write("changed.session", changed.dump());
    try {
      read_session_record(folder.path() / "changed.session");
    } catch (const pliant::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(message_with("front", {0.5, 0.5, 0.5}).empty());
  CHECK(message_with("front", {0.5, 1.5, 0.5}).find("actions[0].appearance.front[1]: must be from 0 to 1") !=
        std::string::npos);
  CHECK(message_with("front", "red").find("must be a list") != std::string::npos);
  CHECK(message_with("pattern", "dots").find("'dots' is not known") != std::string::npos);
  CHECK(message_with("pattern_size", 0).find("pattern_size: is out of range") != std::string::npos);
}

}  // namespace test_session_bodies
