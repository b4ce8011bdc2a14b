// "PATH=VALUE" takes the place of any value of a scene, and says of itself when it is wrong.
#include <string>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant_io/scene/scene.h"

namespace test_overrides {

namespace {

using namespace pliant;

constexpr std::string_view text = R"({
  "pliant": 1,
  "bodies": [
    {"name": "sheet", "mesh": {"shape": "grid", "columns": 3, "rows": 3}, "mass": {"total": 1},
     "constraints": [{"type": "position", "name": "pins", "on": [0, 2]},
                     {"type": "edge_spring", "stiffness": [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16]},
                     {"type": "hinge", "name": "bend", "stiffness": 0.5}]},
    {"name": "3", "mesh": {"vertices": [[0, 0, 0], [1, 0, 0]], "edges": [[0, 1]]}, "mass": {"each": [1, 2]}}
  ],
  "forces": [{"type": "wind", "velocity": [1, 2, 3]}, {"type": "wind", "body": "sheet"}],
  "moves": [{"group": "pins", "time": 2, "over": 1, "offset": [0, 0, 1]}]
})";

Scene with(std::vector<std::string> set) {
  return parse_scene(text, {}, "s.json", {.set = std::move(set)});
}

std::string message_of(const std::string& set) {
  try {
    with({set});
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    CHECK(std::string_view(error.what()).find('\n') == std::string_view::npos);
    return error.what();
  }
  return "(no error)";
}

Real stiffness(const Scene& scene, const std::string& name) {
  for (const auto& [id, group] : scene.simulation.groups()) {
    if (group.name == name) return group.set.batches[0]->stiffness();
  }
  return 0;
}

TEST_CASE("values are set by path") {
  CHECK(with({"settings.time_step=0.25"}).simulation.settings().time_step == 0.25);
  CHECK(with({"settings.backend=eigen"}).simulation.settings().backend == Backend::eigen);
  CHECK(with({"steps=7"}).steps == 7);
  CHECK(with({"name=a = b"}).name == "a = b");
  CHECK(with({"name=\"quoted\""}).name == "quoted");
  CHECK(with({"name="}).name.empty());
  CHECK(with({"output.format=none", "output.every=3"}).output.every == 3);
  CHECK(stiffness(with({"bodies[0].constraints[2].stiffness=2"}), "bend") == 2);
  CHECK(stiffness(with({"bodies[sheet].constraints[bend].stiffness=2"}), "bend") == 2);
  CHECK(stiffness(with({"bodies[sheet].constraints[hinge].stiffness=2"}), "bend") == 2);
  CHECK(stiffness(with({"bodies[0].constraints[edge_spring].stiffness=7"}), "sheet.edge_spring") == 7);
  CHECK(with({"bodies[1].mass.each[1]=5"}).simulation.state().masses.back() == 5);
  CHECK(with({"bodies[1].mesh.vertices[1][0]=5"}).simulation.state().positions(10, 0) == 5);
  CHECK(with({"bodies[1].velocity=[0,0,4]"}).simulation.state().velocities(10, 2) == 4);
  CHECK(with({"bodies[sheet].transform.translate=[0,0,4]"}).simulation.state().positions(0, 2) == 4);
  CHECK(with({"forces=[]", "gravity=null"}).simulation.forces().empty());
  CHECK(with({"forces[0]={\"type\":\"test_force\",\"body\":\"sheet\",\"vertex\":0,\"force\":[0,0,1]}"})
            .simulation.forces()
            .size() == 3);
}

TEST_CASE("of two values for one place the later counts, also where one is inside the other") {
  CHECK(with({"steps=7", "steps=8"}).steps == 8);
  CHECK(with({"bodies[1].mass={\"total\":6}", "bodies[1].mass.total=8"}).simulation.state().masses.back() == 4);
  CHECK(with({"bodies[1].mass.each[0]=9", "bodies[1].mass={\"total\":6}"}).simulation.state().masses.back() == 3);
  const Scene scene = parse_scene(text, {}, "s.json", {.steps = 3, .set = {"steps=7"}});
  CHECK(scene.steps == 3);
}

TEST_CASE("a wrong value names the option that it comes from") {
  CHECK(message_of("settings.time_step=-1") ==
        "--set settings.time_step=-1: -1 is out of range; give a finite number above 0 [s]");
  CHECK(message_of("settings.iteratons=5")
            .starts_with("--set settings.iteratons=5: unknown key; did you mean "
                         "'iterations'? (known: "));
  CHECK(message_of("setings.iterations=5").starts_with("--set setings.iterations=5: unknown key"));
  CHECK(message_of("bodies[0].mass={\"totl\":1}").starts_with("--set bodies[0].mass={\"totl\":1}: totl: unknown key"));
  CHECK(message_of("bodies[0].mass.density=1").starts_with("s.json: bodies[0].mass: has both"));
  CHECK(message_of("steps=many") == "--set steps=many: found a string; give a whole number");
  CHECK(message_of("steps=1e999").find("beyond the range") != std::string::npos);
  CHECK(message_of("settings.time_step=1e999").find("beyond the range") != std::string::npos);
  CHECK(message_of("forces[0].velocity=[1,2").starts_with("--set forces[0].velocity=[1,2:1:5: "));
  CHECK(message_of("forces[0].velocity=[1,2]").starts_with("--set forces[0].velocity=[1,2]: the list has 2 entries"));
  CHECK(message_of("forces[0].velocity[1]=x").starts_with("--set forces[0].velocity[1]=x: found "));
  CHECK(message_of("bodies[0].mesh.columns=1").starts_with("--set bodies[0].mesh.columns=1: 1 is out of range"));
  CHECK(message_of("name=" + std::string(100000, 'x') + "\x1b[31m").find("(no error)") != std::string::npos);
  CHECK(message_of("steps=" + std::string(100000, 'x') + "\x1b[31m").size() < 400);
  CHECK(message_of("steps=\x1b[31m").find('\x1b') == std::string::npos);
}

TEST_CASE("a path that leads nowhere says how far it leads") {
  CHECK(message_of("steps") == "--set steps: there is no '='; write PATH=VALUE, such as settings.iterations=20");
  for (const std::string path : {"", ".", "a..b", "a.", ".a", "[0]", "a[", "a[]", "a[0", "a[0]b", "a[0]..b"}) {
    CAPTURE(path);
    CHECK(message_of(path + "=1").find("is not a path") != std::string::npos);
  }
  CHECK(message_of("bodies[2].name=x") == "--set bodies[2].name=x: [2] is out of range; the list has entries 0 to 1");
  CHECK(message_of("bodies[-1].name=x").find("no entry is called '-1'") != std::string::npos);
  CHECK(message_of("bodies[shet].name=x").find("no entry is called 'shet'; did you mean 'sheet'? (known: ") !=
        std::string::npos);
  CHECK(message_of("forces[wind].drag=1").find("[0] and [1] both have the type 'wind'; give an index") !=
        std::string::npos);
  CHECK(message_of("events[0].time=1").find("events") != std::string::npos);
  CHECK(message_of("bodies[0].mass.total.x=1").find("'total' is not an object") != std::string::npos);
  CHECK(message_of("bodies[0].name[0]=1").find("'name' is not a list") != std::string::npos);
  CHECK(message_of("gravity[2]=1").find("'gravity'") != std::string::npos);
  CHECK(message_of("bodies.x=1").find("bodies") != std::string::npos);
  CHECK(message_of("include=other.json").find("cannot be set") != std::string::npos);
  std::string deep = "a";
  for (int i = 0; i < 100000; ++i) deep += ".a";
  CHECK(message_of(deep + "=1").size() < 600);
}

TEST_CASE("a scene can be read again from its source") {
  const Scene first = with({"settings.time_step=0.25", "bodies[sheet].constraints[bend].stiffness=2"});
  const Scene again = parse_scene(first.source);
  CHECK(again.simulation.settings().time_step == 0.25);
  CHECK(stiffness(again, "bend") == 2);
  CHECK(again.source.texts.size() == 1);
}

}  // namespace

}  // namespace test_overrides
