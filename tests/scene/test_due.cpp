// When events act, in which order, and what is left when groups go.
#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "timeline_rig.h"

namespace test_due {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// The steps before which events at these times act, with time steps that are set at these steps.
std::vector<std::int64_t> due_steps(Real time_step, const std::vector<Real>& times,
                                    const std::vector<std::pair<std::int64_t, Real>>& changes = {}) {
  Rig rig(time_step);
  std::vector<std::int64_t> steps(times.size(), -1);
  for (std::size_t i = 0; i < times.size(); ++i) {
    rig.timeline.add(When::at_time(times[i]), [&steps, i](Simulation& s) { steps[i] = s.state().step; });
  }
  for (const auto& [step, new_time_step] : changes) {
    rig.timeline.add(When::at_step(step), [h = new_time_step](Simulation& s) {
      SolverSettings settings = s.settings();
      settings.time_step = h;
      s.set_settings(settings);
    });
  }
  rig.advance(200);
  return steps;
}

}  // namespace

TEST_CASE("with a constant time step a time t acts before the step ⌈t/h − 1e-9⌉") {
  for (const Real h : {0.1, 1.0 / 60, 0.003, 1.0 / 3}) {
    CAPTURE(h);
    std::vector<Real> times;
    for (int n = 0; n < 180; ++n) {
      for (const Real fraction : {0.0, 1e-12, 1e-7, 0.5, 1 - 1e-12}) times.push_back((n + fraction) * h);
    }
    const std::vector<std::int64_t> steps = due_steps(h, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      CHECK(steps[i] == static_cast<std::int64_t>(std::ceil(times[i] / h - 1e-9)));
    }
  }
}

TEST_CASE("times stay right when the time step changes") {
  // Steps begin at 0, 0.1, 0.2, 0.3, 0.35, 0.4, ..., 0.5, 0.7, 0.9, ...
  const std::vector<Real> times = {0.3, 0.31, 0.35, 0.36, 0.5, 0.51, 0.7, 0.70001, 0.9};
  const std::vector<std::int64_t> steps = due_steps(0.1, times, {{3, 0.05}, {7, 0.2}});
  CHECK(steps == std::vector<std::int64_t>{3, 4, 4, 5, 7, 8, 8, 9, 9});
}

TEST_CASE("events due before the same step act in the order of their adding") {
  Rig rig;
  std::string order;
  const auto note = [&order](char name) { return [&order, name](Simulation&) { order += name; }; };
  rig.timeline.add(When::at_time(0.19), note('a'));
  rig.timeline.add(When::at_step(2), note('b'));
  rig.timeline.add(When::at_time(0.11), note('c'));
  rig.timeline.add(When::at_step(1), note('d'));
  rig.timeline.add(When::at_step(2), note('e'));
  CHECK(rig.timeline.event_count() == 5);
  rig.advance(1);
  CHECK(order.empty());
  rig.advance(3);
  CHECK(order == "dabce");
  CHECK(rig.timeline.state().applied == std::vector<Index>{3, 0, 1, 2, 4});
  rig.timeline.add(When::at_step(1), note('f'));  // late, hence at once
  rig.advance(1);
  CHECK(order == "dabcef");
}

TEST_CASE("an edit may add events, for now or later") {
  Rig rig;
  std::string order;
  rig.timeline.add(When::at_step(1), [&](Simulation&, Timeline& t) {
    for (const std::int64_t step : {3, 1}) {
      t.add(When::at_step(step), [&order, step](Simulation&) { order += std::to_string(step); });
    }
    order += 'a';
  });
  rig.timeline.add(When::at_step(1), [&](Simulation&) { order += 'b'; });
  rig.advance(2);
  CHECK(order == "ab1");
  rig.advance(2);
  CHECK(order == "ab13");
  CHECK(rig.timeline.is_over());
}

TEST_CASE("jumps of one step add up") {
  Rig rig;
  for (int i = 0; i < 3; ++i) {
    rig.timeline.add(When::at_step(1), [&rig](Simulation& s, Timeline& t) {
      t.start(s, rig.pins, straight_path(MoveKind::offset, Vec3(0, 1, 0)));
    });
  }
  rig.advance(1);
  CHECK(rig.pin(0)[1] == 0);
  rig.advance(1);
  CHECK(rig.pin(0)[1] == 3);
}

TEST_CASE("a motion goes on where its pins are, whatever becomes of the others") {
  Rig rig;
  rig.simulation.replace(rig.pins, Position{.on = {12, 13, 14, 15}});
  rig.timeline.start(rig.simulation, rig.pins, straight_path(MoveKind::offset, Vec3(0, 1, 0), 1));
  rig.advance(2);
  rig.simulation.release(rig.pins, std::array<Index, 1>{13});
  rig.advance(1);
  CHECK(rig.simulation.target_count(rig.pins) == 3);
  for (const Index vertex : {12, 14, 15}) CHECK(rig.vertex(vertex)[1] == doctest::Approx(0.3).epsilon(1e-14));
  const Vec3 place = rig.vertex(3);
  rig.simulation.replace(rig.pins, Position{.on = {3, 14, 15}, .hold = Hold::soft, .stiffness = 10});
  rig.advance(1);
  CHECK(rig.pin(1)[1] == doctest::Approx(0.4).epsilon(1e-14));
  CHECK(rig.pin(0) == place);
  const auto start = [&] {
    rig.timeline.start(rig.simulation, rig.pins, straight_path(MoveKind::offset, Vec3(0, 1, 0)), {2});
  };
  CHECK(contains(error_of(start), "constraint 2 of the group 'pins' was released"));
  rig.simulation.remove(rig.pins);
  CHECK_NOTHROW(rig.advance(1));
  CHECK(rig.timeline.is_over());
  CHECK(contains(error_of([&] { rig.timeline.stop(rig.simulation, rig.pins); }), "does not exist"));
}

TEST_CASE("a later motion takes over, a stop leaves targets where they are") {
  Rig rig;
  rig.timeline.start(rig.simulation, rig.pins, straight_path(MoveKind::offset, Vec3(0, 1, 0), 1));
  rig.advance(2);
  rig.timeline.start(rig.simulation, rig.pins, straight_path(MoveKind::offset, Vec3(0, 0, 1), 0.2), {1});
  rig.advance(1);
  CHECK(rig.pin(0)[1] == doctest::Approx(0.3));
  CHECK(rig.pin(1)[1] == doctest::Approx(0.2));
  CHECK(rig.pin(1)[2] == doctest::Approx(1.5));
  rig.timeline.stop(rig.simulation, rig.pins, {0});
  rig.advance(2);
  CHECK(rig.pin(0)[1] == doctest::Approx(0.3));
  CHECK(rig.pin(1)[2] == 2);
  CHECK(rig.timeline.is_over());
}

TEST_CASE("a ramp goes by equal ratios and ends exactly") {
  Rig rig;
  rig.timeline.ramp_stiffness(rig.simulation, rig.springs, 3200, 0.4);
  for (const Real expected : {400.0, 800.0, 1600.0}) {
    rig.advance(1);
    CHECK(*rig.simulation.stiffness(rig.springs) == doctest::Approx(expected).epsilon(1e-14));
  }
  rig.advance(1);
  CHECK(rig.simulation.stiffness(rig.springs) == 3200);
  CHECK(rig.timeline.is_over());
  rig.timeline.ramp_stiffness(rig.simulation, rig.springs, 200, 0.4, Ease::smooth);
  rig.advance(1);
  CHECK(*rig.simulation.stiffness(rig.springs) == doctest::Approx(3200 * std::pow(1.0 / 16, 0.15625)));
  rig.timeline.stop(rig.simulation, rig.springs);
  rig.advance(1);
  CHECK(*rig.simulation.stiffness(rig.springs) == doctest::Approx(3200 * std::pow(1.0 / 16, 0.15625)));
}

TEST_CASE("what is due acts by a clock from elsewhere, without a step, and nothing of a refused one stays") {
  Rig rig;
  std::vector<int> acted;
  for (const std::int64_t step : {7, 3}) {
    rig.timeline.add(When::at_step(step), [&acted, step](Simulation&) { acted.push_back(static_cast<int>(step)); });
  }
  rig.timeline.add(When::at_time(0.5), [](Simulation& s, Timeline& t) {
    s.set_stiffness(*s.find_group("springs"), 77);
    if (t.event_count() < 4) fail_input("too early");
  });
  for (std::int64_t step = 0; step < 5; ++step)
    rig.timeline.act_due(rig.simulation, step, 0.1 * static_cast<Real>(step));
  CHECK(acted == std::vector<int>{3});
  CHECK_THROWS_AS(rig.timeline.act_due(rig.simulation, 5, 0.5), Error);
  CHECK(*rig.simulation.stiffness(rig.springs) == 200);
  rig.timeline.add(When::at_time(1), [](Simulation&) {});
  rig.timeline.act_due(rig.simulation, 5, 0.5);
  CHECK(*rig.simulation.stiffness(rig.springs) == 77);
  rig.timeline.act_due(rig.simulation, 9, 0.9);
  CHECK(acted == std::vector<int>{3, 7});
  CHECK(rig.simulation.state().step == 0);
}

TEST_CASE("events, motions and ramps that are refused") {
  Rig rig;
  constexpr Real not_a_number = std::numeric_limits<Real>::quiet_NaN();
  const auto add = [&](When when) { return error_of([&] { rig.timeline.add(when, [](Simulation&) {}); }); };
  CHECK(contains(add(When::at_step(-1)), "step -1 is before the start"));
  CHECK(contains(add(When::at_time(-0.5)), "-0.5 s is before the start"));
  CHECK(contains(add(When::at_time(not_a_number)), "not finite"));
  const auto ramp = [&](GroupId group, Real to, Real duration) {
    return error_of([&] { rig.timeline.ramp_stiffness(rig.simulation, group, to, duration); });
  };
  CHECK(contains(ramp(rig.pins, 5, 1), "hard pins have none"));
  CHECK(contains(ramp(rig.springs, 0, 1), "the stiffness 0 is out of range"));
  CHECK(contains(ramp(rig.springs, not_a_number, 1), "is out of range; give a finite number above 0"));
  CHECK(contains(ramp(rig.springs, 5, 0), "the duration 0 s of a ramp"));
  CHECK(contains(ramp(GroupId{9}, 5, 1), "group 9 does not exist"));
  CHECK(rig.timeline.is_over());
}

}  // namespace test_due
