// Surfaces that touch, stopped and taken up again: the same bits, and what no run can have left is refused.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/scene/scene.h"
#include "tests/support/spoilt_checkpoint.h"
#include "tests/support/temporary_folder.h"

namespace test_surface_checkpoint {

using namespace pliant;
using pliant_tests::TemporaryFolder;
using Json = nlohmann::json;

namespace {

/// Cloth, a solid and a rope fall onto a sheet that is held, one slides; how they touch changes on the way.
constexpr std::string_view scene_text = R"({
  "pliant": 1, "steps": 60, "settings": {"iterations": 8, "threads": 1},
  "contact": {"surfaces": true, "friction": 0.4},
  "bodies": [
    {"name": "table", "mesh": {"shape": "grid", "columns": 9, "rows": 9, "plane": "xy"}, "mass": {"total": 1},
     "transform": {"translate": [-0.5, -0.5, 0]}, "constraints": [{"type": "position"}]},
    {"name": "cloth", "mesh": {"shape": "grid", "columns": 7, "rows": 7, "size": [0.4, 0.4], "plane": "xy"},
     "transform": {"rotate": {"axis": [0.2, 0.1, 1], "degrees": 20}, "translate": [-0.2, -0.2, 0.1]},
     "mass": {"area_density": 0.3}, "velocity": [1, 0, 0],
     "constraints": [{"type": "triangle_strain", "stiffness": 300}, {"type": "hinge", "stiffness": 1e-4}]},
    {"name": "block", "mesh": {"shape": "bar", "cells": [2, 1, 1], "size": [0.2, 0.1, 0.1]},
     "transform": {"rotate": {"axis": [1, 1, 0], "degrees": 25}, "translate": [-0.1, 0, 0.3]},
     "mass": {"density": 300}, "constraints": [{"type": "tetrahedron_strain", "stiffness": 20000}],
     "contact": {"distance": 0.02, "friction": 0.8}},
    {"name": "rope", "mesh": {"shape": "chain", "links": 12, "length": 0.5, "direction": [1, 0.2, 0.1]},
     "transform": {"translate": [-0.25, -0.1, 0.2]}, "mass": {"line_density": 0.1},
     "constraints": [{"type": "edge_spring", "stiffness": 2000}], "contact": {"ignores": ["block"]}}],
  "events": [
    {"step": 25, "contact": {"friction": 0.1}},
    {"step": 35, "body": "rope", "contact": {"ignores": [], "friction": 0}},
    {"step": 45, "body": "block", "contact": {"distance": 0.01, "self": false}}]
})";

Scene falling_bodies(const SceneOverrides& overrides = {}) {
  return parse_scene(scene_text, {}, "surfaces.json", overrides);
}

void check_resume(const SceneOverrides& overrides) {
  const TemporaryFolder folder;
  Scene scene = falling_bodies(overrides);
  std::vector<State> states = {scene.simulation.state()};
  const auto path = [&](std::int64_t step) { return folder.path() / fmt::format("{}.pliant", step); };
  Index active = 0;
  std::size_t remembered = 0;
  for (std::int64_t step = 0; step < scene.steps; ++step) {
    if (step % 10 == 0) write_checkpoint(path(step), scene);
    active += scene.step().contact.active;
    states.push_back(scene.simulation.state());
    remembered += scene.simulation.state().contact.pairs.size();
  }
  REQUIRE(active > 200);
  REQUIRE(remembered > 200);
  for (std::int64_t begin = 0; begin < scene.steps; begin += 10) {
    CAPTURE(begin);
    Scene resumed = read_checkpoint(path(begin));
    for (std::int64_t i = begin;; ++i) {
      const State& state = resumed.simulation.state();
      const State& expected = states[static_cast<std::size_t>(i)];
      CAPTURE(i);
      REQUIRE(state.positions == expected.positions);
      REQUIRE(state.velocities == expected.velocities);
      REQUIRE(state.contact.pairs.size() == expected.contact.pairs.size());
      REQUIRE(state.contact.stiffening == expected.contact.stiffening);
      REQUIRE(state.contact.energies == expected.contact.energies);
      if (i == scene.steps) break;
      resumed.step();
    }
    CHECK(resumed.simulation.contact(BodyId{3}) == scene.simulation.contact(BodyId{3}));
    CHECK(resumed.simulation.contact(BodyId{2}) == scene.simulation.contact(BodyId{2}));
  }
}

}  // namespace

TEST_CASE("surfaces: a run that is resumed at every tenth step has the same bits") {
  check_resume({});
}

TEST_CASE("surfaces: a run with BDF2 in substeps and a collider has the same bits after it is resumed") {
  const std::vector<std::string> set = {"settings.integrator=bdf2", "settings.substeps=2", "settings.iterations=3",
                                        R"(colliders=[{"type": "plane", "position": [0, 0, -0.2]}])"};
  check_resume({.set = set});
}

TEST_CASE("surfaces: pairs that no run can have left are refused by name") {
  const TemporaryFolder folder;
  Scene scene = falling_bodies();
  for (int i = 0; i < 60 && scene.simulation.state().contact.pairs.size() < 4; ++i) scene.step();
  REQUIRE(scene.simulation.state().contact.pairs.size() > 2);
  write_checkpoint(folder.path() / "c.pliant", scene);
  const Json content = Json::from_cbor(TemporaryFolder::read(folder.path() / "c.pliant").substr(24));
  const auto check = [&](const std::string& what, const pliant_tests::ContactChange& spoil) {
    pliant_tests::check_refusal_of_contact(content, what, spoil);
  };
  CHECK(pliant_tests::refusal_of_contact(content, [](Json&) {}) == "(taken)");
  check("three numbers for each pair", [](Json& contact) { contact["pairs"].erase(0); });
  check("three numbers for each pair", [](Json& contact) { contact["pairs"].push_back(0); });
  check("give a list", [](Json& contact) { contact["pairs"] = 3; });
  check("pairs", [](Json& contact) { contact.erase("pairs"); });
  check("slides", [](Json& contact) { contact.erase("slides"); });
  check("has the kind 3", [](Json& contact) { contact["pairs"][0] = 3; });
  check("has the kind -1", [](Json& contact) { contact["pairs"][0] = -1; });
  check("pairs[0]", [](Json& contact) { contact["pairs"][0] = "vertex"; });
  check("pairs[1]", [](Json& contact) { contact["pairs"][1] = 0.5; });
  check("a pair is none", [](Json& contact) { contact["pairs"][1] = -1; });
  check("not in order", [](Json& contact) {
    for (std::size_t i = 0; i < 3; ++i)
      std::swap(contact["pairs"][i], contact["pairs"][contact["pairs"].size() - 3 + i]);
  });
  check("numbers belong here", [](Json& contact) { contact["slides"] = Json::binary({0, 0, 0, 0, 0, 0, 0, 0}); });
  const auto with_first_number = [](Real number) {
    return [number](Json& contact) {
      auto& bytes = contact["slides"].get_binary();
      std::memcpy(bytes.data(), &number, sizeof(number));
    };
  };
  check("not finite", with_first_number(std::nan("")));
  check("not finite", with_first_number(std::numeric_limits<Real>::infinity()));
}

}  // namespace test_surface_checkpoint
