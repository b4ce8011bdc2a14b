// Surfaces that cross at the start, lie nearer than their distance or are driven through each other by pins: what
// crosses is named and let go until it is apart, and then touches as anything does.
#include <algorithm>
#include <limits>

#include <doctest/doctest.h>

#include "tests/pairs/crossed_scenes.h"
#include "tests/pairs/parts.h"
#include "tests/scene/whole_scenes.h"

namespace test_let_go {

using namespace pliant;
using namespace pliant_tests;

namespace {

Positions positions_of(const Simulation& simulation, std::size_t body) {
  const Body& it = simulation.bodies()[body];
  return simulation.state().positions.middleRows(it.first_vertex, it.mesh.vertex_count());
}

Real fastest(const Simulation& simulation) {
  return simulation.state().velocities.rowwise().norm().maxCoeff();
}

bool is_named(const Simulation& simulation, std::string_view begin) {
  return std::ranges::any_of(simulation.warnings(), [&](const std::string& each) { return each.starts_with(begin); });
}

/// Takes steps, in each of which all that crosses must have been let go and the report must count it. Returns the first
/// after which nothing crosses any more, and from which on nothing does; `steps` if there is none.
Index steps_until_apart(PairScene& scene, Index steps) {
  Index apart = 0;
  for (Index i = 0; i < steps; ++i) {
    const ContactReport contact = scene.step().contact;
    const std::int64_t crossings = count_crossings(scene.simulation);
    REQUIRE(count_unknown_crossings(scene.simulation) == 0);
    REQUIRE(contact.let_go >= crossings);
    REQUIRE(scene.simulation.state().positions.allFinite());
    if (crossings > 0) apart = i + 1;
  }
  return apart;
}

struct Trial {
  const char* name;
  PairScene (*make)(const PairOptions&);
  Index frames;
  bool comes_apart;
};
constexpr std::array trials{
    Trial{"sheets", [](const PairOptions& options) { return crossed_sheets(options, 1); }, 30, true},
    Trial{"pulled", [](const PairOptions& options) { return pulled_apart(options, 1); }, 40, true},
    Trial{"rope", rope_through_sheet, 35, true},
    Trial{"loop", crossed_loop, 40, false},
    Trial{"pile", crossed_pile, 24, false},
    Trial{"closing", [](const PairOptions& options) { return closing_sheets(options, 0.6); }, 120, true},
    Trial{"driven", driven_through, 70, true}};

/// How long the free sheet between closing plates stays crumpled in long steps is a matter of chance.
void check_trials(const PairOptions& options, Real share_of_frames = 1) {
  for (const Trial& trial : trials) {
    CAPTURE(std::string(trial.name));
    PairScene scene = trial.make(options);
    const auto frames = static_cast<Index>(share_of_frames * static_cast<Real>(trial.frames));
    const Index apart = steps_until_apart(scene, runs_whole_scenes ? frames : 2);
    const bool is_by_chance = share_of_frames < 1 && std::string_view(trial.name) == "closing";
    if (runs_whole_scenes && trial.comes_apart && !is_by_chance) CHECK(apart < frames);
  }
}

}  // namespace

TEST_CASE("let go: all that crosses in any frame was let go") {
  check_trials({});
}

TEST_CASE("let go: all that crosses was let go, with one iteration, BDF2, substeps and long steps") {
  check_trials({.settings = {.iterations = 1, .threads = 1}});
  check_trials({.settings = {.integrator = Integrator::bdf2, .threads = 1}});
  check_trials({.settings = {.substeps = 3, .threads = 1}});
  check_trials({.settings = {.time_step = 1.0 / 20, .threads = 1}}, 0.7);
}

TEST_CASE("let go: piles that cross by chance") {
  for (const std::uint64_t seed : {2U, 4U}) {
    CAPTURE(seed);
    PairScene scene = crossed_pile({.seed = seed});
    CHECK(count_crossings(scene.simulation) > 0);
    steps_until_apart(scene, runs_whole_scenes ? 25 : 2);
    CHECK(fastest(scene.simulation) < 10);
  }
}

TEST_CASE("let go: a sheet that starts through another leaves it as if it were not there, and then touches it") {
  PairScene scene = crossed_sheets({}, 1);
  const std::int64_t crossings = count_crossings(scene.simulation);
  REQUIRE(crossings > 0);
  const StepReport first = scene.step();
  CHECK(first.contact.let_go == crossings);
  REQUIRE(first.contact.let_go_bodies.size() == 1);
  const LetGoBodies& named = first.contact.let_go_bodies[0];
  CHECK(named.bodies == std::array<Index, 2>{0, 1});
  CHECK_FALSE(named.is_held_up);
  CHECK(std::abs(named.place.z()) < 0.05);
  CHECK(is_named(scene.simulation, "'body 0' crosses 'body 1': edge "));
  CHECK(scene.step().contact.let_go_bodies.empty());
  if (!runs_whole_scenes) return;
  CHECK(steps_until_apart(scene, 30) < 28);
  CHECK(scene.simulation.state().contact.let_go.pairs.empty());
  CHECK(positions_of(scene.simulation, 1).col(2).minCoeff() > positions_of(scene.simulation, 0).col(2).maxCoeff());
  CHECK(fastest(scene.simulation) < 1 + 1e-9);
  // Thrown back it is stopped.
  Positions velocities = scene.simulation.state().velocities;
  velocities.bottomRows(81).col(2).array() = -2;
  scene.simulation.set_state(scene.simulation.state().positions, velocities);
  Index active = 0;
  for (int i = 0; i < 30; ++i) {
    active = std::max(active, scene.step().contact.active);
    REQUIRE(count_crossings(scene.simulation) == 0);
  }
  CHECK(active > 0);
  CHECK(is_named(scene.simulation, "'body 0' crosses 'body 1': edge "));
}

TEST_CASE("let go: sheets that start crossed part in one step if they are that fast") {
  PairScene scene = crossed_sheets({}, 25);
  const StepReport report = scene.step();
  CHECK(count_crossings(scene.simulation) == 0);
  CHECK(report.contact.let_go == 0);
  CHECK(report.contact.let_go_bodies.size() == 1);
}

TEST_CASE("let go: nothing where nothing crosses") {
  PairScene scene = near_sheets({}, 1.5, true);
  const StepReport report = scene.step();
  CHECK(report.contact.let_go == 0);
  CHECK(report.contact.let_go_bodies.empty());
  const LetGoState& let_go = scene.simulation.state().contact.let_go;
  CHECK(let_go.is_known);
  CHECK(let_go.pairs.empty());
  CHECK(let_go.reduced.empty());
  CHECK(let_go.held_up.empty());
}

TEST_CASE("let go: not what ignores the other, nor a body that need not touch itself") {
  PairScene scene = crossed_sheets({}, 1);
  scene.simulation.set_contact(BodyId{1}, {.ignores = {BodyId{0}}});
  CHECK(scene.step().contact.let_go == 0);
  // From here on they are to touch, so it is looked for again.
  scene.simulation.set_contact(BodyId{1}, {});
  CHECK(scene.step().contact.let_go == count_crossings(scene.simulation));
  CHECK(count_unknown_crossings(scene.simulation) == 0);
  PairScene loop = crossed_loop({});
  loop.simulation.set_contact(BodyId{0}, {.self = false});
  CHECK(loop.step().contact.let_go == 0);
}

TEST_CASE("let go: what a body crosses that is added in the middle") {
  PairScene scene = crossed_sheets({}, 1);
  for (int i = 0; i < 3; ++i) scene.step();
  Mesh mesh = sheet_mesh(5, 0.3, Vec3(0.1, 0.1, -0.12), Plane::xz);
  add_cloth(scene.simulation, mesh);
  const StepReport report = scene.step();
  REQUIRE(report.contact.let_go_bodies.size() == 1);
  CHECK(report.contact.let_go_bodies[0].bodies == std::array<Index, 2>{0, 2});
  CHECK(count_unknown_crossings(scene.simulation) == 0);
}

TEST_CASE("reduced distances: two sheets that start at a tenth of the distance leave each other slowly") {
  PairScene scene = near_sheets({}, 0.1, false);
  const Real distance = scene.simulation.contact_distance(BodyId{0});
  CHECK(count_crossings(scene.simulation) == 0);
  Real fastest_of_all = 0;
  for (int i = 0; i < (runs_whole_scenes ? 90 : 2); ++i) {
    const StepReport report = scene.step();
    CHECK(report.contact.let_go == 0);
    fastest_of_all = std::max(fastest_of_all, fastest(scene.simulation));
  }
  CHECK(fastest_of_all < 2 * distance);  // in a second
  if (!runs_whole_scenes) return;
  CHECK(scene.simulation.state().contact.let_go.reduced.empty());
  const auto height = [&](std::size_t body) { return positions_of(scene.simulation, body).col(2).mean(); };
  CHECK(height(1) - height(0) > 0.99 * scene.simulation.contact_distance(BodyId{1}));
}

TEST_CASE("reduced distances: a sheet that starts too near to one that it lies on ends at the distance") {
  for (const Real share : {0.1, 1e-4}) {
    CAPTURE(share);
    PairScene scene = near_sheets({}, share, true);
    const Real distance =
        (scene.simulation.contact_distance(BodyId{0}) + scene.simulation.contact_distance(BodyId{1})) / 2;
    ContactReport contact;
    for (int i = 0; i < (runs_whole_scenes ? 90 : 2); ++i) {
      contact = scene.step().contact;
      CHECK(fastest(scene.simulation) < 2 * distance);
      REQUIRE(count_crossings(scene.simulation) == 0);
    }
    if (!runs_whole_scenes) continue;
    CHECK(contact.smallest_gap > 0.98 * distance);
    CHECK(contact.smallest_gap < distance);
    CHECK(fastest(scene.simulation) < 1e-5);
  }
}

TEST_CASE("held up: what is squeezed between pinned surfaces is let go after a while, and they reach their ends") {
  PairScene scene = closing_sheets({}, 0.6);
  bool is_any_held_up = false;
  Real lag = 0;
  for (int i = 0; i < (runs_whole_scenes ? 60 : 2); ++i) {
    const ContactReport contact = scene.step().contact;
    for (const LetGoBodies& each : contact.let_go_bodies) is_any_held_up |= each.is_held_up;
    lag = contact.lag;
  }
  if (!runs_whole_scenes) return;
  CHECK(is_any_held_up);
  CHECK(is_named(scene.simulation, "'body 0' crosses 'body 1': "));
  CHECK(is_named(scene.simulation, "'body 0', which is pinned, was held up for long by 'body 2': vertex "));
  CHECK(lag == 0);
  CHECK(positions_of(scene.simulation, 0).col(2).minCoeff() > 0.149);
  CHECK(positions_of(scene.simulation, 1).col(2).maxCoeff() < -0.149);
}

TEST_CASE("let go: the same bits for any number of threads") {
  for (const Trial& trial : trials) {
    CAPTURE(std::string(trial.name));
    Positions expected;
    for (const Index threads : {1, 2, 3, 8}) {
      CAPTURE(threads);
      PairScene scene = trial.make({.settings = {.threads = threads}});
      for (Index i = 0; i < (runs_whole_scenes ? 20 : 2); ++i) scene.step();
      if (threads == 1) expected = scene.simulation.state().positions;
      CHECK(scene.simulation.state().positions == expected);
    }
  }
}

TEST_CASE("let go: the same bits after a state is restored in the middle, and after a step that is taken back") {
  for (const Trial& trial : trials) {
    CAPTURE(std::string(trial.name));
    for (const Index substeps : {1, 2}) {
      const PairOptions options{.settings = {.substeps = substeps, .threads = 1}};
      PairScene scene = trial.make(options);
      for (Index i = 0; i < (runs_whole_scenes ? trial.frames / 2 : 2); ++i) scene.step();
      const State middle = scene.simulation.state();
      PairScene resumed = trial.make(options);
      resumed.simulation.restore(middle);
      Index calls = 0;
      resumed.simulation.set_stop([&] { return ++calls > 1; });
      CHECK_THROWS_AS(resumed.step(), Error);
      CHECK(resumed.simulation.state().contact.let_go.pairs == middle.contact.let_go.pairs);
      resumed.simulation.set_stop(nullptr);
      for (int i = 0; i < 6; ++i) {
        scene.step();
        resumed.step();
      }
      const State& a = scene.simulation.state();
      const State& b = resumed.simulation.state();
      CHECK(a.positions == b.positions);
      CHECK(a.velocities == b.velocities);
      CHECK(a.contact.let_go.pairs == b.contact.let_go.pairs);
      CHECK(a.contact.let_go.reduced == b.contact.let_go.reduced);
      CHECK(a.contact.let_go.held_up == b.contact.let_go.held_up);
    }
  }
}

TEST_CASE("let go: a state that no simulation has left is refused") {
  PairScene scene = crossed_sheets({}, 1);
  scene.step();
  const auto refusal = [&](const auto& spoil) -> std::string {
    State state = scene.simulation.state();
    spoil(state.contact.let_go);
    try {
      scene.simulation.restore(state);
    } catch (const Error& error) {
      return error.what();
    }
    return "(taken)";
  };
  CHECK(refusal([](LetGoState&) {}) == "(taken)");
  CHECK(refusal([](LetGoState& each) { each.pairs[0].vertices = {-1, 3}; }).find("vertex") != std::string::npos);
  CHECK(refusal([](LetGoState& each) { each.pairs.back().vertices = {5, 162}; }).find("order") != std::string::npos);
  CHECK(refusal([](LetGoState& each) { each.pairs.push_back({{161, 162}}); }).find("vertex") != std::string::npos);
  CHECK(refusal([](LetGoState& each) { each.reduced = {{3, 2, 0.5}}; }).find("body") != std::string::npos);
  CHECK(refusal([](LetGoState& each) { each.reduced = {{3, 1, 1}}; }).find("share") != std::string::npos);
  CHECK(refusal([](LetGoState& each) {
          each.reduced = {{3, 1, 0.5}, {2, 1, 0.5}};
        }).find("order") != std::string::npos);
  CHECK(refusal([](LetGoState& each) { each.held_up = {{200, 1}}; }).find("held up") != std::string::npos);
  CHECK(refusal([](LetGoState& each) { each.held_up = {{2, 0}}; }).find("held up") != std::string::npos);
}

}  // namespace test_let_go
