// A timeline whose state is taken at any step and replayed elsewhere goes on with the same bits; a step that fails
// leaves simulation and timeline as they were.
#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant/forces/builtin.h"
#include "timeline_rig.h"

namespace test_replay {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// A rig with a body to follow and an event of every kind.
struct Show : Rig {
  Show() {
    const BodyId leader = simulation.add_body(grid({.columns = 2, .rows = 2}), Mass::total(1), {.name = "leader"});
    simulation.add(leader, EdgeSpring{.stiffness = 50});
    timeline.start(simulation, pins, straight_path(MoveKind::offset, Vec3(0, 1, 0), 0.35));
    timeline.add(When::at_step(1), [=, this](Simulation& s, Timeline& t) {
      t.ramp_stiffness(s, springs, 900, 0.45, Ease::smooth);
      t.start(s, pins, rigid_path({{.time = 0.5, .rotate = {{0, 0, 1}, 200}}}), {1});
    });
    timeline.add(When::at_time(0.25), [=, this](Simulation& s, Timeline& t) {
      const GroupId late = s.add(body, Position{.on = {5, 6}, .hold = Hold::soft, .stiffness = 500}, "late");
      t.start(s, late, follow_body(leader));
      SolverSettings settings = s.settings();
      settings.time_step = 0.07;
      settings.iterations = 3;
      s.set_settings(settings);
    });
    timeline.add(When::at_step(4), [=, this](Simulation& s, Timeline& t) {
      s.release(pins, std::array<Index, 1>{12});
      s.replace(springs, EdgeSpring{.on = {0, 1, 2, 3, 4, 5, 6, 7}, .stiffness = 100});
      t.start(s, *s.find_group("late"), straight_path(MoveKind::offset, Vec3(0, 0, 1), 0.2), {0});
    });
    timeline.add(When::at_time(0.6), [=, this](Simulation& s, Timeline& t) {
      s.replace(*s.find_force("gravity"), Gravity{Vec3(0, 1, -3)});
      s.add(body, Wind{.velocity = {0, 4, 0}}, "breeze");
      t.stop(s, *s.find_group("late"));
    });
    timeline.add(When::at_time(0.8), [](Simulation& s) {
      s.remove(*s.find_group("late"));
      s.remove(*s.find_force("breeze"));
    });
  }
};

/// Brings a show just made to where another is, as a checkpoint does.
void resume(Show& show, const Show& from) {
  show.timeline.replay(show.simulation, from.timeline.state());
  REQUIRE(show.simulation.groups().size() == from.simulation.groups().size());
  for (const auto& [id, group] : from.simulation.groups()) {
    const Group& copy = show.simulation.groups().at(id);
    REQUIRE(copy.set.batches.size() == group.set.batches.size());
    CHECK(copy.points == group.points);
    for (std::size_t i = 0; i < group.set.batches.size(); ++i) {
      const std::span<const Real> numbers = group.set.batches[i]->parameters();
      REQUIRE(copy.set.batches[i]->parameters().size() == numbers.size());
      std::ranges::copy(numbers, copy.set.batches[i]->parameters().begin());
      copy.set.batches[i]->set_stiffness(group.set.batches[i]->stiffness());
      copy.set.batches[i]->set_beside_factor(group.set.batches[i]->is_beside_factor());
    }
  }
  CHECK(show.simulation.settings() == from.simulation.settings());
  show.simulation.restore(from.simulation.state());
}

}  // namespace

TEST_CASE("a state replayed at any step goes on with the same bits") {
  constexpr int steps = 16;
  Show whole;
  std::vector<Positions> positions;
  for (int i = 0; i < steps; ++i) {
    whole.advance(1);
    positions.push_back(whole.simulation.state().positions);
  }
  CHECK(whole.timeline.is_over());
  for (int stop = 0; stop <= 12; ++stop) {
    CAPTURE(stop);
    Show first;
    first.advance(stop);
    Show second;
    resume(second, first);
    for (int i = stop; i < steps; ++i) {
      second.advance(1);
      CHECK(second.simulation.state().positions == positions[static_cast<std::size_t>(i)]);
    }
    CHECK(second.simulation.state().time == whole.simulation.state().time);
  }
}

TEST_CASE("states that are of another timeline are refused, and change nothing") {
  Show first;
  first.advance(5);
  const TimelineState state = first.timeline.state();
  Show second;
  Show untouched;
  const auto replay = [&](const TimelineState& wrong) {
    return error_of([&] { second.timeline.replay(second.simulation, wrong); });
  };
  TimelineState wrong = state;
  wrong.applied.push_back(99);
  CHECK(contains(replay(wrong), "event 99 is not of this timeline"));
  wrong = state;
  wrong.applied.push_back(wrong.applied[0]);
  CHECK(contains(replay(wrong), "event 0 is not of this timeline"));
  wrong = state;
  wrong.applied = {-1};
  CHECK(contains(replay(wrong), "event -1 is not of this timeline"));
  wrong = state;
  REQUIRE(!wrong.motions.empty());
  wrong.motions[0].order = 7;
  CHECK(contains(replay(wrong), "motion 7 of event"));
  for (const Index bad : {-1, 1000}) {
    CAPTURE(bad);
    wrong = state;
    for (TimelineState::Motion& motion : wrong.motions) motion.numbers.points.at(0).vertex = bad;
    CHECK(contains(replay(wrong), "a point follows vertex " + std::to_string(bad)));
  }
  second.advance(7);
  untouched.advance(7);
  CHECK(second.simulation.state().positions == untouched.simulation.state().positions);
  CHECK_FALSE(replay(state).empty());  // of an earlier time, with motions that have ended since
  wrong = state;
  wrong.applied.clear();
  CHECK(contains(replay(wrong), "has begun already, and otherwise"));
}

TEST_CASE("a point that a straight path does not have is refused") {
  const auto begun = [](Rig& rig) {
    rig.timeline.start(rig.simulation, rig.pins,
                       straight_path(MoveKind::target, std::vector<Vec3>{{0, 0, 1}, {1, 0, 1}}, 0.5));
  };
  Rig first;
  begun(first);
  first.advance(1);
  for (const Index bad : {-1, 2, 1000}) {
    CAPTURE(bad);
    Rig second;
    begun(second);
    TimelineState wrong = first.timeline.state();
    wrong.motions.at(0).numbers.points.at(1).place = bad;
    CHECK(contains(error_of([&] { second.timeline.replay(second.simulation, wrong); }),
                   "point " + std::to_string(bad) + " of a path of 2 points"));
  }
}

TEST_CASE("a ramp that no edit can begin is refused") {
  Rig first;
  first.timeline.ramp_stiffness(first.simulation, first.springs, 900, 1);
  const TimelineState state = first.timeline.state();
  const auto refusal = [&](auto&& spoil) {
    Rig second;
    TimelineState wrong = state;
    spoil(wrong.ramps.at(0), second);
    return error_of([&] { second.timeline.replay(second.simulation, wrong); });
  };
  CHECK(contains(refusal([](StiffnessRamp& ramp, Rig&) { ramp.duration = 0; }), "of a ramp is out of range"));
  CHECK(contains(refusal([](StiffnessRamp& ramp, Rig&) { ramp.from = -1; }), "the stiffness -1 is out of range"));
  CHECK(contains(refusal([](StiffnessRamp& ramp, Rig&) { ramp.to = 0; }), "the stiffness 0 is out of range"));
  CHECK(contains(refusal([](StiffnessRamp& ramp, Rig& rig) { ramp.group = rig.pins; }), "has no stiffness"));
}

TEST_CASE("a step that is refused leaves everything as before it") {
  for (int steps = 0; steps < 12; ++steps) {
    CAPTURE(steps);
    Show show;
    Show untouched;
    show.advance(steps);
    untouched.advance(steps);
    // A velocity that leads past all numbers.
    const State state = show.simulation.state();
    const std::size_t groups = show.simulation.groups().size();
    show.simulation.set_state(state.positions, Positions::Constant(state.vertex_count(), 3, 1e200));
    CHECK_THROWS_AS(show.advance(1), Error);
    CHECK(show.simulation.state().step == steps);
    CHECK(show.simulation.groups().size() == groups);
    CHECK(show.timeline.state().applied == untouched.timeline.state().applied);
    CHECK(show.simulation.settings() == untouched.simulation.settings());
    CHECK(show.pin(0) == untouched.pin(0));
    CHECK_THROWS_AS(show.advance(1), Error);
    show.simulation.set_state(state.positions, state.velocities);
    show.advance(4);
    untouched.advance(4);
    CHECK(show.simulation.state().positions == untouched.simulation.state().positions);
  }
}

TEST_CASE("an edit that fails takes those of its step back, and says which it was") {
  Rig rig;
  Rig untouched;
  for (Rig* each : {&rig, &untouched}) {
    each->timeline.start(each->simulation, each->pins, straight_path(MoveKind::offset, Vec3(0, 0, 1), 1));
  }
  rig.timeline.add(When::at_step(2), [](Simulation& s, Timeline& t) {
    s.set_stiffness(GroupId{0}, 5);
    t.start(s, GroupId{1}, straight_path(MoveKind::offset, Vec3(0, 5, 0)));
    t.add(When::at_step(0), [](Simulation&) {});
  });
  rig.timeline.add(
      When::at_time(0.15), [](Simulation& s) { s.remove(GroupId{42}); }, "my scene: events[3]");
  rig.advance(2);
  untouched.advance(2);
  CHECK(contains(error_of([&] { rig.advance(1); }), "my scene: events[3]: group 42 does not exist"));
  CHECK(rig.timeline.event_count() == 2);
  CHECK(rig.timeline.state().applied.empty());
  CHECK(rig.simulation.stiffness(rig.springs) == 200);
  CHECK(rig.pin(0) == untouched.pin(0));
  CHECK(contains(error_of([&] { rig.advance(1); }), "events[3]"));  // still due
  rig.simulation.step();
  untouched.simulation.step();
  CHECK(rig.simulation.state().positions == untouched.simulation.state().positions);
}

}  // namespace test_replay
