// What bodies look like, by hand: set, undone, saved, recorded.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/pliant.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "render/image.h"
#include "tests/support/changed_session.h"
#include "tests/support/replayed_session.h"
#include "tests/support/temporary_folder.h"

namespace test_session_appearance {

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

}  // namespace

TEST_CASE(
    "a texture, its size and a finish are saved from the root, undone and recorded; a file that is none is refused") {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "print.png").string();
  pliant_render::write_png(file, {1, 1, {9, 9, 9}});
  const BodyAppearance printed = {.texture = file,
                                  .texture_size = 0.3,
                                  .mapping = pliant::Mapping::rest,
                                  .finish = pliant::Finish::glossy,
                                  .weave = 1e-3};
  Session session(make_scene);
  session.set_appearance("sheet", printed);
  steps(session, 2);
  const auto files = session.save(folder.path() / "printed.json", session.scene().view);
  CHECK(appearance(session, "sheet") == printed);
  const pliant::Scene saved = pliant::load_scene(folder.path() / "printed.json");
  CHECK(std::ranges::count_if(saved.appearances, [&](const auto& each) { return each.second == printed; }) == 1);
  CHECK(appearance(replayed(session, folder), "sheet") == printed);
  session.undo();
  CHECK(appearance(session, "sheet") != printed);
  session.redo();
  CHECK(appearance(session, "sheet") == printed);
  BodyAppearance wrong = printed;
  wrong.texture = (folder.path() / "none.png").string();
  CHECK_THROWS_AS(session.set_appearance("sheet", wrong), pliant::Error);
  wrong = printed;
  wrong.texture_size = 0;
  CHECK_THROWS_AS(session.set_appearance("sheet", wrong), pliant::Error);
  CHECK(appearance(session, "sheet") == printed);
}

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

TEST_CASE("colors that no file could have are refused") {
  Session session(make_scene);
  CHECK_THROWS_AS(session.set_appearance("sheet", {.front = pliant::Color{1.2, 0, 0}}), pliant::Error);
  CHECK_THROWS_AS(session.set_appearance("sheet", {.pattern_size = 0}), pliant::Error);
  CHECK(session.changes().is_empty());
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

TEST_CASE("bodies of scenes that a program has made look otherwise, too") {
  Session session([] {
    pliant::Scene scene;
    const pliant::BodyId sheet =
        scene.simulation.add_body(pliant::grid({.columns = 5, .rows = 5}), pliant::Mass::total(1), {.name = "sheet"});
    scene.simulation.add(sheet, pliant::EdgeSpring{.stiffness = 100}, "springs");
    return scene;
  });
  session.set_appearance("sheet", striped);
  session.switch_on("springs", false);
  CHECK(appearance(session, "sheet") == striped);
  session.undo();
  CHECK(appearance(session, "sheet") == striped);
  session.undo();
  CHECK(session.scene().appearances.empty());
}

}  // namespace test_session_appearance
