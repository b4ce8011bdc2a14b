// What is switched off in a saved scene, and comes back.
#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "tests/support/changed_session.h"
#include "tests/support/replayed_session.h"
#include "tests/support/temporary_folder.h"

namespace test_session_switches {

using namespace pliant_tests;
namespace {

/// A session of the scene as another one saves it now.
Session reopened(Session& session, const TemporaryFolder& folder, const char* name = "saved.json") {
  const auto file = session.save(folder.path() / name, session.scene().view).at(0);
  return Session([file] { return pliant::load_scene(file); });
}

void check_same_bits(Session& session, Session& other, int count) {
  for (int i = 0; i < count; ++i) {
    session.step();
    other.step();
  }
  CHECK(positions(session) == positions(other));
}

const std::vector<std::string>& switchable() {
  static const std::vector<std::string> names = {"hooks", "bend", "gravity", "wind", "ball", "scarf.bend"};
  return names;
}

}  // namespace

TEST_CASE("what is switched off comes back from a saved scene, with the bits of the scene as it was") {
  const TemporaryFolder folder;
  for (const int first : {0, 4}) {
    CAPTURE(first);
    Session session(make_scene), plain(make_scene);
    steps(session, first);
    for (const std::string& name : switchable()) session.switch_on(name, false);
    Session saved = reopened(session, folder);
    CHECK(saved.changes().is_empty());
    CHECK_FALSE(saved.has_unsaved_changes());
    for (const std::string& name : switchable()) CHECK_FALSE(saved.switches().at(name));
    CHECK(saved.switched_off().at("hooks").pinned == std::vector<Index>{72, 80});
    CHECK(saved.switched_off().at("scarf.bend").goes_with_material);
    CHECK(saved.switched_off().at("ball").is_collider);
    session.restart(true);
    check_same_bits(session, saved, 30);
    CHECK(saved.note().empty());
    CHECK(saved.scene().timeline.event_count() == 3);  // which act on what is off
    saved.restart(false);
    for (const std::string& name : switchable()) saved.switch_on(name, true);
    check_same_bits(saved, plain, 100);
    Session again = reopened(saved, folder, "again.json");
    CHECK(again.switched_off().empty());
    CHECK(TemporaryFolder::read(folder.path() / "again.json").find("enabled") == std::string::npos);
    saved.restart(true);
    check_same_bits(saved, again, 100);
  }
}

TEST_CASE("what a scene has switched off is switched on and off, undone, recorded and kept by a restart") {
  const TemporaryFolder folder;
  Session first(make_scene);
  for (const std::string& name : switchable()) first.switch_on(name, false);
  Session session = reopened(first, folder);
  steps(session, 5);
  session.switch_on("hooks", true);
  CHECK(session.undone_next() == "hooks on");
  CHECK(session.is_pinned(72));
  CHECK(session.has_unsaved_changes());
  session.set("collider:bar.radius", {0.3, 0, 0});
  session.switch_on("ball", true);
  session.set("collider:ball.radius", {0.2, 0, 0});
  session.switch_on("ball", false);
  session.switch_on("ball", true);
  CHECK(value(session, "collider:ball.radius") == 0.2);
  steps(session, 5);
  session.switch_on("hooks", false);
  CHECK_FALSE(session.switches().at("hooks"));
  session.undo();
  CHECK(session.is_pinned(72));
  session.restart(true);
  CHECK(session.is_pinned(72));
  CHECK_FALSE(session.switches().at("bend"));
  steps(session, 30);
  const Session again = replayed(session, folder);
  CHECK(positions(again) == positions(session));
  while (!session.undone_next().empty()) session.undo();
  CHECK(session.changes().is_empty());
  CHECK_FALSE(session.switches().at("hooks"));
  while (session.redone_next() != "hooks off") session.redo();
  CHECK(session.switches().at("hooks"));
  CHECK(session.switches().at("ball"));
  session.restart(false);
  CHECK_FALSE(session.switches().at("hooks"));
}

TEST_CASE("an event that acted while its group was off acts when that is switched on") {
  Session session([] {
    return pliant::parse_scene(R"({ "pliant": 1, "bodies": [ { "name": "sheet", "mass": { "total": 1 },
      "mesh": { "shape": "grid", "columns": 5, "rows": 5, "plane": "xz" },
      "constraints": [ { "type": "edge_spring" },
        { "type": "position", "name": "hooks", "on": [20, 24], "enabled": false } ] } ],
      "colliders": [ { "type": "sphere", "name": "ball", "center": [0, 9, 0], "enabled": false } ],
      "events": [ { "step": 2, "release": "hooks", "vertices": [20] },
                  { "step": 2, "move": "ball", "offset": [0, 1, 0], "over": 0.1 } ] })",
                               {}, "sheet");
  });
  steps(session, 4);
  session.switch_on("hooks", true);
  session.switch_on("ball", true);
  CHECK(session.is_pinned(20));
  steps(session, 10);
  CHECK_FALSE(session.is_pinned(20));
  CHECK(session.is_pinned(24));
  const auto height = [&] { return session.simulation().pose(collider(session, "ball")).position.y(); };
  CHECK(height() == doctest::Approx(10));
  // Off while it moves, and on again: as the scene begins with it, and then its move.
  session.restart(true);
  steps(session, 5);
  session.switch_on("ball", false);
  steps(session, 2);
  session.switch_on("ball", true);
  CHECK(height() == doctest::Approx(9));
  steps(session, 10);
  CHECK(session.note().empty());
}

TEST_CASE("pins and paint of what is off are in a saved scene") {
  const TemporaryFolder folder;
  Session session(make_scene), plain(make_scene);
  for (Session* each : {&session, &plain}) {
    each->unpin(80);
    each->paint("bend", {.vertices = {3, 4, 5}, .shares = {1, 0.5, 0.2}, .factor = 10});
    each->set("group:bend.stiffness", {0.004, 0, 0});
    each->paint("scarf.bend", {.vertices = {90, 91}, .shares = {1, 1}, .factor = 4});
  }
  for (const char* name : {"hooks", "bend", "scarf.bend"}) session.switch_on(name, false);
  Session saved = reopened(session, folder);
  CHECK_FALSE(saved.is_pinned(72));
  for (const char* name : {"hooks", "bend", "scarf.bend"}) saved.switch_on(name, true);
  saved.restart(true);
  plain.restart(true);
  check_same_bits(saved, plain, 60);
  CHECK(saved.is_pinned(72));
  CHECK_FALSE(saved.is_pinned(80));
}

TEST_CASE("what was added and switched off is in a saved scene") {
  const TemporaryFolder folder;
  Session session(make_scene), plain(make_scene);
  for (Session* each : {&session, &plain}) {
    each->add("box");
    each->add("wind");
  }
  session.switch_on("box", false);
  session.switch_on("wind 2", false);
  Session saved = reopened(session, folder);
  CHECK_FALSE(saved.switches().at("box"));
  CHECK_FALSE(saved.switches().at("wind 2"));
  saved.switch_on("box", true);
  saved.switch_on("wind 2", true);
  saved.restart(true);
  plain.restart(true);
  check_same_bits(saved, plain, 60);
}

TEST_CASE("another material takes the place of what a scene has switched off") {
  const TemporaryFolder folder;
  Session first(make_scene);
  for (const char* name : {"bend", "scarf.bend"}) first.switch_on(name, false);
  Session session = reopened(first, folder);
  session.set_material("sheet", "wool");
  session.set_material("scarf", "denim");
  CHECK_FALSE(session.switches().contains("bend"));
  CHECK(session.switches().at("scarf.bend"));
  session.switch_on("sheet.bend", false);
  Session saved = reopened(session, folder, "wool.json");
  CHECK(saved.simulation().find_group("scarf.bend").has_value());
  CHECK_FALSE(saved.switches().at("sheet.bend"));
  session.restart(true);
  check_same_bits(saved, session, 20);
  for (int i = 0; i < 3; ++i) session.undo();
  CHECK_FALSE(session.switches().at("bend"));
  CHECK_FALSE(session.switches().at("scarf.bend"));
  CHECK(session.changes().is_empty());
}

TEST_CASE("pins that are off come back where no other group of the saved scene holds one of their vertices") {
  const TemporaryFolder folder;
  Session first(make_scene);
  first.switch_on("hooks", false);
  first.pin(72);
  Session session = reopened(first, folder);
  steps(session, 3);
  CHECK_THROWS_WITH_AS(session.switch_on("hooks", true), doctest::Contains("vertex 72 is already pinned"),
                       pliant::Error);
  CHECK(session.changes().is_empty());
  CHECK(session.is_pinned(72));
  session.switch_on("sheet.pins", false);
  session.switch_on("hooks", true);
  CHECK(session.is_pinned(72));
  CHECK(session.is_pinned(80));
}

}  // namespace test_session_switches
