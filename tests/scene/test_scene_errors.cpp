// Every slip that a scene can have gives one line with the place and the remedy.
#include <string>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant_io/scene/scene.h"
#include "tests/support/temporary_folder.h"

namespace test_scene_errors {

namespace {

using pliant::parse_scene;

/// A scene of one 3 × 3 grid with pins, in which `old_text` is replaced.
std::string scene_with(std::string_view old_text, std::string_view new_text) {
  std::string text = R"({
  "pliant": 1,
  "settings": {"iterations": 3},
  "steps": 5,
  "bodies": [
    {"name": "sheet", "mesh": {"shape": "grid", "columns": 3, "rows": 3}, "mass": {"total": 1},
     "constraints": [{"type": "position", "name": "pins", "on": [0, 2]}, {"type": "edge_spring", "stiffness": 10}]}
  ],
  "forces": [{"type": "wind", "velocity": [1, 2, 3]}, {"type": "test_force", "vertex": 1, "force": [0, 0, 1]}],
  "moves": [{"group": "pins", "step": 2, "offset": [0, 0, 1]}],
  "output": {"every": 2}
})";
  const std::size_t place = text.find(old_text);
  REQUIRE(place != text.npos);
  return text.replace(place, old_text.size(), new_text);
}

std::string message_of(std::string_view text) {
  try {
    parse_scene(text, {}, "s.json");
  } catch (const pliant::Error& error) {
    CHECK(error.kind() == pliant::ErrorKind::input);
    return error.what();
  }
  return "(no error)";
}

struct Slip {
  std::string_view old_text;
  std::string_view new_text;
  std::string_view start;  // of the message
  std::string_view remedy = "";
};

void check(std::span<const Slip> slips) {
  for (const Slip& slip : slips) {
    CAPTURE(slip.new_text);
    const std::string message = message_of(scene_with(slip.old_text, slip.new_text));
    CAPTURE(message);
    CHECK(message.starts_with(slip.start));
    CHECK(message.find(slip.remedy) != message.npos);
    CHECK(message.find('\n') == message.npos);
    CHECK(message.size() < 700);
  }
}

TEST_CASE("the scene that the slips are made in is sound") {
  CHECK(message_of(scene_with("5", "5")) == "(no error)");
}

TEST_CASE("unknown keys name the near ones, and those that are known") {
  constexpr Slip slips[] = {
      {"\"steps\"", "\"stepz\"", "s.json: stepz: unknown key", "did you mean 'steps'? (known: "},
      {"\"iterations\"", "\"iteration\"", "s.json: settings.iteration: unknown key",
       "did you mean 'iterations'? (known: "},
      {"\"columns\"", "\"colums\"", "s.json: bodies[0].mesh.colums: unknown key", "did you mean 'columns'? (known: "},
      {"\"total\"", "\"totl\"", "s.json: bodies[0].mass.totl: unknown key", "did you mean 'total'? (known: "},
      {"\"stiffness\"", "\"stifness\"", "s.json: bodies[0].constraints[1].stifness: unknown key",
       "did you mean 'stiffness'? (known: "},
      {"\"velocity\"", "\"velocty\"", "s.json: forces[0].velocty: unknown key", "did you mean 'velocity'? (known: "},
      {"\"vertex\": 1", "\"vertexes\": [1]", "s.json: forces[1].vertexes: unknown key",
       "did you mean 'vertex' or 'vertices'? (known: "},
      {"\"offset\"", "\"ofset\"", "s.json: moves[0].ofset: unknown key", "did you mean 'offset'? (known: "},
      {"\"every\"", "\"evry\"", "s.json: output.evry: unknown key", "did you mean 'every'? (known: "},
      {"\"steps\"", "\"st\\neps\"", "s.json: st eps: unknown key", "steps"},
  };
  check(slips);
}

TEST_CASE("a wrong type says what is wanted and what was found") {
  constexpr Slip slips[] = {
      {"\"steps\": 5", "\"steps\": \"5\"", "s.json: steps: found a string; give a whole number"},
      {"\"steps\": 5", "\"steps\": 5.5", "s.json: steps: found 5.5; give a whole number, without"},
      {"\"steps\": 5", "\"steps\": 99999999999999999999", "s.json: steps: found "},
      {"\"steps\": 5", "\"steps\": 18446744073709551615", "s.json: steps: found "},
      {"\"steps\": 5", "\"steps\": -5", "s.json: steps: -5 is out of range"},
      {"{\"iterations\": 3}", "[3]", "s.json: settings: found a list; give an object {...}"},
      {"{\"shape\": \"grid\", \"columns\": 3, \"rows\": 3}", "\"shirt.obj\"",
       "s.json: bodies[0].mesh: found 'shirt.obj' alone; write {\"file\": \"shirt.obj\"}"},
      {"{\"shape\": \"grid\", \"columns\": 3, \"rows\": 3}", "\"grid\"",
       "s.json: bodies[0].mesh: found 'grid' alone; write {\"shape\": \"grid\"}"},
      {"\"iterations\": 3", "\"iterations\": null", "s.json: settings.iterations: found "},
      {"\"iterations\": 3", "\"iterations\": 3000000000", "s.json: settings.iterations: 3000000000 is out of range"},
      {"\"iterations\": 3", "\"start\": \"postions\"",
       "s.json: settings.start: unknown choice 'postions'; did you mean 'positions'?",
       "(known: prediction, positions, adaptive)"},
      {"\"iterations\": 3", "\"time_step\": true", "s.json: settings.time_step: found a boolean; give a number"},
      {"\"stiffness\": 10", "\"stiffness\": [1, \"2\"]",
       "s.json: bodies[0].constraints[1].stiffness[1]: found a string; give a number"},
      {"\"stiffness\": 10", "\"stiffness\": []", "s.json: bodies[0].constraints[1].stiffness: the list is empty"},
      {"\"stiffness\": 10", "\"stencils\": []", "s.json: bodies[0].constraints[1].stencils: the list is empty"},
      {"[1, 2, 3]", "[1, 2]", "s.json: forces[0].velocity: the list has 2 entries; give 3 numbers"},
      {"[1, 2, 3]", "[1, [2], 3]", "s.json: forces[0].velocity[1]: found a list; give a number"},
      {"[1, 2, 3]", "{\"x\": 1}", "s.json: forces[0].velocity: found an object; give a list [...]"},
      {"\"on\": [0, 2]", "\"on\": 0",
       "s.json: bodies[0].constraints[0].on: found a number; give \"all\", a list of vertices"},
      {"\"on\": [0, 2]", "\"on\": \"edges\"",
       "s.json: bodies[0].constraints[0].on: unknown selection 'edges'; known: all, "},
      {"\"on\": [0, 2]", "\"on\": {\"box\": 1}",
       "s.json: bodies[0].constraints[0].on.box: found a number; give an object {...}"},
      {"\"name\": \"sheet\"", "\"name\": 7", "s.json: bodies[0].name: found a number; give a text"},
      {"\"bodies\": [", "\"gravity\": 9.81, \"bodies\": [", "s.json: gravity: found a number; give a list [...]"},
      {"\"bodies\": [", "\"bodies\": 3, \"body\": [", "s.json: body: unknown key", "bodies"},
  };
  check(slips);
}

TEST_CASE("an index out of range and a number not finite name the place") {
  constexpr Slip slips[] = {
      {"[0, 2]", "[0, 9]", "s.json: bodies[0].constraints[0].on[1]: vertex 9 is out of range", "vertices 0 to 8"},
      {"[0, 2]", "[-1]", "s.json: bodies[0].constraints[0].on[0]: vertex -1 is out of range"},
      {"\"on\": [0, 2]", "\"stencils\": [0, [99]]",
       "s.json: bodies[0].constraints[0].stencils[1][0]: vertex 99 is out of range"},
      {"\"vertex\": 1", "\"vertex\": 12", "s.json: forces[1].vertex: vertex 12 is out of range"},
      {"\"step\": 2", "\"step\": 2, \"index\": 2", "s.json: moves[0]: index 2 is out of range", "constraints 0 to 1"},
      {"\"stiffness\": 10", "\"stiffness\": 1e999", "s.json: bodies[0].constraints[1].stiffness: 1e999 is beyond"},
      {"[1, 2, 3]", "[1, -1e400, 3]", "s.json: forces[0].velocity[1]: -1e400 is beyond"},
      {"\"stiffness\": 10", "\"stiffness\": NaN", "s.json:7:", "fix the JSON"},
  };
  check(slips);
}

TEST_CASE("what a lower layer refuses gets the place in front") {
  constexpr Slip slips[] = {
      {"\"stiffness\": 10", "\"stiffness\": -1", "s.json: bodies[0].constraints[1].stiffness: -1 is out of range",
       "above 0 [N/m]"},
      {"\"stiffness\": 10", "\"stiffness\": [1, 2]", "s.json: bodies[0].constraints[1]: edge_spring: stiffness has 2"},
      {"\"iterations\": 3", "\"time_step\": 0", "s.json: settings.time_step: 0 is out of range", "above 0 [s]"},
      {"\"iterations\": 3", "\"threads\": -1", "s.json: settings.threads: -1 is out of range", "from 0"},
      {"\"columns\": 3", "\"columns\": 1", "s.json: bodies[0].mesh.columns: 1 is out of range", "from 2"},
      {"\"total\": 1", "\"total\": 0", "s.json: bodies[0].mass: ", "sheet"},
      {"\"total\": 1", "\"each\": [1, 2]", "s.json: bodies[0].mass.each: the list has 2 entries; give 9"},
      {"{\"shape\": \"grid\", \"columns\": 3, \"rows\": 3}", "{\"file\": \"none.obj\"}",
       "s.json: bodies[0].mesh.file: none.obj: no such file"},
      {"{\"shape\": \"grid\", \"columns\": 3, \"rows\": 3}", "{\"file\": \"none.obj\\u0000.ply\"}",
       "s.json: bodies[0].mesh.file: a path cannot have"},
      {"{\"shape\": \"grid\", \"columns\": 3, \"rows\": 3}", "{\"file\": \"\"}",
       "s.json: bodies[0].mesh.file: the path is empty"},
      {"\"force\": [0, 0, 1]", "\"force\": [0, 0, 1], \"frames\": [3, 3]", "s.json: forces[1]: test_force: the frames"},
      {"\"type\": \"edge_spring\", \"stiffness\": 10", "\"type\": \"line\"", "s.json: bodies[0].constraints[1]: line"},
      {"\"offset\": [0, 0, 1]", "\"offset\": [[0, 0, 1]]", "s.json: moves[0]: 1 points for 2 constraints"},
      {"\"step\": 2", "\"step\": -1", "s.json: moves[0].step: -1 is out of range"},
      {"\"step\": 2", "\"step\": 2, \"over\": -1", "s.json: moves[0].over: -1 is out of range"},
      {"\"total\": 1}", "\"total\": 1}, \"transform\": {\"translate\": [0, 0, 1e308]}",
       "s.json: bodies[0].transform.translate[2]: 1e+308 is out of range"},
      {"\"total\": 1}", "\"total\": 1}, \"transform\": {\"scale\": 1e200}", "s.json: bodies[0].transform: ", "vertex"},
      {"\"total\": 1}", "\"total\": 1}, \"transform\": {\"scale\": [1, 1, 1e-200]}", "s.json: bodies[0].transform: "},
      {"\"total\": 1}", "\"total\": 1}, \"velocity\": [0, 1e101, 0]", "s.json: bodies[0].velocity[1]: 1e+101 is out"},
      {"\"pliant\": 1,", "\"pliant\": 1, \"gravity\": [0, 0, -1e308],", "s.json: gravity[2]: -1e+308 is out of range",
       "from -1e+100 to 1e+100"},
      {"\"total\": 1}", "\"total\": 1}, \"start_positions\": [[0, 0, 0]]",
       "s.json: bodies[0].start_positions: the list has 1 entries; give 9"},
  };
  check(slips);
}

TEST_CASE("names must be known where they are used, and new where they are given") {
  constexpr Slip slips[] = {
      {"\"shape\": \"grid\"", "\"shape\": \"gird\"",
       "s.json: bodies[0].mesh.shape: unknown shape 'gird'; did you mean 'grid'?", "did you mean 'grid'? (known: "},
      {"\"type\": \"edge_spring\"", "\"type\": \"edge\"",
       "s.json: bodies[0].constraints[1].type: unknown constraint 'edge'",
       "did you mean 'edge_spring' or 'edge_strain'? (known: "},
      {"\"type\": \"wind\"", "\"type\": \"gravity\"",
       "s.json: forces[0].type: unknown force 'gravity'; known: ", "its own key"},
      {"\"type\": \"wind\"", "\"type\": \"wind\", \"body\": \"shet\"",
       "s.json: forces[0].body: unknown body 'shet'; did you mean 'sheet'?", "sheet"},
      {"\"group\": \"pins\"", "\"group\": \"pin\"", "s.json: moves[0].group: unknown group 'pin'",
       "did you mean 'pins'? (known: "},
      {"\"group\": \"pins\"", "\"group\": \"sheet.edge_spring\"",
       "s.json: moves[0]: the group 'sheet.edge_spring' has no targets"},
      {"\"type\": \"edge_spring\"", "\"type\": \"edge_spring\", \"name\": \"pins\"",
       "s.json: bodies[0].constraints[1].name: the name 'pins' is another group's"},
      {"}\n  ],\n  \"forces\"",
       "}, {\"name\": \"sheet\", \"mesh\": {\"shape\": \"grid\"}, \"mass\": {\"total\": 1}}\n  ],\n  \"forces\"",
       "s.json: bodies[1].name: the name 'sheet' is another body's"},
      {"\"type\": \"edge_spring\"", "\"type\": \"edge_spring\", \"type\": \"line\"",
       "s.json: bodies[0].constraints[1]: the key 'type' stands here twice"},
  };
  check(slips);
}

TEST_CASE("what must be there, and what excludes each other") {
  constexpr Slip slips[] = {
      {"\"pliant\": 1,", "", "s.json: the key 'pliant' is missing"},
      {"\"pliant\": 1,", "\"pliant\": 2,", "s.json: pliant: this program reads scenes of version 1 alone"},
      {"\"mass\": {\"total\": 1},", "", "s.json: bodies[0]: the key 'mass' is missing"},
      {"\"mass\": {\"total\": 1}", "\"mass\": {}",
       "s.json: bodies[0].mass: no key says which it is; give one of the keys each, per_vertex"},
      {"\"mass\": {\"total\": 1}", "\"mass\": {\"total\": 1, \"density\": 2}", "s.json: bodies[0].mass: has both"},
      {"\"type\": \"position\",", "", "s.json: bodies[0].constraints[0]: the key 'type' is missing"},
      {"\"shape\": \"grid\", \"columns\": 3, \"rows\": 3", "",
       "s.json: bodies[0].mesh: no key says which it is; give one of the keys shape"},
      {", \"force\": [0, 0, 1]", "", "s.json: forces[1]: the key 'force' is missing"},
      {"\"step\": 2", "\"step\": 2, \"time\": 1", "s.json: moves[0]: has both 'step' and 'time'"},
      {"\"on\": [0, 2]", "\"on\": [0, 2], \"stencils\": [1]", "s.json: bodies[0].constraints[0].on: 'stencils' says"},
      {"\"every\": 2", "\"every\": 0", "s.json: output.every: 0 is out of range"},
      {"\"on\": [0, 2]", "\"on\": {\"box\": {\"min\": [5, 5, 5], \"max\": [6, 6, 6]}}",
       "s.json: bodies[0].constraints[0].on: no vertex is selected; the body spans (0, 0, 0) to (1, 0, 1)"},
      {"\"stiffness\": 10", "\"on\": [0, 8]", "s.json: bodies[0].constraints[1]: makes no constraint"},
  };
  check(slips);
  CHECK(message_of(R"({"pliant": 1, "bodies": []})").starts_with("s.json: bodies: there is no body"));
  CHECK(message_of(R"([1])").starts_with("s.json: found a list; give an object {...}"));
}

TEST_CASE("a slip of syntax names line and column") {
  CHECK(message_of("").starts_with("s.json:1:1: "));
  CHECK(message_of("{\n  \"pliant\": 1,\n  \"steps\" 5\n}").starts_with("s.json:3:11: "));
  CHECK(message_of("{\"pliant\": 1} x").starts_with("s.json:1:15: "));
  CHECK(message_of("{\"pliant\": \"\xff\"}").starts_with("s.json:1:"));
  const std::string long_word = "{\"" + std::string(100000, 'a');
  CHECK(message_of(long_word).size() < 300);
}

TEST_CASE("deep nesting is refused, not a crash") {
  const std::string message = message_of("{\"pliant\": " + std::string(1000000, '['));
  CHECK(message.find("more than 64 levels") != message.npos);
}

TEST_CASE("a scene file that is not there, and one in a folder of its own") {
  CHECK_THROWS_WITH_AS(pliant::load_scene("/none/such.json"), doctest::Contains("no such file"), pliant::Error);
  const pliant_tests::TemporaryFolder folder;
  folder.write("tent.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto file =
      folder.write("tent.json", R"({"pliant": 1, "bodies": [{"mesh": {"file": "tent.obj"}, "mass": {"total": 1}}]})");
  const pliant::Scene scene = pliant::load_scene(file);
  CHECK(scene.name == "tent");
  CHECK(scene.simulation.state().vertex_count() == 3);
}

}  // namespace

}  // namespace test_scene_errors
