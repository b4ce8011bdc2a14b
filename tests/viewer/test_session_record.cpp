#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/files/base64.h"
#include "pliant_io/files/read_file.h"
#include "tests/support/changed_session.h"
#include "tests/support/temporary_folder.h"

namespace test_session_record {

using namespace pliant_tests;
namespace fs = std::filesystem;

/// Written and read again.
SessionRecord through_file(const Session& session, const fs::path& folder) {
  const fs::path file = folder / "some.session";
  write_session_record(file, session.record(file, session.scene().view));
  return read_session_record(file);
}

/// Does it again, and holds it against what the session came to.
ReplayReport check_replay(const Session& session, const fs::path& folder) {
  const SessionRecord record = through_file(session, folder);
  Session again(scene_maker_of(record, folder / "some.session"));
  again.replay(record);
  while (again.is_replaying()) again.step();
  CHECK(again.replayed().has_ended);
  CHECK_FALSE(again.replayed().differs_from.has_value());
  CHECK(positions(again) == positions(session));
  CHECK(again.simulation().state().velocities == session.simulation().state().velocities);
  CHECK(again.changes() == session.changes());
  CHECK(again.undone_next() == session.undone_next());
  CHECK(again.redone_next() == session.redone_next());
  return again.replayed();
}

Pull pull_at(const Session& session, std::uint32_t vertex) {
  return {{{vertex, vertex + 1, vertex + 9}, {0.5F, 0.25F, 0.25F}}, place(session, static_cast<Index>(vertex)), 40};
}

/// Pulls a vertex upwards while it takes so many steps.
void pull_for(Session& session, std::uint32_t vertex, int count) {
  session.grab(pull_at(session, vertex));
  for (int i = 0; i < count; ++i) {
    session.pull_to(session.pull()->target + Vec3f(0.5F, 0.5F, 0));  // the mouse may move more often than time goes on
    session.pull_to(session.pull()->target + Vec3f(-0.49F, -0.5F, 0.01F));
    session.step();
  }
  session.let_go();
}

TEST_CASE("a minute of pulls, pins, colliders, values, materials, undo, saving and restarts comes again, bit for bit") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.set("settings.iterations", {6, 0, 0});
  session.restart(true);
  steps(session, 50);
  session.restart(true);
  std::int64_t taken = 50;
  for (int round = 0; round < 12; ++round) {
    CAPTURE(round);
    pull_for(session, 20 + static_cast<std::uint32_t>(round), 100);
    session.pin(30 + round);
    session.move_pin(30 + round, place(session, 30 + round) + Vec3f(0.02F, 0, 0.05F));
    steps(session, 60);
    session.set("group:sheet.stretch.stiffness", {400 + 10.0 * round, 0, 0});
    session.set("group:sheet.stretch.stiffness", {420 + 10.0 * round, 0, 0}, true);
    session.move_collider(collider(session, "ball"), {0.01F * static_cast<float>(round), 0.3F, 0});
    steps(session, 60);
    session.drop_collider(collider(session, "ball"));
    if (round % 3 == 0) session.undo();
    if (round % 4 == 0) session.set_material("scarf", round % 8 == 0 ? "denim" : "wool");
    if (round % 5 == 0) session.unpin(72);
    if (round % 5 == 2) session.undo();
    if (round == 7) session.redo();
    if (round == 3) session.save(folder.path() / "saved.json", session.scene().view);
    steps(session, 80);
    taken += 300;
  }
  const ReplayReport report = check_replay(session, folder.path());
  CHECK(report.steps == taken);
  CHECK(taken == 3650);
}

TEST_CASE("pins that were set, turned and let go together come again, bit for bit") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.pin({40, 41, 49, 50});
  session.hold_pins({40, 41, 49, 50, 72});
  session.move_held({.translation = {0.1F, 0, 0}});
  session.drop_held();
  steps(session, 20);
  session.pin({54, 55, 56, 85});
  session.hold_pins({54, 55, 56});
  for (int i = 1; i <= 30; ++i) {
    const float share = static_cast<float>(i) / 30;
    session.move_held({.translation = {9, 9, 9}});  // the mouse may move more often than time goes on
    session.move_held(
        {.center = {0.1F, 0, 0.2F}, .rotation = {0, 0.3F * share, share}, .translation = {0, 0.1F, share}});
    session.step();
  }
  session.undo();  // while they are held
  session.move_held({.translation = {1, 1, 1}});
  steps(session, 10);
  session.redo();
  session.drop_held();
  session.unpin({40, 54, 80});
  steps(session, 30);
  session.restart(true);
  steps(session, 30);
  check_replay(session, folder.path());
}

TEST_CASE("a restart without changes begins the record anew, one with changes goes on with it") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.pin(40);
  steps(session, 5);
  session.restart(false);
  CHECK(through_file(session, folder.path()).actions.empty());
  steps(session, 7);
  session.restart(true);  // nothing to keep
  CHECK(through_file(session, folder.path()).steps == 0);
  steps(session, 3);
  session.pin(40);
  session.restart(true);
  steps(session, 4);
  const SessionRecord record = through_file(session, folder.path());
  CHECK(record.steps == 7);
  CHECK(record.actions.size() == 2);
  CHECK(record.last_start() == 3);
  check_replay(session, folder.path());
}

TEST_CASE("what was done while time stood still, or failed, or moved many times, is what came of it") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.pin(40);
  for (int i = 0; i < 1000; ++i) session.move_pin(40, {0.001F * static_cast<float>(i), 0, 0});
  session.drop_pin(40);
  CHECK_THROWS_AS(session.set("settings.iterations", {-1, 0, 0}), pliant::Error);
  CHECK_THROWS_AS(session.pin(1000), pliant::Error);
  CHECK(through_file(session, folder.path()).actions.size() == 3);
  check_replay(session, folder.path());
  steps(session, 2);
  session.undo();  // behind the last step
  check_replay(session, folder.path());
}

TEST_CASE("what is done behind the last step is compared too") {
  const TemporaryFolder folder;
  for (const int count : {0, 5, 60}) {
    CAPTURE(count);
    Session session(make_scene);
    session.pin(40);
    steps(session, count);
    session.restart(true);
    check_replay(session, folder.path());
    session.grab(pull_at(session, 12));
    session.grab(pull_at(session, 14));
    CHECK_THROWS_AS(session.grab({{{5, 5, 5}, {0, 1, 0}}, {0, 0, 0}, 1}), pliant::Error);
    session.move_pin(40, Vec3f(1, 1, std::numeric_limits<float>::infinity()));
    session.pull_to(Vec3f(1, 1, std::numeric_limits<float>::quiet_NaN()));
    steps(session, 3);
    check_replay(session, folder.path());
  }
}

TEST_CASE("a session that goes on from a checkpoint comes again from there") {
  const TemporaryFolder folder;
  Session first(make_scene);
  steps(first, 20);
  const auto files = first.save(folder.path() / "later.json", first.scene().view);
  Session session([&, is_first = true]() mutable {
    return std::exchange(is_first, false) ? pliant::read_checkpoint(files.at(1)) : pliant::load_scene(files.at(0));
  });
  steps(session, 10);
  session.set("settings.iterations", {7, 0, 0});
  steps(session, 10);
  check_replay(session, folder.path());
  session.restart(true);
  steps(session, 10);
  check_replay(session, folder.path());
}

TEST_CASE("a replay ends when someone takes over, and what was done until then is in the new record") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.pin(40);
  steps(session, 30);
  session.undo();
  steps(session, 10);
  const SessionRecord record = through_file(session, folder.path());
  Session again(scene_maker_of(record, folder.path() / "some.session"));
  again.replay(record);
  steps(again, 20);
  CHECK(again.is_replaying());
  again.set("settings.iterations", {3, 0, 0});
  CHECK_FALSE(again.is_replaying());
  CHECK_FALSE(again.replayed().has_ended);
  steps(again, 20);
  CHECK(again.is_pinned(40));
  check_replay(again, folder.path());
}

TEST_CASE("a replay tells from which step on bits differ") {
  const TemporaryFolder folder;
  Session session(make_scene);
  steps(session, 130);
  SessionRecord record = through_file(session, folder.path());
  REQUIRE(record.checksums.size() == 3);
  record.checksums[1].crc32 ^= 1;
  Session again(scene_maker_of(record, folder.path() / "some.session"));
  again.replay(record);
  while (again.is_replaying()) again.step();
  CHECK(again.replayed().differs_from == 120);
}

TEST_CASE("a scene whose file changes under it, or that a program made, cannot be recorded") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "scene.json";
  std::ofstream(file) << sheet_text;
  Session session([&] { return pliant::load_scene(file); });
  session.pin(40);
  std::string other(sheet_text);
  other.replace(other.find("0.3"), 3, "0.4");
  std::ofstream(file) << other;
  check_replay(session, folder.path());  // it still has the text that it was read from
  session.restart(true);
  CHECK_THROWS_WITH_AS(session.record(file, {}), doctest::Contains("were changed while it was open"), pliant::Error);
  session.restart(false);
  steps(session, 3);
  check_replay(session, folder.path());
  Session made([] { return pliant::Scene(); });
  CHECK_THROWS_WITH_AS(made.record(file, {}), doctest::Contains("made by a program"), pliant::Error);
}

TEST_CASE("the file says what is wrong with it, and where") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "some.session";
  Session session(make_scene);
  session.grab(pull_at(session, 12));
  session.set("settings.iterations", {12, 0, 0});
  steps(session, 3);
  write_session_record(file, session.record(file, session.scene().view));
  const std::string text = pliant::read_file(file);
  const auto message_of = [&](const std::string& with) {
    std::ofstream(file) << with;
    try {
      const SessionRecord record = read_session_record(file);
      Session again(scene_maker_of(record, file));
    } catch (const pliant::Error& error) {
      CHECK(error.kind() == pliant::ErrorKind::input);
      const std::string message = error.what();
      CHECK(message.starts_with(file.string()));
      return doctest::String(message.c_str());
    }
    return doctest::String();
  };
  const auto changed = [&](const char* pointer, const nlohmann::json& value) {
    nlohmann::json json = nlohmann::json::parse(text);
    json[nlohmann::json::json_pointer(pointer)] = value;
    return message_of(json.dump());
  };
  using doctest::Contains;
  CHECK(message_of(text) == "");
  CHECK(message_of(text.substr(0, text.size() / 2)) == Contains("not a recorded session, or cut"));
  CHECK(message_of("") == Contains("not a recorded session"));
  CHECK(message_of(R"({ "pliant": 1 })") == Contains("not a recorded session"));
  CHECK(changed("/pliant_session", 2) == Contains("pliant_session: must be 1"));
  CHECK(changed("/steps", -1) == Contains("steps: must be a whole number"));
  CHECK(changed("/steps", 1e30) == Contains("steps: must be a whole number"));
  CHECK(changed("/actions", 3) == Contains("actions: must be a list"));
  CHECK(changed("/actions/0/do", "dance") == Contains("actions[0].do: 'dance' is not known"));
  CHECK(changed("/actions/0/step", 4) == Contains("actions[0].step: steps must ascend, up to"));
  CHECK(changed("/actions/0/step", 3) == Contains("actions[1].step: steps must ascend"));
  CHECK(changed("/actions/0/vertices", {1, 2}) == Contains("actions[0].vertices: must have 3 entries"));
  CHECK(changed("/actions/0/weights", {0, 0, 0}) == Contains("actions[0].weights: must be 0 or more"));
  CHECK(changed("/actions/0/target/1", 1e60) == Contains("actions[0].target[1]: is too large"));
  CHECK(changed("/actions/0/stiffness", 0) == Contains("actions[0].stiffness: must be more than 0"));
  CHECK(changed("/actions/1/key", nullptr) == Contains("actions[1].key: must be a text"));
  CHECK(changed("/actions/1/goes_on", 1) == Contains("actions[1].goes_on: must be true or false"));
  CHECK(changed("/checksums", {{3, 1}, {3, 1}}) == Contains("checksums[1]: steps must ascend"));
  CHECK(changed("/start", "???") == Contains("start: not base64"));
  CHECK(changed("/start", pliant::base64("nothing")) == Contains("some.session"));
  CHECK_THROWS_AS(read_session_record(folder.path() / "none.session"), pliant::Error);
}

TEST_CASE("an action that the scene does not have ends the replay with an error, and harms nothing") {
  const TemporaryFolder folder;
  Session session(make_scene);
  steps(session, 3);
  const SessionRecord record = through_file(session, folder.path());
  const std::vector<Action> wrong = {
      action::PinVertex{100'000}, action::Grab{{{{5, 90'000, 7}, {0.2F, 0.3F, 0.5F}}, {0, 0, 0}, 1}},
      action::SetMaterial{"sheet", "cheese"}, action::Set{"settings.iterations", {-3, 0, 0}}};
  for (const Action& action : wrong) {
    CAPTURE(action.index());
    SessionRecord with = record;
    with.actions.push_back({1, action});
    Session again(scene_maker_of(with, folder.path() / "some.session"));
    again.replay(with);
    again.step();
    CHECK_THROWS_AS(again.step(), pliant::Error);
    CHECK_FALSE(again.is_replaying());
    again.step();
    CHECK(positions(again).allFinite());
  }
  SessionRecord with = record;
  with.actions.push_back({1, action::MoveCollider{77, {0, 0, 0}}});
  with.actions.push_back({1, action::DropCollider{77}});
  with.actions.push_back({1, action::Unpin{100'000}});
  Session again(scene_maker_of(with, folder.path() / "some.session"));
  again.replay(with);
  while (again.is_replaying()) again.step();
  CHECK(positions(again) == positions(session));
}

}  // namespace test_session_record
