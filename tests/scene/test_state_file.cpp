// A simulation that a program makes by itself goes on from a saved state with the bits of one that did not stop; so
// does a scene to which a program had added something.
#include <functional>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "pliant/pliant.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/checkpoint/state_file.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "tests/support/temporary_folder.h"

namespace test_state_file {

using namespace pliant;

namespace {

struct Made {
  Simulation simulation;
  GroupId pins, springs;
  ColliderId ball;
};

/// A sheet with a rope beside it that falls onto a moving ball.
Made make(Index columns = 9, std::string_view springs = "springs") {
  SolverSettings settings;
  settings.integrator = Integrator::bdf2;
  settings.acceleration = Acceleration::lbfgs;
  settings.threads = 1;
  Made made{Simulation(settings), {}, {}, {}};
  Simulation& simulation = made.simulation;
  const BodyId sheet = simulation.add_body(grid({.columns = columns, .rows = 9, .plane = Plane::xy}),
                                           Mass::area_density(0.3), {.name = "sheet"});
  const BodyId rope = simulation.add_body(chain({.links = 4}), Mass::per_vertex(0.1), {.name = "rope"});
  made.springs = simulation.add(sheet, EdgeSpring{.stiffness = 500}, std::string(springs));
  simulation.add(rope, EdgeSpring{.stiffness = 900});
  made.pins = simulation.add(rope, Position{.on = {0}});
  simulation.add(Gravity{});
  made.ball = simulation.add(SphereCollider{.center = {0.5, 0.5, -0.21}, .radius = 0.2, .friction = 0.4});
  simulation.set_contact({.distance = 0.01, .friction = 0.3});
  return made;
}

/// What may happen to a simulation, and is in its state.
void go_on(Made& made) {
  made.simulation.set_target(made.pins, 0, {0, 0.1, 0.2});
  made.simulation.set_stiffness(made.springs, 800);
  made.simulation.set_target(made.ball, {.position = {0.5, 0.45, -0.2}});
  for (int i = 0; i < 15; ++i) made.simulation.step();
}

bool are_alike(const Simulation& a, const Simulation& b) {
  return a.state().positions == b.state().positions && a.state().velocities == b.state().velocities &&
         a.state().step == b.state().step && a.state().time == b.state().time;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("state file: the steps that follow have the same bits") {
  const pliant_tests::TemporaryFolder folder;
  Made made = make();
  go_on(made);
  REQUIRE(!made.simulation.contacts().empty());
  write_state(folder.path() / "half.state", made.simulation);
  Made again = make();
  SUBCASE("on a simulation that was just made") {}
  SUBCASE("on one that has taken other steps") {
    for (int i = 0; i < 7; ++i) again.simulation.step();
  }
  restore_state(folder.path() / "half.state", again.simulation);
  REQUIRE(are_alike(again.simulation, made.simulation));
  CHECK(again.simulation.stiffness(again.springs) == 800);
  CHECK(again.simulation.target(again.pins, 0) == Vec3(0, 0.1, 0.2));
  for (int i = 0; i < 15; ++i) {
    made.simulation.step();
    again.simulation.step();
  }
  CHECK(are_alike(again.simulation, made.simulation));
}

TEST_CASE("state file: pins that came while it ran stay out of the factor of another run") {
  for (const Hold hold : {Hold::hard, Hold::soft}) {
    Made made = make(), again = make();
    for (int i = 0; i < 4; ++i) made.simulation.step();
    for (Made* each : {&made, &again}) each->simulation.add(BodyId{0}, Position{.on = {40}, .hold = hold}, "late");
    for (int i = 0; i < 4; ++i) made.simulation.step();
    restore_state(state_bytes(made.simulation), "state", again.simulation);
    for (int i = 0; i < 8; ++i) {
      made.simulation.step();
      again.simulation.step();
    }
    CHECK(are_alike(again.simulation, made.simulation));
    for (Made* each : {&made, &again}) each->simulation.remove(each->simulation.find_group("late").value());
    CHECK(made.simulation.step().set_up.numeric == 0);
    CHECK(again.simulation.step().set_up.numeric == 0);
  }
}

TEST_CASE("state file: the start is restored whatever has happened since") {
  Made made = make();
  made.simulation.set_contact({.distance = 0.01, .friction = 0.3, .surfaces = true});
  const std::string start = state_bytes(made.simulation);
  for (int i = 0; i < 8; ++i) made.simulation.step();
  Made fresh = make();
  fresh.simulation.set_contact({.distance = 0.01, .friction = 0.3, .surfaces = true});
  restore_state(start, "start", made.simulation);
  for (int i = 0; i < 8; ++i) {
    made.simulation.step();
    fresh.simulation.step();
  }
  CHECK(are_alike(made.simulation, fresh.simulation));
}

TEST_CASE("state file: the start of one without contact, with energy projection and automatic iterations") {
  const auto bare = [] {
    Simulation simulation(
        {.integrator = Integrator::bdf2, .iterations = automatic_iterations, .energy_projection = 1, .threads = 1});
    const BodyId sheet = simulation.add_body(grid({.columns = 9, .rows = 9}), Mass::area_density(0.3));
    simulation.add(sheet, EdgeSpring{.stiffness = 500});
    simulation.add(sheet, Position{.on = {0, 8}});
    simulation.add(Gravity{});
    return simulation;
  };
  Simulation moved = bare();
  const std::string start = state_bytes(moved);
  for (int i = 0; i < 12; ++i) moved.step();
  restore_state(start, "start", moved);
  CHECK(moved.state().previous_time_step == 0);
  CHECK(moved.state().iterations == 0);
  CHECK(moved.state().energy_surplus.empty());
  Simulation fresh = bare();
  for (int i = 0; i < 12; ++i) {
    moved.step();
    fresh.step();
  }
  CHECK(are_alike(moved, fresh));
  SolverSettings settings = moved.settings();
  settings.energy_projection = 0;  // which knows no colliders
  moved.set_settings(settings);
  moved.add(SphereCollider{.center = {0, 5, 0}, .radius = 0.1});
  CHECK(refusal([&] { restore_state(start, "start", moved); }).find("its colliders are others") != std::string::npos);
}

TEST_CASE("state file: what does not fit is refused, and changes nothing") {
  Made made = make();
  go_on(made);
  const std::string bytes = state_bytes(made.simulation);
  const auto refused = [&](std::string_view given, Made other) {
    other.simulation.step();
    const Positions before = other.simulation.state().positions;
    const std::string message = refusal([&] { restore_state(given, "half", other.simulation); });
    CHECK(other.simulation.state().positions == before);
    CHECK(other.simulation.stiffness(other.springs) == 500);
    return message;
  };
  CHECK(refused(bytes, make(8)) ==
        "half: bodies[0]: 'sheet' with 81 vertices, where the simulation has 'sheet' with 72; "
        "make it as the program did before");
  CHECK(refused(bytes, make(9, "threads")).find("the simulation has the group 'threads' here") != std::string::npos);
  CHECK(refused(bytes.substr(0, bytes.size() / 2), make()).find("cut") != std::string::npos);
  std::string spoilt = bytes;
  spoilt[bytes.size() / 2] ^= 1;
  CHECK(refused(spoilt, make()).find("damaged") != std::string::npos);
  CHECK(refused("PLIANT", make()).find("simulate from the start") != std::string::npos);
  Made heavier = make();
  heavier.simulation.add_body(chain({.links = 1}), Mass::per_vertex(1));
  CHECK(refused(bytes, std::move(heavier)).find("2 bodies, where the simulation has 3") != std::string::npos);
  Made without_ball = make();
  without_ball.simulation.remove(without_ball.ball);
  CHECK(!refused(bytes, std::move(without_ball)).empty());
  Made with_more = make();
  with_more.simulation.add(BodyId{1}, Line{.on = {2}, .direction = Vec3(1, 0, 0)});
  CHECK(refused(bytes, std::move(with_more)).find("3 groups of constraints, where the simulation has 4") !=
        std::string::npos);
}

TEST_CASE("state file: a checkpoint of a scene is not taken for one, nor the other way round") {
  Scene scene = parse_scene(builtin_scenes().front().text, {}, "scene");
  const std::string checkpoint = checkpoint_bytes(scene, {});
  CHECK(refusal([&] { restore_state(checkpoint, "x", scene.simulation); }).find("a checkpoint of a scene") !=
        std::string::npos);
  const std::string state = state_bytes(scene.simulation);
  CHECK(refusal([&] { parse_checkpoint(state, "x"); }).find("without a scene") != std::string::npos);
}

TEST_CASE("state file: a scene to which a program has added constraints") {
  constexpr std::string_view text = R"({"pliant": 1, "steps": 40, "bodies": [
    {"name": "cloth", "mesh": {"shape": "grid"}, "mass": {"total": 1},
     "constraints": [{"type": "edge_spring"}, {"type": "position", "name": "pins", "on": "corners"}]}],
    "events": [{"step": 5, "add": {"body": "cloth", "type": "line", "name": "rail", "on": [40], "direction": [1, 0, 0]}}]
  })";
  const auto prepare = [](Scene& scene) { scene.simulation.add(BodyId{0}, EdgeSpring{.stiffness = 30}, "own"); };
  Scene scene = parse_scene(text, {}, "scene");
  prepare(scene);
  for (int i = 0; i < 10; ++i) scene.step();
  const std::string bytes = checkpoint_bytes(scene, {});
  CHECK(refusal([&] { parse_checkpoint(bytes, "x"); }).find("add again what the program had added") !=
        std::string::npos);
  Scene again = open_checkpoint(bytes, "x");
  prepare(again);
  restore_checkpoint(again, bytes, "x");
  for (int i = 0; i < 10; ++i) {
    scene.step();
    again.step();
  }
  CHECK(are_alike(again.simulation, scene.simulation));
}

}  // namespace test_state_file
