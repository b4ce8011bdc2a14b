// A run taken up from a checkpoint has the bits of the run without a stop; a checkpoint that was changed is refused.
#include <algorithm>
#include <functional>
#include <limits>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "tests/support/checkpoint_bytes.h"
#include "tests/support/temporary_folder.h"

namespace test_checkpoint {

using namespace pliant;
using pliant_tests::TemporaryFolder;
using Json = nlohmann::json;

namespace {

/// Everything that may happen to a run: ramps, keyframes, motions under way, groups added, changed, released and
/// removed, forces changed, another time step.
constexpr std::string_view busy_scene = R"({
  "pliant": 1,
  "steps": 60,
  "settings": {"iterations": 4, "threads": 1},
  "bodies": [
    {"name": "sheet", "mesh": {"shape": "grid", "columns": 9, "rows": 9, "diagonals": "alternating"},
     "mass": {"area_density": 0.3},
     "constraints": [
       {"type": "position", "name": "pins", "on": "corners"},
       {"type": "triangle_strain", "name": "stretch", "stiffness": 800},
       {"type": "bending", "name": "bend", "stiffness": 0.001, "orientation": "signed"}]},
    {"name": "rope", "mesh": {"shape": "chain", "links": 6}, "mass": {"per_vertex": 0.1},
     "transform": {"translate": [2, 0, 1]},
     "constraints": [{"type": "position", "name": "hook", "on": [0]}, {"type": "edge_spring", "name": "links"}]}],
  "forces": [{"type": "wind", "name": "breeze", "velocity": [0, 2, 0], "gust_strength": 0.5}],
  "moves": [{"group": "hook", "step": 3, "offset": [0.2, 0, 0.1], "over": 0.4}],
  "events": [
    {"step": 5, "change": "stretch", "stiffness": 3000, "over": 0.5},
    {"step": 8, "move": "pins", "rotate": {"axis": [0, 0, 1], "degrees": 40}, "over": 0.5, "ease": "smooth"},
    {"step": 12, "add": {"body": "sheet", "type": "line", "name": "rail", "on": [40], "direction": [1, 1, 0]}},
    {"step": 13, "add": {"body": "sheet", "type": "position", "name": "late", "on": [31, 32]}},
    {"step": 14, "add": {"body": "sheet", "type": "position", "name": "soft", "on": [48], "hold": "soft"}},
    {"time": 0.31, "add": {"body": "rope", "type": "drag", "name": "hand", "stencils": [[6]], "stiffness": 50}},
    {"step": 22, "follow": "hand", "body": "sheet", "vertices": 44},
    {"time": 0.42, "settings": {"time_step": 0.01, "iterations": 6}},
    {"step": 29, "release": "pins", "vertices": [0]},
    {"step": 33, "change": "bend", "stiffness": 0.01, "orientation": "absolute"},
    {"step": 35, "release": "late", "vertices": [31]},
    {"step": 37, "change": "breeze", "velocity": [0, -3, 1]},
    {"step": 41, "gravity": [0, 0, -3]},
    {"step": 44, "remove": "rail"},
    {"step": 46, "remove": "soft"},
    {"time": 0.5, "move": "pins", "keyframes": [{"time": 0.2, "translate": [0, 0.1, 0]}]},
    {"step": 52, "stop": "hand"}]
})";

/// Colliders of every kind, of which all that may happen to a collider happens while bodies touch them.
constexpr std::string_view scene_with_colliders = R"({
  "pliant": 1,
  "steps": 60,
  "settings": {"iterations": 6, "threads": 1},
  "bodies": [
    {"name": "sheet", "mesh": {"shape": "grid", "columns": 9, "rows": 9, "plane": "xy"},
     "mass": {"area_density": 0.3},
     "constraints": [{"type": "triangle_strain", "name": "stretch", "stiffness": 400},
                     {"type": "hinge", "name": "bend", "stiffness": 0.001}]},
    {"name": "block", "mesh": {"shape": "bar", "cells": [2, 2, 2], "size": [0.2, 0.2, 0.2]},
     "transform": {"translate": [0.4, 0.4, 0.02]}, "mass": {"total": 4},
     "constraints": [{"type": "tetrahedron_strain", "name": "flesh", "stiffness": 50000}]}],
  "contact": {"friction": 0.5, "surfaces": false},
  "colliders": [
    {"type": "sphere", "name": "ball", "center": [0.5, 0.5, -0.32], "radius": 0.3, "angular_velocity": [0, 0, 1]},
    {"type": "plane", "name": "floor", "position": [0, 0, -0.4], "surface_velocity": [0.3, 0, 0], "friction": 0.2}],
  "moves": [{"group": "ball", "step": 6, "offset": [0.1, 0, 0.1], "over": 0.4, "ease": "smooth"}],
  "events": [
    {"step": 12, "change": "ball", "radius": 0.28, "friction": 1},
    {"step": 15, "add": {"type": "capsule", "name": "pole", "from": [0.1, 0, -0.3], "to": [0.1, 1, -0.3]}},
    {"step": 17, "move": "pole", "keyframes": [{"time": 0.1, "translate": [0.1, 0, 0]},
                                               {"time": 0.5, "rotate": {"axis": [0, 0, 1], "degrees": 70}}]},
    {"step": 25, "contact": {"friction": 0.1}},
    {"step": 33, "add": {"type": "box", "name": "step", "center": [0.9, 0.5, -0.4], "size": [0.3, 0.3, 0.3]}},
    {"step": 38, "move": "ball", "target": [0.4, 0.5, -0.3]},
    {"step": 41, "remove": "pole"},
    {"step": 44, "follow": "step", "body": "block", "vertices": 0},
    {"step": 52, "stop": "step"}]
})";

std::vector<Pose> poses(const State& state) {
  std::vector<Pose> poses;
  for (const ColliderState& each : state.contact.colliders) poses.push_back(each.pose);
  return poses;
}

/// Runs to the end, with a checkpoint at every tenth step, and takes each of them up.
void check_resume(Scene scene) {
  const TemporaryFolder folder;
  std::vector<State> states = {scene.simulation.state()};
  std::vector<std::int64_t> checkpoints;
  const auto path = [&](std::int64_t step) { return folder.path() / fmt::format("{}.pliant", step); };
  for (std::int64_t step = 0; step < scene.steps; ++step) {
    if (step % 10 == 0) {
      write_checkpoint(path(step), scene);
      checkpoints.push_back(step);
    }
    scene.step();
    states.push_back(scene.simulation.state());
  }
  REQUIRE(checkpoints.size() >= 6);
  for (const std::int64_t step : checkpoints) {
    CAPTURE(step);
    Scene resumed = read_checkpoint(path(step));
    CHECK(resumed.steps == scene.steps);
    for (std::int64_t i = step;; ++i) {
      const State& state = resumed.simulation.state();
      const State& expected = states[static_cast<std::size_t>(i)];
      REQUIRE(state.positions == expected.positions);
      REQUIRE(state.velocities == expected.velocities);
      REQUIRE(poses(state) == poses(expected));
      REQUIRE(state.step == expected.step);
      REQUIRE(state.time == expected.time);
      if (i == scene.steps) break;
      resumed.step();
    }
    // Nothing of the stop is left: the two runs write the same checkpoint.
    write_checkpoint(folder.path() / "again.pliant", resumed);
    write_checkpoint(path(scene.steps), scene);
    CHECK(TemporaryFolder::read(folder.path() / "again.pliant") == TemporaryFolder::read(path(scene.steps)));
  }
}

Scene builtin(std::string_view name, const SceneOverrides& overrides) {
  const auto found = std::ranges::find(builtin_scenes(), name, &BuiltinScene::name);
  REQUIRE(found != builtin_scenes().end());
  return parse_scene(found->text, {}, name, overrides);
}

Scene small_chain() {
  return parse_scene(R"({"pliant": 1, "bodies": [{"mesh": {"shape": "chain", "links": 2}, "mass": {"total": 1},
    "constraints": [{"type": "position", "name": "hook", "on": [0]}, {"type": "edge_spring", "name": "links"}]}],
    "moves": [{"group": "hook", "time": 0, "offset": [1, 0, 0], "over": 1}]})",
                     {}, "chain.json", {.steps = 9, .threads = 1});
}

std::string refusal(std::string_view bytes, const ResumeOptions& options = {}) {
  try {
    parse_checkpoint(bytes, "run.pliant", options);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    return error.what();
  }
  return "(taken)";
}

}  // namespace

TEST_CASE("resume at every tenth step: the same bits") {
  SUBCASE("a busy scene") {
    check_resume(parse_scene(busy_scene, {}, "busy.json"));
  }
  SUBCASE("the torus, its jumping pins and signed bending") {
    check_resume(builtin("torus", {.steps = 60}));
  }
  SUBCASE("the pillow, with a gas in it") {
    check_resume(builtin("pillow", {.steps = 60}));
  }
  SUBCASE("BDF2 in substeps with damping, with what it remembers of the step before") {
    const std::vector<std::string> set = {"settings.integrator=bdf2", "settings.substeps=2", "settings.damping=3"};
    check_resume(parse_scene(busy_scene, {}, "busy.json", {.set = set}));
  }
  SUBCASE("energy projection, with what single iterations have had too much") {
    const std::vector<std::string> set = {"settings.energy_projection=1", "settings.iterations=1"};
    check_resume(parse_scene(busy_scene, {}, "busy.json", {.set = set}));
    Scene scene = builtin("bar", {.steps = 60, .set = set});
    for (int i = 0; i < 40; ++i) scene.step();
    const std::vector<Real>& surplus = scene.simulation.state().energy_surplus;
    CHECK(std::ranges::any_of(surplus, [](Real energy) { return energy > 0; }));
    check_resume(builtin("bar", {.steps = 60, .set = set}));
  }
  SUBCASE("colliders that move, with what friction remembers") {
    Scene scene = parse_scene(scene_with_colliders, {}, "colliders.json");
    Index contacts = 0;
    for (int i = 0; i < 60; ++i) contacts += scene.step().contact.contacts;
    CHECK(contacts > 200);
    CHECK(!scene.simulation.state().contact.memory.empty());
    check_resume(parse_scene(scene_with_colliders, {}, "colliders.json"));
    const std::vector<std::string> set = {"settings.integrator=bdf2", "settings.substeps=2"};
    check_resume(parse_scene(scene_with_colliders, {}, "colliders.json", {.set = set}));
  }
  SUBCASE("contact in the factor") {
    const std::vector<std::string> set = {"bodies[sheet].mass.area_density=0.01", "settings.time_step=0.1"};
    Scene scene = parse_scene(scene_with_colliders, {}, "colliders.json", {.set = set});
    bool was_in_factor = false;
    for (int i = 0; i < 60; ++i) {
      scene.step();
      was_in_factor |= !scene.simulation.state().contact.in_factor.empty();
    }
    CHECK(was_in_factor);
    check_resume(parse_scene(scene_with_colliders, {}, "colliders.json", {.set = set}));
  }
}

/// A checkpoint of colliders in full swing, to be spoiled.
class Spoiled {
 public:
  Spoiled() {
    const TemporaryFolder folder;
    Scene scene = parse_scene(scene_with_colliders, {}, "colliders.json");
    for (int i = 0; i < 20; ++i) scene.step();
    write_checkpoint(folder.path() / "c.pliant", scene);
    content_ = Json::from_cbor(TemporaryFolder::read(folder.path() / "c.pliant").substr(24));
    vertex_count = scene.simulation.state().masses.size();
    REQUIRE(refusal_of([](Json&) {}) == "(taken)");
  }

  std::string refusal_of(const std::function<void(Json&)>& spoil) const {
    Json changed = content_;
    spoil(changed);
    std::string bytes;
    Json::to_cbor(changed, bytes);
    return refusal(pliant_tests::checkpoint_bytes(bytes, 4));
  }
  void check_contact(const std::string& what, const std::function<void(Json&)>& spoil) const {
    check(what, "run.pliant: state", [&](Json& json) { spoil(json["state"]["contact"]); });
  }
  void check_motions(const std::string& what, const std::function<void(Json&)>& spoil) const {
    check(what, "run.pliant: timeline", [&](Json& json) { spoil(json["timeline"]["collider_motions"]); });
  }

  std::size_t vertex_count = 0;

 private:
  void check(const std::string& what, const std::string& start, const std::function<void(Json&)>& spoil) const {
    const std::string message = refusal_of(spoil);
    CAPTURE(message);
    CHECK(message.starts_with(start));
    CHECK(message.find(what) != std::string::npos);
  }

  Json content_;
};

Json bytes_of(const std::vector<Real>& numbers) {
  const auto* begin = reinterpret_cast<const std::uint8_t*>(numbers.data());  // NOLINT: bytes of numbers
  return Json::binary(std::vector<std::uint8_t>(begin, begin + sizeof(Real) * numbers.size()));
}

TEST_CASE("contact that no run can have left is refused by name") {
  const Spoiled file;
  file.check_contact("found null; give an object", [](Json& contact) { contact = Json(); });
  file.check_contact("its colliders are others", [](Json& contact) { contact["colliders"].erase(0); });
  file.check_contact("its colliders are others", [](Json& contact) { contact["colliders"][0]["collider"] = 7; });
  file.check_contact("a rotation of length 1", [](Json& contact) {
    contact["colliders"][1]["pose"]["rotation"] = bytes_of({0, 0, 0, 2});
  });
  file.check_contact("not finite", [](Json& contact) {
    contact["colliders"][0]["pose"]["position"] = bytes_of({0, std::numeric_limits<Real>::infinity(), 0});
  });
  file.check_contact("3 numbers belong here",
                     [](Json& contact) { contact["colliders"][0]["pose"]["position"] = bytes_of({0}); });
  const std::string unknown = "a contact is of a vertex or a collider";
  file.check_contact(unknown, [](Json& contact) { contact["vertices"].back() = 100000; });
  file.check_contact(unknown, [](Json& contact) { contact["touched"].back() = 9; });
  file.check_contact("the contacts are not in order", [](Json& contact) { contact["vertices"][0] = 100000; });
  file.check_contact("one a contact", [](Json& contact) { contact["touched"].erase(0); });
  file.check_contact("numbers belong here", [](Json& contact) { contact["anchors_and_loads"] = bytes_of({1}); });
  file.check_contact("numbers belong here", [](Json& contact) { contact["stiffening"] = bytes_of({1, 1}); });
  file.check_contact("a stiffness of contacts is out of range", [&](Json& contact) {
    contact["stiffening"] = bytes_of(std::vector<Real>(file.vertex_count, 0.5));
  });
  file.check_contact("what the factor has of contact is out of range",
                     [&](Json& contact) { contact["in_factor"] = bytes_of(std::vector<Real>(file.vertex_count, -1)); });
  file.check_contact("numbers belong here", [](Json& contact) { contact["energies"] = bytes_of({1}); });
  file.check_contact("energies: a number is not finite", [&](Json& contact) {
    contact["energies"] = bytes_of(std::vector<Real>(file.vertex_count, std::numeric_limits<Real>::infinity()));
  });
  file.check_contact("light_steps", [](Json& contact) { contact["light_steps"] = -1; });
  file.check_contact("light_steps", [](Json& contact) { contact["light_steps"] = 2000000000; });
}

TEST_CASE("the step of a change that no run can have had, and a flag that is none, are refused by name") {
  const Spoiled file;
  const auto change = [&](const Json& step) {
    return file.refusal_of([&](Json& json) { json["state"]["changed_step"] = step; });
  };
  CHECK(change(20) == "(taken)");
  for (const Json& step : {Json(0), Json(-3), Json(21 + 20), Json(std::int64_t{1} << 60)}) {
    CAPTURE(step.dump());
    CHECK(change(step).find("changed_step: " + step.dump() + " is out of range") != std::string::npos);
  }
  CHECK(change("20") == "run.pliant: state.changed_step: found a string; give a whole number");
  const auto beside = [&](const Json& is_beside) {
    return file.refusal_of([&](Json& json) { json["groups"][0]["batches"][0]["is_beside_factor"] = is_beside; });
  };
  CHECK(beside(true) == "(taken)");
  CHECK(beside(1).find("is_beside_factor: found a number") != std::string::npos);
}

TEST_CASE("motions of colliders that have not begun are refused by name") {
  const Spoiled file;
  const std::string unsound = "one position and a rotation of length 1";
  file.check_motions("motion 5 of event", [](Json& motions) { motions[0]["order"] = 5; });
  file.check_motions(unsound, [](Json& motions) { motions[0]["points"] = Json::array(); });
  file.check_motions(unsound, [](Json& motions) { motions[0]["rotation"] = bytes_of({0, 0, 0, 0}); });
  file.check_motions("'rotation' is missing", [](Json& motions) { motions[0].erase("rotation"); });
}

TEST_CASE("a checkpoint says how far to go, and can be asked to go further") {
  const TemporaryFolder folder;
  Scene scene = small_chain();
  while (scene.simulation.state().step < 9) scene.step();
  write_checkpoint(folder.path() / "c.pliant", scene);
  CHECK(read_checkpoint(folder.path() / "c.pliant", {.steps = 12}).steps == 12);
  CHECK(read_checkpoint(folder.path() / "c.pliant", {.threads = 2}).simulation.settings().threads == 2);
  const std::string message = refusal(TemporaryFolder::read(folder.path() / "c.pliant"), {.steps = 8});
  CHECK(message == "run.pliant: 8 steps in all were asked for, but 9 have been taken; ask for more");
}

TEST_CASE("a checkpoint cut at any length is refused by name") {
  const TemporaryFolder folder;
  Scene scene = small_chain();
  scene.step();
  write_checkpoint(folder.path() / "c.pliant", scene);
  const std::string whole = TemporaryFolder::read(folder.path() / "c.pliant");
  CHECK(refusal(whole) == "(taken)");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CAPTURE(size);
    const std::string message = refusal(std::string_view(whole).substr(0, size));
    CHECK(message.starts_with("run.pliant: "));
    CHECK(message.find("checkpoint") != message.npos);
  }
  CHECK(refusal(whole + "x").find("damaged") != std::string::npos);
}

TEST_CASE("a checkpoint with any byte changed is refused by name") {
  const TemporaryFolder folder;
  Scene scene = small_chain();
  scene.step();
  write_checkpoint(folder.path() / "c.pliant", scene);
  const std::string whole = TemporaryFolder::read(folder.path() / "c.pliant");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int flip : {0x01, 0x80, 0xff}) {
      CAPTURE(i);
      std::string changed = whole;
      changed[i] = static_cast<char>(changed[i] ^ flip);
      CHECK(refusal(changed).starts_with("run.pliant: "));
    }
  }
}

TEST_CASE("scenes that are included are taken up as they were, whatever became of their files") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "sub");
  const auto rope = [](int stiffness) {
    return fmt::format(R"({{"pliant": 1, "bodies": [{{"mesh": {{"shape": "chain", "links": 3}}, "mass": {{"total": 1}},
      "constraints": [{{"type": "position", "on": [0]}}, {{"type": "edge_spring", "stiffness": {}}}]}}]}})",
                       stiffness);
  };
  folder.write("sub/rope.json", rope(100));
  folder.write("sub/scene.json", R"({"pliant": 1, "steps": 6, "include": ["rope.json", "chain"]})");
  Scene whole = load_scene(folder.path() / "sub" / "scene.json", {.threads = 1});
  for (int i = 0; i < 3; ++i) whole.step();
  write_checkpoint(folder.path() / "run.pliant", whole);
  for (int i = 0; i < 3; ++i) whole.step();
  for (const bool is_removed : {false, true}) {
    if (is_removed) {
      std::filesystem::remove_all(folder.path() / "sub");
    } else {
      folder.write("sub/rope.json", rope(9));
      folder.write("sub/chain", rope(7));  // would come before the built-in scene of that name
    }
    Scene resumed = read_checkpoint(folder.path() / "run.pliant");
    for (int i = 0; i < 3; ++i) resumed.step();
    CHECK(resumed.simulation.state().positions == whole.simulation.state().positions);
  }
}

TEST_CASE("checkpoints of other versions are refused by name") {
  const TemporaryFolder folder;
  const Scene scene = small_chain();
  write_checkpoint(folder.path() / "c.pliant", scene);
  const std::string content = TemporaryFolder::read(folder.path() / "c.pliant").substr(24);
  for (const std::uint32_t known : {3U, 4U}) {
    CHECK(refusal(pliant_tests::checkpoint_bytes(content, known)) == "(taken)");
  }
  CHECK(refusal(pliant_tests::checkpoint_bytes(content, 1)) ==
        "run.pliant: this checkpoint was written by Pliant 0.1.0, whose format this version no longer reads; resume it "
        "with Pliant 0.1.0, or run the scene from its start");
  for (const std::uint32_t other : {2U, 5U}) {
    CHECK(refusal(pliant_tests::checkpoint_bytes(content, other))
              .find(fmt::format("has the format {}, and this program reads 4;", other)) != std::string::npos);
  }
}

TEST_CASE("a checkpoint of the format 3, in which surfaces touched on request alone, goes on without them") {
  constexpr std::string_view text = R"({"pliant": 1, "steps": 20, "settings": {"threads": 1}, "bodies": [
    {"name": "upper", "mesh": {"shape": "grid", "columns": 4, "rows": 4, "plane": "xy"}, "mass": {"total": 1},
     "transform": {"translate": [0, 0, 0.1]}, "constraints": [{"type": "triangle_strain", "stiffness": 100}]},
    {"name": "lower", "mesh": {"shape": "grid", "columns": 5, "rows": 5, "plane": "xy"}, "mass": {"total": 1},
     "constraints": [{"type": "position"}]}], "contact": {"friction": 0.4}})";
  const TemporaryFolder folder;
  Scene old = parse_scene(text, {}, "s.json", {.set = {"contact.surfaces=false"}});
  for (int i = 0; i < 5; ++i) old.step();
  write_checkpoint(folder.path() / "c.pliant", old);
  Json content = Json::from_cbor(TemporaryFolder::read(folder.path() / "c.pliant").substr(24));
  content["source"]["set"] = Json::array();  // as a program of those days has written it
  std::string bytes;
  Json::to_cbor(content, bytes);

  Scene resumed = parse_checkpoint(pliant_tests::checkpoint_bytes(bytes, 3), "run.pliant");
  for (int i = 5; i < 12; ++i) resumed.step();
  write_checkpoint(folder.path() / "again.pliant", resumed);
  Scene once_more = read_checkpoint(folder.path() / "again.pliant");
  for (Scene* each : {&resumed, &once_more}) {
    CHECK(each->simulation.contact() == ContactSettings{.friction = 0.4, .surfaces = false});
    CHECK_FALSE(each->has_surfaces);
    while (each->simulation.state().step < 20) each->step();
  }
  while (old.simulation.state().step < 20) old.step();
  CHECK(resumed.simulation.state().positions == old.simulation.state().positions);
  CHECK(once_more.simulation.state().positions == old.simulation.state().positions);
  CHECK(old.simulation.state().positions.topRows(16).col(2).mean() < -0.1);  // it has fallen through the lower one
  CHECK(parse_checkpoint(pliant_tests::checkpoint_bytes(bytes, 4), "run.pliant").simulation.contact().surfaces);
  content["source"]["set"] = Json::array();
  content["source"]["set"].push_back(Json::binary(
      {'c', 'o', 'n', 't', 'a', 'c', 't', '.', 's', 'u', 'r', 'f', 'a', 'c', 'e', 's', '=', 't', 'r', 'u', 'e'}));
  bytes.clear();
  Json::to_cbor(content, bytes);
  CHECK(parse_checkpoint(pliant_tests::checkpoint_bytes(bytes, 3), "run.pliant").simulation.contact().surfaces);
}

TEST_CASE("a mesh that was changed since is named") {
  const TemporaryFolder folder;
  const auto mesh = folder.path() / "sail.obj";
  folder.write("sail.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  const Scene scene = parse_scene(R"({"pliant": 1, "bodies": [{"mesh": {"file": "sail.obj"}, "mass": {"total": 1}}]})",
                                  folder.path(), "s.json");
  const auto checkpoint = folder.path() / "c.pliant";
  write_checkpoint(checkpoint, scene);
  CHECK(refusal(TemporaryFolder::read(checkpoint)) == "(taken)");
  folder.write("sail.obj", "v 0 0 0\nv 1 0 0\nv 0 0 2\nf 1 2 3\n");
  CHECK(refusal(TemporaryFolder::read(checkpoint)).find("sail.obj is not as it was") != std::string::npos);
  std::filesystem::remove(mesh);
  CHECK(refusal(TemporaryFolder::read(checkpoint)).find("sail.obj: no such file") != std::string::npos);
}

}  // namespace test_checkpoint
