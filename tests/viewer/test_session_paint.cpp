// A stiffness that is painted: undone, kept by a restart, saved, recorded.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/pliant.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "tests/support/changed_session.h"
#include "tests/support/replayed_session.h"
#include "tests/support/temporary_folder.h"
#include "viewer/copied_scene.h"

namespace test_session_paint {

using namespace pliant_tests;

namespace {

const PaintDab starch = {.vertices = {4, 5, 6}, .shares = {1, 0.5, 0.25}, .factor = 16};
const PaintDab stiff_scarf = {.vertices = {81, 82}, .shares = {1, 1}, .factor = 7.0 / 3};

std::vector<Real> factors(const Session& session, const std::string& group) {
  const auto id = session.simulation().find_group(group);
  REQUIRE(id.has_value());
  return session.simulation().groups().at(*id).factors;
}

/// Of the first group with that dab; 81 vertices.
std::vector<Real> starched() {
  std::vector<Real> list(81, 1);
  list[4] = 16;
  list[5] = 4;
  list[6] = 2;
  return list;
}

}  // namespace

TEST_CASE("paint goes the way to its factor by ratios; a stroke is one change, taken back and done again") {
  Session session(make_scene);
  const std::uint64_t looks = session.look_changes(), rebuilds = session.rebuilds();
  session.paint("bend", starch);
  CHECK(factors(session, "bend") == starched());
  session.paint("bend", {.vertices = {6}, .shares = {1}, .factor = 3.14159}, true);
  CHECK(factors(session, "bend")[6] == 3.14);
  CHECK(session.undone_next() == "paint bend");
  CHECK(session.edit_count() == 1);
  session.paint("bend", {.vertices = {0}, .shares = {1}, .factor = 0.5});
  session.paint("scarf.warp", stiff_scarf);
  CHECK(factors(session, "scarf.warp")[0] == 2.33);
  session.undo();
  CHECK(factors(session, "scarf.warp").empty());
  session.undo();
  session.undo();
  CHECK(factors(session, "bend").empty());
  session.redo();
  CHECK(factors(session, "bend")[6] == 3.14);
  CHECK(session.look_changes() > looks + 6);
  CHECK(session.rebuilds() == rebuilds);  // no scene was read for that
  // A stroke goes as far as its largest share, however many dabs it has; what is taken off is gone in the end.
  session.paint("bend", {.vertices = {4, 5, 6}, .shares = {1, 1, 1}, .factor = 1});
  CHECK(factors(session, "bend").empty());
  session.paint("bend", {.vertices = {5}, .shares = {0.5}, .factor = 16});
  for (int i = 0; i < 5; ++i) session.paint("bend", {.vertices = {5}, .shares = {0.25}, .factor = 16}, true);
  CHECK(factors(session, "bend")[5] == 4);
  for (int i = 0; i < 200; ++i) session.paint("bend", {.vertices = {5}, .shares = {0.1}, .factor = 1});
  CHECK(factors(session, "bend").empty());
}

TEST_CASE("paint of what is not there for now is kept, and stands in nobody's way") {
  std::string text(sheet_text);
  const auto put = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  put(R"("name": "hooks", "on": [72, 80])", R"("name": "hooks", "on": [72, 80], "hold": "soft", "stiffness": 900)");
  Session session([&] { return pliant::parse_scene(text, {}, "sheet"); });
  session.paint("hooks", {.vertices = {72, 80}, .shares = {1, 1}, .factor = 5});
  session.paint("scarf.warp", stiff_scarf);
  session.set("group:hooks.hold", {0, 0, 0});  // hard
  session.restart(true);
  CHECK(factors(session, "hooks")[72] == 5);
  session.pin(3);
  session.undo();
  session.switch_on("hooks", false);
  session.set_material("sheet", "wool");
  session.switch_on("hooks", true);
  CHECK(factors(session, "hooks")[80] == 5);
  // The file has another mesh and another material by now.
  put(R"("columns": 6, "rows": 4)", R"("columns": 7, "rows": 4)");
  session.restart(true);
  CHECK(factors(session, "scarf.warp").empty());
  put(R"("name": "silk")", R"("name": "felt")");
  session.restart(true);
  CHECK_FALSE(session.simulation().find_group("scarf.warp").has_value());
  session.step();
}

TEST_CASE("what is painted is kept by a restart, and moves the body as a scene that says so") {
  const TemporaryFolder folder;
  Session session(make_scene);
  steps(session, 3);
  session.paint("bend", starch);
  session.paint("scarf.warp", stiff_scarf);
  session.set("group:bend.stiffness", {0.02, 0, 0});
  session.restart(true);
  CHECK(factors(session, "bend") == starched());
  CHECK(factors(session, "scarf.warp")[0] == 2.33);
  const auto files = session.save(folder.path() / "painted.json", session.scene().view);
  CHECK_FALSE(session.has_unsaved_changes());
  Session read([&] { return pliant::load_scene(files.at(0)); });
  CHECK(factors(read, "bend") == starched());
  CHECK(value(read, "group:bend.stiffness") == 0.02);
  steps(session, 40);
  steps(read, 40);
  CHECK(positions(session) == positions(read));
  Session plain(make_scene);
  plain.set("group:bend.stiffness", {0.02, 0, 0});
  steps(plain, 40);
  CHECK(positions(plain) != positions(read));
  // From a scene that has factors already: these are what is taken back to.
  read.paint("bend", {.vertices = {4}, .shares = {1}, .factor = 100});
  read.undo();
  CHECK(factors(read, "bend") == starched());
}

TEST_CASE("a checkpoint of a painted scene goes on with the same bits, and a session is replayed to them") {
  const TemporaryFolder folder;
  Session session(make_scene);
  steps(session, 5);
  session.paint("bend", starch);
  session.paint("stretch", {.vertices = {40, 41}, .shares = {1, 0.3}, .factor = 0.01}, false);
  session.paint("stretch", {.vertices = {42}, .shares = {1}, .factor = 0.01}, true);
  steps(session, 5);
  session.pin(12);
  session.undo();
  session.undo();
  session.redo();
  steps(session, 5);
  const Session again = replayed(session, folder);
  CHECK(positions(again) == positions(session));
  CHECK(factors(again, "stretch") == factors(session, "stretch"));
  const auto files = session.save(folder.path() / "painted.json", session.scene().view);
  pliant::Scene resumed = pliant::read_checkpoint(files.at(1));
  for (int i = 0; i < 10; ++i) resumed.step();
  steps(session, 10);
  CHECK(positions(session) == positions(resumed.simulation));
}

TEST_CASE("paint stays on groups that another material has too, and goes with those that it has not") {
  Session session(make_scene);
  steps(session, 2);
  session.paint("scarf.warp", stiff_scarf);
  session.paint("scarf.bend", stiff_scarf);
  session.set_material("scarf", "felt");
  const bool has_warp = session.simulation().find_group("scarf.warp").has_value();
  CHECK_FALSE(has_warp);
  CHECK(factors(session, "scarf.bend")[0] == 2.33);
  const pliant::Positions before = positions(session);
  session.pin(3);
  session.undo();  // made anew from the text
  CHECK(positions(session) == before);
  CHECK(factors(session, "scarf.bend")[0] == 2.33);
  session.undo();
  CHECK(factors(session, "scarf.warp")[0] == 2.33);
  session.switch_on("bend", false);
  session.switch_on("bend", true);
  session.paint("bend", starch);
  session.switch_on("bend", false);
  session.step();
  session.restart(true);
  session.switch_on("bend", true);
  CHECK(factors(session, "bend") == starched());
}

TEST_CASE("what a program has made is painted, and what cannot be is told") {
  pliant::Scene scene;
  const pliant::BodyId sheet =
      scene.simulation.add_body(pliant::grid({.columns = 5, .rows = 5}), pliant::Mass::total(1), {.name = "sheet"});
  scene.simulation.add(sheet, pliant::EdgeSpring{.stiffness = 100}, "springs");
  scene.simulation.add(sheet, pliant::Position{.on = {0}}, "pins");
  for (int i = 0; i < 2; ++i) scene.simulation.add(sheet, pliant::Bending{}, "twice");
  Session session(maker_of(std::move(scene), false));
  session.paint("springs", {.vertices = {3}, .shares = {1}, .factor = 5});
  steps(session, 3);
  session.restart(true);
  CHECK(factors(session, "springs")[3] == 5);
  const auto refuses = [&](const std::string& group, const PaintDab& dab, const char* reason) {
    CHECK_THROWS_WITH_AS(session.paint(group, dab), reason, pliant::Error);
  };
  refuses("pins", starch, "'pins' is no group whose stiffness can be painted");
  refuses("nothing", starch, "'nothing' is no group whose stiffness can be painted");
  refuses("twice", starch, "'twice' is no group whose stiffness can be painted");
  refuses("springs", {.vertices = {25}, .shares = {1}, .factor = 2}, "vertex 25 is not on 'sheet'");
  refuses("springs", {.vertices = {2}, .shares = {2}, .factor = 2}, "a share of paint is from 0 to 1");
  refuses("springs", {.vertices = {2}, .shares = {}, .factor = 2}, "a dab of paint needs a share for each vertex");
  refuses("springs", {.vertices = {2}, .shares = {1}, .factor = 0},
          "a painted stiffness is multiplied by 0.001 to 1000");
  CHECK(session.edit_count() == 1);
}

}  // namespace test_session_paint
