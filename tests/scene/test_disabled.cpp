// What a scene has switched off: read, checked and named as everything else, and not in the simulation.
#include <string>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant_io/scene/scene.h"

namespace test_disabled {

namespace {

using pliant::Scene;

/// A cloth with pins, a force and a ball; `enabled` stands in those entries, `events` in that list.
std::string scene_text(const std::string& enabled, const std::string& events = "") {
  return R"({ "pliant": 1, "settings": { "iterations": 5 }, "gravity": { "acceleration": [0, 0, -5])" + enabled +
         R"( },
  "bodies": [ { "name": "sheet", "mass": { "total": 1 },
    "mesh": { "shape": "grid", "columns": 5, "rows": 5, "plane": "xz" },
    "constraints": [ { "type": "position", "on": [20] },
      { "type": "position", "on": [20, 24])" +
         enabled + R"( }, { "type": "triangle_strain", "name": "stretch" },
      { "type": "hinge", "stiffness": 0.01)" +
         enabled + R"( } ] },
    { "name": "rope", "mass": { "total": 0.1 }, "mesh": { "shape": "chain" }, "transform": { "translate": [0, 0.2, 0] },
      "constraints": [ { "type": "edge_spring" } ] } ],
  "attachments": [ { "name": "knot", "from": { "body": "rope", "on": [0] }, "to": { "body": "sheet" })" +
         enabled + R"( } ],
  "forces": [ { "type": "wind", "velocity": [0, 3, 0])" +
         enabled + R"( }, { "type": "wind", "velocity": [0, 0.5, 0] } ],
  "colliders": [ { "type": "sphere", "center": [0.5, 0.3, 0.3], "radius": 0.25)" +
         enabled + R"( }, { "type": "sphere", "center": [0, 0, -9] } ],
  "events": [)" +
         events + "] }";
}

Scene read(const std::string& text) {
  return pliant::parse_scene(text, {}, "s.json");
}

std::string message_of(const std::string& text) {
  try {
    read(text);
  } catch (const pliant::Error& error) {
    CHECK(error.kind() == pliant::ErrorKind::input);
    return error.what();
  }
  return "(no error)";
}

pliant::Positions after(Scene& scene, int steps) {
  for (int i = 0; i < steps; ++i) scene.step();
  return scene.simulation.state().positions;
}

constexpr const char* off = R"(, "enabled": false)";

}  // namespace

TEST_CASE("a scene with what is switched off has the bits of one without it") {
  // The same with what is off taken out, and the names that are left given.
  Scene without = read(R"({ "pliant": 1, "settings": { "iterations": 5 }, "gravity": null,
  "bodies": [ { "name": "sheet", "mass": { "total": 1 },
    "mesh": { "shape": "grid", "columns": 5, "rows": 5, "plane": "xz" },
    "constraints": [ { "type": "position", "on": [20] }, { "type": "triangle_strain", "name": "stretch" } ] },
    { "name": "rope", "mass": { "total": 0.1 }, "mesh": { "shape": "chain" }, "transform": { "translate": [0, 0.2, 0] },
      "constraints": [ { "type": "edge_spring" } ] } ],
  "forces": [ { "type": "wind", "name": "wind 2", "velocity": [0, 0.5, 0] } ],
  "colliders": [ { "type": "sphere", "name": "sphere 2", "center": [0, 0, -9] } ] })");
  Scene scene = read(scene_text(off));
  CHECK(scene.simulation.group_names() == without.simulation.group_names());
  CHECK(scene.group_names == without.group_names);
  CHECK(scene.collider_names == without.collider_names);
  CHECK(scene.simulation.forces().size() == 1);
  CHECK(scene.simulation.find_force("wind 2").has_value());
  CHECK(scene.simulation.colliders().size() == 1);
  CHECK(after(scene, 100) == after(without, 100));
}

TEST_CASE("what is switched off keeps its name and its place, and tells what it is") {
  const Scene scene = read(scene_text(off));
  CHECK(scene.disabled.size() == 6);
  CHECK(scene.places.at("sheet.position 2") == "bodies[0].constraints[1]");
  CHECK(scene.places.at("gravity") == "gravity");
  CHECK(scene.places.at("wind") == "forces[0]");
  CHECK(scene.disabled.at("sheet.position 2").pinned == std::vector<pliant::Index>{20, 24});
  CHECK_FALSE(scene.disabled.at("sheet.position 2").goes_with_material);
  CHECK(scene.disabled.at("sheet.hinge").type == "hinge");
  CHECK(scene.disabled.at("sheet.hinge").goes_with_material);
  CHECK(scene.disabled.at("knot").body == pliant::BodyId{1});
  CHECK_FALSE(scene.disabled.at("wind").body.has_value());
  CHECK(scene.disabled.at("sphere").is_collider);
  // With "enabled": true all is there, and what the pins of both groups hold is told.
  CHECK(message_of(scene_text(R"(, "enabled": true)")).find("already pinned") != std::string::npos);
  CHECK(message_of(scene_text(off, R"({ "step": 1, "add": { "type": "wind", "name": "sphere" } })"))
            .find("another collider's") != std::string::npos);
}

TEST_CASE("events that act on what is switched off do nothing, and are counted") {
  const std::string events = R"({ "step": 0, "move": "sphere", "offset": [0, 1, 0] },
    { "step": 1, "change": "sheet.hinge", "stiffness": 5, "over": 2 }, { "step": 1, "change": "wind 2", "drag": 2 },
    { "step": 2, "release": "sheet.position 2", "vertices": [20] }, { "step": 2, "stop": "sphere" },
    { "step": 3, "follow": "sphere", "body": "rope" }, { "step": 3, "gravity": [0, 0, -1] },
    { "step": 4, "remove": "sphere" }, { "step": 5, "add": { "type": "sphere", "center": [0, 0, -8] } })";
  Scene scene = read(scene_text(off, events));
  CHECK(scene.idle_events == std::vector<pliant::Index>{0, 1, 3, 4, 5, 7});
  CHECK(scene.timeline.event_count() == 9);
  after(scene, 10);
  CHECK(scene.simulation.find_force("gravity").has_value());  // an event has set it
  const auto ball = scene.simulation.find_collider("sphere");
  REQUIRE(ball.has_value());
  CHECK(scene.simulation.pose(*ball).position.z() == -8);
  CHECK(message_of(scene_text(off, R"({ "step": 0, "remove": "sphere" }, { "step": 1, "remove": "sphere" })"))
            .find("no group, force or collider is called 'sphere' then") != std::string::npos);
}

TEST_CASE("what is switched off is checked as everything else") {
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {R"(, "enabled": "no")", "s.json: bodies[0].constraints[1].enabled: found a string; give true or false"},
           {R"(, "enabled": 0)", "s.json: bodies[0].constraints[1].enabled: found a number; give true or false"},
           {R"(, "enabeld": false)", "s.json: bodies[0].constraints[1].enabeld: unknown key"}}) {
    CHECK(message_of(scene_text(text)).starts_with(message));
  }
  const auto with = [](const std::string& list) {
    return R"({ "pliant": 1, "bodies": [ { "mass": { "total": 1 }, "mesh": { "shape": "grid", "columns": 3, "rows": 3 },
      "constraints": [)" +
           list + "] } ] }";
  };
  CHECK(message_of(with(R"({ "type": "position", "on": [99], "enabled": false })")).find("constraints[0]") !=
        std::string::npos);
  CHECK(message_of(with(R"({ "type": "tetrahedron_strain", "enabled": false })")).find("makes no constraint") !=
        std::string::npos);
  CHECK(message_of(scene_text(off, R"({ "step": 1, "add": { "type": "wind", "enabled": false } })")).find("enabled") !=
        std::string::npos);
}

TEST_CASE("a group of a material is switched off by its name, and keeps the factors of its stiffness") {
  const auto scarf = [](const std::string& more) {
    return read(R"({ "pliant": 1, "bodies": [ { "name": "scarf", "material": "silk",
      "mesh": { "shape": "grid", "columns": 3, "rows": 3 }, "constraints": [ { "type": "position", "on": [0] },
      { "type": "hinge", "name": "fold", "enabled": false } ])" +
                more + "} ] }");
  };
  Scene scene = scarf(R"(, "disabled_groups": ["scarf.bend"],
    "stiffness_factors": { "scarf.bend": [1, 2, 3, 4, 5, 6, 7, 8, 9], "fold": [1, 1, 1, 1, 1, 1, 1, 1, 2] })");
  CHECK_FALSE(scene.simulation.find_group("scarf.bend").has_value());
  CHECK_FALSE(scene.places.contains("scarf.bend"));
  CHECK(scene.disabled.at("scarf.bend").goes_with_material);
  CHECK(scene.disabled.at("scarf.bend").factors.at(8) == 9);
  CHECK(scene.disabled.at("fold").factors.at(8) == 2);
  Scene removed = read(R"({ "pliant": 1, "bodies": [ { "name": "scarf", "material": "silk",
    "mesh": { "shape": "grid", "columns": 3, "rows": 3 }, "constraints": [ { "type": "position", "on": [0] } ] } ],
    "events": [ { "step": 0, "remove": "scarf.bend" } ] })");
  CHECK(after(scene, 30) == after(removed, 30));
  CHECK_THROWS_WITH_AS(scarf(R"(, "disabled_groups": ["scarf.bnd"])"),
                       doctest::Contains("bodies[0].disabled_groups[0]: 'scarf.bnd' is no group"), pliant::Error);
  CHECK_THROWS_WITH_AS(scarf(R"(, "disabled_groups": ["fold"])"), doctest::Contains("entry of its own"), pliant::Error);
  CHECK_THROWS_WITH_AS(scarf(R"(, "disabled_groups": "scarf.bend")"), doctest::Contains("disabled_groups"),
                       pliant::Error);
}

TEST_CASE("a solid's surface is tied as stiffly with a group of its material off as with that removed") {
  const auto toy = [](const std::string& of_body, const std::string& of_scene) {
    return read(R"({ "pliant": 1, "bodies": [ { "name": "toy", "material": "silicone", "solid": { "spacing": 0.5 },
      "mesh": { "shape": "sphere", "subdivisions": 1 })" +
                of_body + "} ]" + of_scene + "}");
  };
  Scene without = toy(R"(, "disabled_groups": ["toy.volume"])", "");
  Scene removed = toy("", R"(, "events": [ { "step": 0, "remove": "toy.volume" } ])");
  const auto ties = [](const Scene& scene) {
    return scene.simulation.stiffness(scene.simulation.find_group("toy.surface").value());
  };
  CHECK(ties(without) == ties(removed));
  CHECK(after(without, 10) == after(removed, 10));
}

TEST_CASE("groups of another body are not switched off here, and factors of what is off are checked") {
  const auto two = [](const std::string& of_first, const std::string& of_second) {
    const std::string mesh = R"("material": "silk", "mesh": { "shape": "grid", "columns": 3, "rows": 3 })";
    return R"({ "pliant": 1, "bodies": [ { "name": "a", )" + mesh + R"(, "disabled_groups": ["a.bend"])" + of_first +
           R"( }, { "name": "b", )" + mesh + of_second + " } ] }";
  };
  CHECK(message_of(two("", R"(, "disabled_groups": ["a.bend"])"))
            .starts_with("s.json: bodies[1].disabled_groups[0]: 'a.bend' is no group of the body's material"));
  CHECK(message_of(two(R"(, "stiffness_factors": { "a.bend": [1, 1, 1, 1, -1, 1, 1, 1, 1] })", ""))
            .find("at vertex 4 is -1") != std::string::npos);
}

}  // namespace test_disabled
