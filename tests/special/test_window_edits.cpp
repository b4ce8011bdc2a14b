// Undo, redo, saving and opening in the real window, driven by mouse and keys; files are dropped through the window's
// own callback.
#define DOCTEST_CONFIG_IMPLEMENT
#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "desk.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/scene/scene.h"

using namespace pliant_tests;

namespace {

constexpr std::uint32_t middle = side * 5 + 6;

Scene read_sheet() {
  return pliant::parse_scene(R"({
    "pliant": 1,
    "name": "sheet",
    "settings": { "iterations": 20, "threads": 1 },
    "bodies": [ {
      "name": "cloth",
      "mesh": { "shape": "grid", "columns": 12, "rows": 12, "plane": "xz" },
      "mass": { "area_density": 0.3 },
      "constraints": [
        { "type": "triangle_strain", "name": "stretch", "stiffness": 500 },
        { "type": "hinge", "name": "bend", "stiffness": 1e-3 },
        { "type": "position", "name": "hooks", "on": [132, 143] }
      ]
    } ],
    "forces": [ { "type": "wind", "velocity": [0, 0, 0], "drag": 3 } ],
    "colliders": [ { "type": "sphere", "name": "ball", "center": [0.5, -0.6, 0.5], "radius": 0.15 } ]
  })",
                             {}, "sheet");
}

std::string text_of(const std::filesystem::path& file) {
  return TemporaryFolder::read(file);
}

}  // namespace

TEST_CASE("what keys and mouse have changed is undone and done again by keys") {
  Desk desk(read_sheet);
  desk.settle();
  desk.click(desk.place(middle));
  desk.turn_until([&] { return desk.is_pinned(middle); });
  desk.type_into("group:bend.stiffness");
  xdotool("key 0 period 0 2 Return");
  desk.turn_until([&] { return desk.parameter("group:bend.stiffness") == 0.02; });
  CHECK(desk.shown().note.empty());  // 0, on the way there, is none that bending can have
  CHECK(desk.shown().undone_next == "bend: stiffness");
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.parameter("group:bend.stiffness") == 0.001; });
  desk.turn_until([&] { return desk.viewer.message() == "undone: bend: stiffness"; });
  desk.key("ctrl+z");
  desk.turn_until([&] { return !desk.is_pinned(middle); });
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.viewer.message() == "nothing to undo"; });
  desk.key("ctrl+shift+z");
  desk.turn_until([&] { return desk.is_pinned(middle); });
  desk.key("ctrl+y");
  desk.turn_until([&] { return desk.parameter("group:bend.stiffness") == 0.02; });
  CHECK(desk.shown().redone_next.empty());
  // A slider that is dragged is one change, however far it goes.
  const auto rect = desk.source.parameter_panel().place_of("settings.iterations").value();
  const float y = (rect[1] + rect[3]) / 2, width = rect[2] - rect[0];
  desk.drag({rect[0] + 0.55F * width, y}, {rect[0] + 0.9F * width, y});
  desk.release();
  desk.turn_until([&] { return desk.parameter("settings.iterations") > 50; });
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.parameter("settings.iterations") == 20; });
  CHECK(desk.shown().undone_next == "bend: stiffness");
}

TEST_CASE("a minute of drags, pins, sliders and undo, saved by a key, comes again bit for bit, and in a window") {
  std::optional<SessionRecord> record;
  std::vector<Vec3f> at_end;
  {
    Desk desk(read_sheet);
    desk.source.live()->post([](CommandContext& context) { context.pacer.set_speed(Pacer::unlimited); });
    const auto rect = desk.source.parameter_panel().place_of("group:stretch.stiffness").value();
    const float y = (rect[1] + rect[3]) / 2, width = rect[2] - rect[0];
    for (std::uint32_t round = 0; round < 6 || desk.shown().step < 3600; ++round) {
      const std::uint32_t vertex = side * 3 + 2 + round % 8;
      desk.drag(desk.place(vertex), desk.place(vertex) + Vec2f(50, -40));
      desk.turns(10);
      desk.release();
      desk.click(desk.place(vertex));
      desk.turns(5);
      desk.drag({rect[0] + 0.3F * width, y}, {rect[0] + (round % 2 == 0 ? 0.6F : 0.5F) * width, y});
      desk.release();
      if (round % 3 == 1) desk.key("ctrl+z");
      if (round % 4 == 2) desk.key("ctrl+z");
      if (round % 4 == 3) desk.key("ctrl+s");
      desk.turns(10);
    }
    desk.key("space");
    desk.turn_until([&] { return !desk.shown().is_playing; });
    desk.key("ctrl+r");
    const auto file = desk.folder.path() / "sheet-1.session";
    desk.turn_until([&] { return desk.viewer.message().starts_with("saved the session"); });
    REQUIRE(std::filesystem::exists(file));
    record = read_session_record(file);
    CHECK(record->steps == desk.shown().step);
    at_end.assign(desk.shown().frame.content.positions.begin(), desk.shown().frame.content.positions.end());
  }
  CHECK(record->steps >= 3600);
  std::vector<std::size_t> counts(std::variant_size_v<Action>);
  for (const TimedAction& timed : record->actions) ++counts.at(timed.action.index());
  CHECK(counts.at(Action(action::Grab()).index()) >= 1);
  CHECK(counts.at(Action(action::PullTo()).index()) >= 1);
  CHECK(counts.at(Action(action::Set()).index()) >= 1);
  CHECK(counts.at(Action(action::PinVertex()).index()) + counts.at(Action(action::Unpin()).index()) >= 1);
  CHECK(counts.at(Action(action::Undo()).index()) >= 1);
  CHECK(counts.at(Action(action::Save()).index()) >= 1);

  Desk desk(scene_maker_of(*record, "again.session"), 1, {}, record);
  CHECK(desk.shown().is_replaying);
  desk.source.live()->post([](CommandContext& context) { context.pacer.set_speed(Pacer::unlimited); });
  desk.turn_until([&] { return !desk.shown().is_replaying; });
  desk.turn_until([&] { return desk.viewer.message().starts_with("the recorded session ends here"); });
  CHECK(desk.shown().replayed.has_ended);
  CHECK_FALSE(desk.shown().replayed.differs_from.has_value());
  CHECK_FALSE(desk.shown().is_playing);
  const auto& positions = desk.shown().frame.content.positions;
  CHECK(std::ranges::equal(at_end, positions));
  const std::int64_t step = desk.shown().step;
  desk.key("space");
  desk.turn_until([&] { return desk.shown().step > step; });
}

TEST_CASE("whoever does something in a session that is replayed takes over from it") {
  Session session(read_sheet);
  for (int i = 0; i < 2000; ++i) session.step();
  SessionRecord record = session.record("some.session", session.scene().view);
  Desk desk(scene_maker_of(record, "some.session"), 1, {}, record);
  desk.turn_until([&] { return desk.shown().step > 10; });
  desk.click(desk.place(middle));
  desk.turn_until([&] { return desk.is_pinned(middle); });
  CHECK_FALSE(desk.shown().is_replaying);
  desk.turn_until([&] { return desk.viewer.message().starts_with("you have taken over"); });
  CHECK(desk.shown().is_playing);
}

TEST_CASE("a scene that is saved by a key has what was changed, and how it is seen") {
  Desk desk(read_sheet);
  desk.key("space");
  desk.turn_until([&] { return !desk.shown().is_playing; });
  desk.key("shift+r");
  desk.turn_until([&] { return desk.shown().step == 0; });
  // Before the first step the ball is put elsewhere.
  const auto ball = [&] { return desk.shown().frame.content.colliders.at(0).pose.position; };
  const Vec2f from = desk.viewer.screen().place_of(ball().cast<float>().eval()).value();
  desk.drag(from, from + Vec2f(60, 20));
  desk.release();
  desk.turn_until([&] { return ball().x() > 0.52; });
  desk.click(desk.place(middle));
  desk.turn_until([&] { return desk.is_pinned(middle); });
  desk.key("w");
  desk.drag({40, 600}, {140, 580}, 3);
  desk.release(3);
  desk.key("ctrl+s");
  const auto file = desk.folder.path() / "sheet-1.json";
  desk.turn_until([&] { return std::filesystem::exists(file) && desk.viewer.message().starts_with("saved"); });
  CHECK(desk.folder.file_count() == 1);  // no checkpoint of the start
  const Scene read = pliant::load_scene(file);
  CHECK(read.view.wireframe);
  REQUIRE(read.view.camera.position.has_value());
  const pliant_render::Viewpoint& seen = desk.viewer.screen().viewpoint;
  CHECK((read.view.camera.position->cast<float>() - seen.eye).norm() < 1e-3F);
  CHECK((read.simulation.pose(pliant::ColliderId{0}).position - ball()).norm() < 1e-12);
  CHECK(read.simulation.find_group("cloth.pins").has_value());

  // Later a checkpoint stands beside it, and the file is the same one.
  desk.key("space");
  desk.turn_until([&] { return desk.shown().step > 20; });
  desk.key("ctrl+s");
  const auto checkpoint = desk.folder.path() / "sheet-1.pliant";
  desk.turn_until([&] { return std::filesystem::exists(checkpoint); });
  CHECK(pliant::read_checkpoint(checkpoint).simulation.state().step > 20);
  desk.key("ctrl+shift+s");
  desk.turn_until([&] { return std::filesystem::exists(desk.folder.path() / "sheet-2.pliant"); });
  CHECK(text_of(file) == text_of(desk.folder.path() / "sheet-2.json"));
}

TEST_CASE("a saved scene is seen as it was, though nobody has moved the camera and something was added") {
  Desk desk(read_sheet);
  const auto file = desk.folder.path() / "sheet-1.json";
  const auto save = [&] {
    desk.key("ctrl+s");
    desk.turn_until([&] { return std::filesystem::exists(file) && desk.viewer.message().starts_with("saved"); });
  };
  const Eigen::Vector3f eye = desk.viewer.screen().viewpoint.eye;
  save();
  CHECK_FALSE(pliant::load_scene(file).view.camera.position.has_value());  // it would be chosen again
  std::filesystem::remove(file);
  desk.source.live()->post([](CommandContext& context) { context.session.add("box"); });
  desk.turn_until([&] { return desk.shown().undone_next == "add box"; });
  CHECK(desk.viewer.screen().viewpoint.eye == eye);
  save();
  const Scene read = pliant::load_scene(file);
  REQUIRE(read.view.camera.position.has_value());
  CHECK((read.view.camera.position->cast<float>() - eye).norm() < 1e-3F);
  CHECK(read.view.camera.field_of_view == 40);
  Desk again([file] { return pliant::load_scene(file); });
  CHECK((again.viewer.screen().viewpoint.eye - eye).norm() < 1e-3F);
}

TEST_CASE("a slider that is dragged sets a number of few digits, which the saved scene has") {
  Desk desk(read_sheet);
  const std::string key = "group:stretch.stiffness";
  desk.turn_until([&] { return desk.source.parameter_panel().place_of(key).has_value(); });
  const auto rect = *desk.source.parameter_panel().place_of(key);
  const float y = (rect[1] + rect[3]) / 2;
  desk.drag({rect[0] + 0.31F * (rect[2] - rect[0]), y}, {rect[0] + 0.73F * (rect[2] - rect[0]), y});
  desk.release();
  desk.turn_until([&] { return desk.parameter(key) > 600; });
  desk.turns(5);
  const double number = desk.parameter(key);
  CHECK(number == std::stod(fmt::format("{:.4e}", number)));
  desk.key("ctrl+s");
  const auto file = desk.folder.path() / "sheet-1.json";
  desk.turn_until([&] { return std::filesystem::exists(file) && desk.viewer.message().starts_with("saved"); });
  CHECK(text_of(file).find(fmt::format("\"stiffness\": {}", number)) != std::string::npos);
  // A number that is typed has all the digits that were.
  desk.type_into(key);
  xdotool("key 1 2 3 4 period 5 6 7 8 9 Return");
  desk.turn_until([&] { return desk.parameter(key) == 1234.56789; });
}

TEST_CASE("a file that cannot be saved is told in the window, which goes on") {
  Desk desk(make_sheet);  // by a program
  desk.key("ctrl+s");
  desk.turn_until([&] { return desk.shown().note.find("program") != std::string::npos; });
  const auto step = desk.shown().step;
  desk.turn_until([&] { return desk.shown().step > step; });
}

TEST_CASE("what is dropped onto the window is opened, and what is wrong with it is told") {
  std::vector<std::string> opened;
  Desk desk(read_sheet, 1, [&](const std::string& what) {
    opened.push_back(what);
    return what == "good.json" ? "" : what + ": not a scene";
  });
  drop(desk, {"/tmp/some folder/notes.txt", "good.json"});  // the first one counts
  desk.turn_until([&] { return desk.viewer.message() == "/tmp/some folder/notes.txt: not a scene"; });
  const auto step = desk.shown().step;
  desk.turn_until([&] { return desk.shown().step > step; });
  drop(desk, {"good.json"});
  desk.viewer.run([] { return false; });  // ends by itself
  CHECK(opened == std::vector<std::string>{"/tmp/some folder/notes.txt", "good.json"});
  CHECK_FALSE(desk.window.wants_to_close());
}

TEST_CASE("a scene is chosen from the list, or its name typed") {
  std::vector<std::string> opened;
  Desk desk(read_sheet, 1, [&](const std::string& what) {
    opened.push_back(what);
    return std::string("not now");
  });
  desk.key("ctrl+o");
  desk.turn_until([&] { return desk.viewer.scene_panel().place_of("towel").has_value(); });
  const auto rect = desk.viewer.scene_panel().place_of("towel").value();
  desk.click({(rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2});
  desk.turn_until([&] { return desk.viewer.message() == "not now"; });
  CHECK(opened == std::vector<std::string>{"towel"});
  const auto shirt = desk.viewer.scene_panel().place_of("shirt.obj").value();
  desk.click({(shirt[0] + shirt[2]) / 2, (shirt[1] + shirt[3]) / 2});
  desk.turn_until([&] { return opened.size() == 2; });
  CHECK(opened.back() == "/home/meshes/shirt.obj");  // not the name that is shown
  const auto first = desk.viewer.scene_panel().place_of("flag").value();
  desk.click({(first[0] + first[2]) / 2, first[1] - 22});  // the field above the list
  xdotool("type my_mesh.obj");
  desk.turns(4);
  desk.key("Return");
  desk.turn_until([&] { return opened.size() == 3; });
  CHECK(opened.back() == "my_mesh.obj");
  // Keys that are typed there are none of the window's.
  CHECK(desk.shown().is_playing);
  desk.key("Escape");
  desk.key("Escape");
  desk.turn_until([&] { return !desk.viewer.scene_panel().is_open; });
}

TEST_CASE("changes that are not saved are lost only when asked for twice") {
  int opened = 0;
  Desk desk(read_sheet, 1, [&](const std::string&) {
    ++opened;
    return std::string("no");
  });
  desk.settle();
  desk.click(desk.place(middle));
  desk.turn_until([&] { return desk.is_pinned(middle); });
  drop(desk, {"a.json"});
  desk.turn_until([&] { return desk.viewer.message().find("unsaved") != std::string::npos; });
  desk.turns(5);
  CHECK(opened == 0);
  drop(desk, {"a.json"});
  desk.turn_until([&] { return opened == 1; });
  desk.key("ctrl+s");
  desk.turn_until([&] { return !desk.shown().has_unsaved_changes; });
  drop(desk, {"b.json"});
  desk.turn_until([&] { return opened == 2; });
}

TEST_CASE("a number that is given up by Escape is no value") {
  Desk desk(read_sheet);
  desk.type_into("group:bend.stiffness");
  xdotool("key 0 Escape");
  desk.turns(12);
  CHECK(desk.shown().note.empty());
  CHECK(desk.parameter("group:bend.stiffness") == 0.001);
  desk.type_into("group:bend.stiffness");
  xdotool("key 0 Return");  // and one that is left like that is refused
  desk.turn_until([&] { return desk.shown().note.find("out of range") != std::string::npos; });
}

int main(int argc, char** argv) {
  return run_on_display(argc, argv);
}
