// Scenes that begin with crossings, stopped and taken up again in the middle of them: the same bits.
#include <functional>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/scene/scene.h"
#include "tests/scene/whole_scenes.h"
#include "tests/support/spoilt_checkpoint.h"
#include "tests/support/temporary_folder.h"

namespace test_let_go_scenes {

using namespace pliant;
using pliant_tests::TemporaryFolder;
using Json = nlohmann::json;

namespace {

/// An upright sheet through a flat one, a third one a millimeter above that, and a plate that comes up from below: the
/// sheets hang between it and one that is pinned above.
constexpr std::string_view scene_text = R"({
  "pliant": 1, "steps": 36, "settings": {"iterations": 8, "threads": 1},
  "contact": {"surfaces": true, "friction": 0.4},
  "bodies": [
    {"name": "flat", "mesh": {"shape": "grid", "columns": 8, "rows": 8, "size": [0.6, 0.6], "plane": "xy"},
     "transform": {"translate": [-0.3, -0.3, 0]}, "mass": {"area_density": 0.3},
     "constraints": [{"type": "triangle_strain", "stiffness": 300}]},
    {"name": "upright", "mesh": {"shape": "grid", "columns": 7, "rows": 7, "size": [0.3, 0.3]},
     "transform": {"translate": [-0.15, 0.01, -0.14]}, "mass": {"area_density": 0.3},
     "constraints": [{"type": "triangle_strain", "stiffness": 300}]},
    {"name": "near", "mesh": {"shape": "grid", "columns": 5, "rows": 5, "size": [0.2, 0.2], "plane": "xy"},
     "transform": {"translate": [-0.28, -0.28, 0.001]}, "mass": {"area_density": 0.3},
     "constraints": [{"type": "triangle_strain", "stiffness": 300}]},
    {"name": "lid", "mesh": {"shape": "grid", "columns": 6, "rows": 6, "plane": "xy"},
     "transform": {"translate": [-0.5, -0.5, 0.2]}, "mass": {"total": 1}, "constraints": [{"type": "position"}]},
    {"name": "plate", "mesh": {"shape": "grid", "columns": 6, "rows": 6, "plane": "xy"},
     "transform": {"translate": [-0.52, -0.47, -0.25]}, "mass": {"total": 1},
     "constraints": [{"type": "position", "name": "lift"}]}],
  "moves": [{"group": "lift", "time": 0.1, "offset": [0, 0, 0.6], "over": 0.5}]
})";

Scene crossed_scene(const SceneOverrides& overrides = {}) {
  return parse_scene(scene_text, {}, "crossed.json", overrides);
}

}  // namespace

TEST_CASE("let go: a scene that is resumed in the middle has the same bits") {
  const TemporaryFolder folder;
  Scene scene = crossed_scene();
  const std::int64_t steps = pliant_tests::runs_whole_scenes ? scene.steps : 2;
  std::vector<State> states = {scene.simulation.state()};
  const auto path = [&](std::int64_t step) { return folder.path() / fmt::format("{}.pliant", step); };
  std::size_t let_go = 0, reduced = 0, held_up = 0;
  for (std::int64_t step = 0; step < steps; ++step) {
    if (step % 20 == 10 || steps < 10) write_checkpoint(path(step), scene);
    scene.step();
    states.push_back(scene.simulation.state());
    const LetGoState& now = scene.simulation.state().contact.let_go;
    let_go += now.pairs.size();
    reduced += now.reduced.size();
    held_up += now.held_up.size();
  }
  CHECK(let_go > 0);
  CHECK(reduced > 0);
  if (pliant_tests::runs_whole_scenes) CHECK(held_up > 0);
  for (std::int64_t begin = steps < 10 ? 0 : 10; begin < steps; begin += 20) {
    CAPTURE(begin);
    Scene resumed = read_checkpoint(path(begin));
    for (std::int64_t i = begin;; ++i) {
      CAPTURE(i);
      const State& state = resumed.simulation.state();
      const State& expected = states[static_cast<std::size_t>(i)];
      REQUIRE(state.positions == expected.positions);
      REQUIRE(state.velocities == expected.velocities);
      REQUIRE(state.contact.let_go.pairs == expected.contact.let_go.pairs);
      REQUIRE(state.contact.let_go.reduced == expected.contact.let_go.reduced);
      REQUIRE(state.contact.let_go.held_up == expected.contact.let_go.held_up);
      if (i == steps) break;
      resumed.step();
    }
  }
}

TEST_CASE("let go: what no run can have left is refused by name") {
  const TemporaryFolder folder;
  Scene scene = crossed_scene();
  scene.step();
  write_checkpoint(folder.path() / "c.pliant", scene);
  const Json content = Json::from_cbor(TemporaryFolder::read(folder.path() / "c.pliant").substr(24));
  const auto check = [&](const std::string& what, const std::function<void(Json&)>& spoil) {
    pliant_tests::check_refusal_of_contact(content, what, [&](Json& contact) { spoil(contact["let_go"]); });
  };
  CHECK(pliant_tests::refusal_of_contact(content, [](Json&) {}) == "(taken)");
  check("3 numbers for each", [](Json& let_go) { let_go["pairs"].push_back(1); });
  check("2 numbers for each", [](Json& let_go) { let_go["reduced"].erase(0); });
  check("pairs", [](Json& let_go) { let_go.erase("pairs"); });
  check("shares", [](Json& let_go) { let_go.erase("shares"); });
  check("is_known", [](Json& let_go) { let_go["is_known"] = 7; });
  check("pairs[0]", [](Json& let_go) { let_go["pairs"][0] = 0.5; });
  check("that there is not", [](Json& let_go) { let_go["pairs"][0] = -1; });
  check("that there is not", [](Json& let_go) { let_go["reduced"][1] = 9; });
  check("that there is not", [](Json& let_go) { let_go["held_up"] = Json::array({-2, 1}); });
  check("numbers belong here", [](Json& let_go) { let_go["shares"] = Json::binary({1, 2, 3}); });
}

}  // namespace test_let_go_scenes
