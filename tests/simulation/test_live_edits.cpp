// Every kind of edit while a curtain runs, by a call and by a timed event: the steps after it are those of a fresh
// simulation that was made as the edit leaves it and starts in the same state, and nothing jumps.
#include <functional>
#include <numbers>

#include <doctest/doctest.h>

#include "pliant/constraints/builtin.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/shapes.h"
#include "pliant/timeline/timeline.h"
#include "run.h"

namespace test_live_edits {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// All that the edits change, with the values it begins with.
struct Make {
  // In single precision pins that come, which stand beside the factor, would be solved with otherwise rounded.
  SolverSettings settings{.iterations = 8, .precision = Precision::double_, .threads = 1};
  Values springs = 500;
  std::optional<TriangleStrain> skin = TriangleStrain{.stiffness = 40, .min_stretch = 0.9, .max_stretch = 1.02};
  Position pins{.on = {56, 63}};
  std::vector<Vec3> pin_targets = {{0, 0, 1}, {1, 0, 1}};
  std::optional<Drag> drag = std::nullopt;
  Vec3 gravity{0, 0, -9.81};
  std::optional<Wind> wind = Wind{.velocity = {0, 2, 0}};
};

constexpr BodyId curtain{0};
constexpr BodyId leader{1};

Simulation make(const Make& options) {
  Simulation simulation(options.settings);
  simulation.add_body(grid({.columns = 8, .rows = 8}), Mass::area_density(0.3));
  const Positions leader_velocities = Vec3(0.1, 0, 0.2).transpose().replicate(4, 1);
  simulation.add_body(grid({.columns = 2, .rows = 2}), Mass::total(1), {.velocities = leader_velocities});
  simulation.add(leader, EdgeSpring{.stiffness = 100}, "leader");
  simulation.add(curtain, EdgeSpring{.stiffness = options.springs}, "springs");
  if (options.skin) simulation.add(curtain, *options.skin, "skin");
  if (!options.pin_targets.empty()) {
    Position pins = options.pins;
    pins.targets = options.pin_targets;
    simulation.add(curtain, pins, "pins");
  }
  if (options.drag) simulation.add(curtain, *options.drag, "drag");
  add_gravity(simulation, options.gravity);
  if (options.wind) simulation.add(curtain, *options.wind);
  return simulation;
}

GroupId id(const Simulation& simulation, std::string_view name) {
  return simulation.find_group(name).value();
}

void compare(Simulation& edited, Timeline& timeline, Simulation& fresh, Real largest_move,
             const std::function<void(Simulation& fresh, Real elapsed)>& each_step) {
  for (int step = 0; step < 12; ++step) {
    // No farther than the velocity and a few dozen g take it within the step.
    const State& state = edited.state();
    const Positions straight_on = state.positions + fresh.settings().time_step * state.velocities;
    const Real begin = fresh.state().time;
    if (each_step) each_step(fresh, begin + fresh.settings().time_step);
    timeline.step(edited);
    fresh.step();
    CHECK(largest_difference(edited.state().positions, fresh.state().positions) < 1e-9);
    CHECK(largest_difference(edited.state().velocities, fresh.state().velocities) < 1e-7);
    if (step == 0) CHECK(largest_difference(edited.state().positions, straight_on) < largest_move);
  }
}

/// `edit` after 25 steps, against a simulation made as `after`, in which `each_step` may set what moves.
void check_edit(Make after, const Timeline::Edit& edit, Real largest_move = 0.05,
                const std::function<void(Simulation& fresh, Real elapsed)>& each_step = {}, const Make& made = {}) {
  for (const bool by_event : {false, true}) {
    CAPTURE(by_event);
    Simulation edited = make(made);
    Timeline timeline;
    if (by_event) timeline.add(When::at_step(25), edit);
    for (int i = 0; i < 25; ++i) timeline.step(edited);
    Simulation fresh = make(after);
    fresh.set_state(edited.state().positions, edited.state().velocities);
    const Positions before = edited.state().positions;
    if (!by_event) edit(edited, timeline);
    CHECK(edited.state().positions == before);
    compare(edited, timeline, fresh, largest_move, each_step);
  }
}

/// Where the edited curtain is when it is edited.
Vec3 place_at_edit(Index vertex) {
  Simulation simulation = make({});
  advance(simulation, 25);
  return row(simulation.state().positions, vertex);
}

}  // namespace

TEST_CASE("stiffness: one for all, a map, and back") {
  Make after;
  after.springs = 3000;
  check_edit(after, [](Simulation& s, Timeline&) { s.set_stiffness(id(s, "springs"), 3000); });
  check_edit(after, [](Simulation& s, Timeline&) { s.replace(id(s, "springs"), EdgeSpring{.stiffness = 3000}); });
  std::vector<Real> map(static_cast<std::size_t>(make({}).groups().at(GroupId{1}).set.count));
  for (std::size_t i = 0; i < map.size(); ++i) map[i] = 100 + 10 * static_cast<Real>(i);
  after.springs = map;
  check_edit(after, [&](Simulation& s, Timeline&) { s.replace(id(s, "springs"), EdgeSpring{.stiffness = map}); });
  check_edit({}, [&](Simulation& s, Timeline&) {
    s.replace(id(s, "springs"), EdgeSpring{.stiffness = map});
    s.replace(id(s, "springs"), EdgeSpring{.stiffness = 500});
  });
}

TEST_CASE("options of a group, its type, its coming and going") {
  Make after;
  after.skin->max_stretch = 1.5;
  after.skin->min_stretch = 0.5;
  check_edit(after, [&](Simulation& s, Timeline&) { s.replace(id(s, "skin"), *after.skin); });
  after.skin.reset();
  check_edit(after, [](Simulation& s, Timeline&) { s.remove(id(s, "skin")); });
  check_edit({}, [](Simulation& s, Timeline&) {
    s.remove(id(s, "skin"));
    s.add(curtain, *Make().skin, "skin");
  });
  check_edit({}, [](Simulation& s, Timeline&) {
    s.replace(id(s, "skin"), HingeBending{.stiffness = 5});
    s.replace(id(s, "skin"), *Make().skin);
  });
  after = {};
  after.drag = Drag{.stencils = {{9, 10, 18}}, .stiffness = 50, .targets = Vec3(0.2, 0.1, 0.1)};
  check_edit(after, [&](Simulation& s, Timeline&) { s.add(curtain, *after.drag); });
  after.drag->targets = place_at_edit(20);
  after.drag->stencils = {{20}};
  check_edit(after, [](Simulation& s, Timeline&) { s.add(curtain, Drag{.stencils = {{20}}, .stiffness = 50}); });
}

TEST_CASE("settings") {
  for (const Real time_step : {1.0 / 24, 1e-4}) {
    Make after;
    after.settings.time_step = time_step;
    check_edit(after, [&](Simulation& s, Timeline&) { s.set_settings(after.settings); });
  }
  for (const Index iterations : {1, 40}) {
    Make after;
    after.settings.iterations = iterations;
    check_edit(after, [&](Simulation& s, Timeline&) { s.set_settings(after.settings); });
  }
}

TEST_CASE("pins that are added, released, softened and removed") {
  Make after;
  after.pins.on = {56, 60, 63};
  after.pin_targets = {{0, 0, 1}, place_at_edit(60), {1, 0, 1}};
  check_edit(after, [&](Simulation& s, Timeline&) { s.replace(id(s, "pins"), after.pins); });
  check_edit(after, [](Simulation& s, Timeline&) { s.add(curtain, Position{.on = {60}}); });
  after.pins.on = {63};
  after.pin_targets = {{1, 0, 1}};
  check_edit(after, [](Simulation& s, Timeline&) { s.release(id(s, "pins"), std::array<Index, 1>{56}); });
  check_edit({}, [](Simulation& s, Timeline&) {
    s.release(id(s, "pins"), std::array<Index, 1>{56});
    s.replace(id(s, "pins"), Position{.on = {56, 63}}, Anchors::kept);
  });
  after = {};
  after.pins.hold = Hold::soft;
  after.pins.stiffness = 400;
  check_edit(after, [&](Simulation& s, Timeline&) { s.replace(id(s, "pins"), after.pins); });
  after.pin_targets.clear();
  check_edit(after, [](Simulation& s, Timeline&) { s.remove(id(s, "pins")); });
}

TEST_CASE("pins that move: straight, turning, along keyframes") {
  const auto set_pins = [](Simulation& s, const Vec3& first, const Vec3& second) {
    s.set_target(id(s, "pins"), 0, first);
    s.set_target(id(s, "pins"), 1, second);
  };
  check_edit(
      {},
      [](Simulation& s, Timeline& t) {
        t.start(s, id(s, "pins"), straight_path(MoveKind::offset, Vec3(0, 0.1, 0), 0.15));
      },
      0.05,
      [&](Simulation& s, Real elapsed) {
        const Real y = 0.1 * std::min<Real>(1, elapsed / 0.15);
        set_pins(s, {0, y, 1}, {1, y, 1});
      });
  check_edit(
      {},
      [](Simulation& s, Timeline& t) {
        t.start(s, id(s, "pins"), rigid_path({{.time = 1, .rotate = {{0, 0, 1}, 90}}}, Vec3(0, 0, 0)));
      },
      0.05,
      [&](Simulation& s, Real elapsed) {
        const Real angle = elapsed * std::numbers::pi / 2;
        set_pins(s, {0, 0, 1}, {std::cos(angle), std::sin(angle), 1});
      });
  check_edit(
      {},
      [](Simulation& s, Timeline& t) {
        t.start(s, id(s, "pins"),
                rigid_path({{.time = 0.1, .translate = {0, 0, 0.1}},
                            {.time = 0.2, .translate = {0, 0, 0.1}, .rotate = {{0, 0, 1}, 9}}}));
      },
      0.05,
      [&](Simulation& s, Real elapsed) {
        const Real z = 1 + std::min<Real>(elapsed, 0.1);
        const Real angle = std::clamp<Real>(elapsed - 0.1, 0, 0.1) * 90 * std::numbers::pi / 180;
        const Vec3 arm(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0);
        set_pins(s, Vec3(0.5, 0, z) - arm, Vec3(0.5, 0, z) + arm);
      });
}

TEST_CASE("pins that follow the vertices of another body") {
  Vec3 offset;
  check_edit(
      {}, [](Simulation& s, Timeline& t) { t.start(s, id(s, "pins"), follow_body(leader, {3}), {1}); }, 0.05,
      [&](Simulation& s, Real) {
        const Vec3 followed = row(s.state().positions, 67);
        if (s.state().step == 0) offset = Vec3(1, 0, 1) - followed;
        s.set_target(id(s, "pins"), 1, followed + offset);
      });
}

TEST_CASE("a stiffness that is ramped") {
  // the factor has another stiffness on the way; converged steps are the same
  Make options;
  options.settings.iterations = 100000;
  options.settings.tolerance = 1e-11;
  check_edit(
      options, [](Simulation& s, Timeline& t) { t.ramp_stiffness(s, id(s, "springs"), 4000, 0.15); }, 0.05,
      [](Simulation& s, Real elapsed) {
        s.set_stiffness(id(s, "springs"), 500 * std::pow(8.0, std::min<Real>(1, elapsed / 0.15)));
      },
      options);
}

TEST_CASE("wind and gravity") {
  Make after;
  after.wind->velocity = {1, -6, 0};
  check_edit(after, [&](Simulation& s, Timeline&) { s.replace(*s.find_force("wind"), *after.wind); });
  after.wind.reset();
  check_edit(after, [](Simulation& s, Timeline&) { s.remove(*s.find_force("wind")); });
  check_edit({}, [](Simulation& s, Timeline&) {
    s.remove(*s.find_force("wind"));
    s.add(curtain, *Make().wind);
  });
  after = {};
  after.gravity = {0, 5, 1};
  check_edit(after, [](Simulation& s, Timeline&) { s.replace(*s.find_force("gravity"), Gravity{Vec3(0, 5, 1)}); });
  after.gravity = {0, 0, 0};
  check_edit(after, [](Simulation& s, Timeline&) { s.remove(*s.find_force("gravity")); });
}

TEST_CASE("several edits at once") {
  Make after;
  after.settings.time_step = 1.0 / 50;
  after.springs = 90;
  after.skin.reset();
  after.gravity = {0, 0, -1};
  after.pins.on = {63};
  after.pin_targets = {{1, 0, 1}};
  check_edit(after, [&](Simulation& s, Timeline&) {
    s.set_settings(after.settings);
    s.set_stiffness(id(s, "springs"), 90);
    s.remove(id(s, "skin"));
    s.replace(*s.find_force("gravity"), Gravity{after.gravity});
    s.release(id(s, "pins"), std::array<Index, 1>{56});
  });
}

}  // namespace test_live_edits
