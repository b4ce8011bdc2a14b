// What holds or drives bodies changes: automatic iterations are found anew where it does.
#include <algorithm>
#include <cstring>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/pliant.h"
#include "pliant/simulation/step_error.h"
#include "pliant/simulation/transaction.h"
#include "pliant_io/checkpoint/state_file.h"

namespace test_followed_changes {

using namespace pliant;

namespace {

/// A stiff banner that hangs at rest by its upper edge, of which all but one corner can be let go.
struct Banner {
  explicit Banner(Index threads = 1)
      : simulation({.integrator = Integrator::bdf2,
                    .iterations = automatic_iterations,
                    .acceleration = Acceleration::lbfgs,
                    .damping = 2,
                    .start = Start::adaptive,
                    .threads = threads}) {
    const BodyId cloth = simulation.add_body(grid({.columns = columns, .rows = 16, .plane = Plane::xz}),
                                             Mass::area_density(0.05), {.name = "banner"});
    stretch = simulation.add(cloth, TriangleStrain{.stiffness = 1500});
    simulation.add(cloth, HingeBending{.stiffness = 1e-6});
    std::vector<Index> rest;
    for (Index i = 1; i < columns; ++i) rest.push_back(columns * 15 + i);
    simulation.add(cloth, Position{.on = {columns * 15}});
    pins = simulation.add(cloth, Position{.on = rest});
    simulation.add(Gravity{});
  }
  void advance(int steps) {
    for (int i = 0; i < steps; ++i) simulation.step();
  }
  Index iterations() const { return simulation.state().iterations; }

  static constexpr Index columns = 16;
  Simulation simulation;
  GroupId stretch{}, pins{};
};

bool same_bits(const State& a, const State& b) {
  const auto same = [](const Positions& x, const Positions& y) {
    return x.size() == y.size() &&
           std::memcmp(x.data(), y.data(), sizeof(Real) * static_cast<std::size_t>(x.size())) == 0;
  };
  return same(a.positions, b.positions) && same(a.velocities, b.velocities) && a.iterations == b.iterations &&
         a.changed_step == b.changed_step;
}

/// The steps before which iterations are found while something is done before each of so many.
template <class Change>
std::vector<std::int64_t> looks(State state, int steps, Change&& change) {
  std::vector<std::int64_t> found;
  for (int i = 0; i < steps; ++i) {
    change(state);
    if (finds_iterations(state)) found.push_back(state.step);
    ++state.step;
  }
  return found;
}

using Steps = std::vector<std::int64_t>;

}  // namespace

TEST_CASE("where pins are let go, automatic iterations become more at once") {
  Banner banner;
  banner.advance(95);
  const Index at_rest = banner.iterations();
  CHECK(at_rest < 10);
  banner.simulation.remove(banner.pins);
  banner.simulation.step();
  CHECK(banner.iterations() >= first_iterations);
  banner.advance(10);
  CHECK(banner.iterations() >= first_iterations);
  CHECK(find_step_error(banner.simulation)->share < banner.simulation.settings().step_error);
  banner.advance(21);
  CHECK(banner.iterations() < first_iterations);  // fewer do
}

TEST_CASE("a change is looked at at once, ten and thirty steps later, others at their times as ever") {
  const auto nothing = [](State&) {};
  const auto change_at = [](Steps steps) {
    return [steps = std::move(steps)](State& state) {
      if (std::ranges::find(steps, state.step) != steps.end()) state.note_change();
    };
  };
  CHECK(looks({}, 400, nothing) == Steps{10, 30, 90, 180, 360});
  CHECK(looks({}, 60, change_at({0})) == Steps{10, 30});
  CHECK(looks({}, 80, change_at({40})) == Steps{10, 30, 40, 50, 70});
  // Of changes that follow each other no look is lost, only put off.
  CHECK(looks({}, 80, change_at({40, 41, 43})) == Steps{10, 30, 40, 50, 60, 70});
  CHECK(looks({}, 80, change_at({40, 50})) == Steps{10, 30, 40, 50, 60, 70});
  CHECK(looks({}, 89, change_at({40, 65})) == Steps{10, 30, 40, 50, 65, 75});
}

TEST_CASE("a change before each step is looked at each ten steps, not in each") {
  Steps found = looks({}, 1000, [](State& state) { state.note_change(); });
  std::erase_if(found, [](std::int64_t step) { return step == 10 || step == 30 || step == 90 || step % 180 == 0; });
  CHECK(found.size() == 100);
  for (std::size_t i = 1; i < found.size(); ++i) CHECK(found[i] - found[i - 1] == 10);

  Banner banner;
  banner.advance(1);
  std::int64_t found_by_steps = 0;
  for (int i = 0; i < 40; ++i) {
    banner.simulation.set_stiffness(banner.stretch, 1500 + i);
    found_by_steps += finds_iterations(banner.simulation.state()) ? 1 : 0;
    banner.simulation.step();
  }
  CHECK(found_by_steps >= 3);
  CHECK(found_by_steps <= 6);
}

TEST_CASE("every edit of what holds or drives bodies is a change; the same stiffness again is none") {
  Banner banner;
  Simulation& s = banner.simulation;
  CHECK(s.state().changed_step == 0);
  const BodyId cloth{0};
  std::optional<GroupId> group;
  std::optional<ForceId> force;
  std::optional<ColliderId> ball;
  const auto is_change = [&](const auto& edit) {
    State quiet = s.state();
    quiet.step = 50;
    quiet.changed_step = 0;
    s.restore(quiet);
    edit();
    return s.state().changed_step == 50;
  };
  CHECK(is_change([&] { group = s.add(cloth, Position{.on = {3}, .hold = Hold::soft}); }));
  CHECK(is_change([&] { s.set_stiffness(*group, 50); }));
  CHECK(!is_change([&] { s.set_stiffness(*group, 50); }));
  CHECK(!is_change([&] { s.set_target(*group, 0, {0, 0, 1}); }));
  CHECK(is_change([&] { s.replace(*group, Position{.on = {4}, .hold = Hold::soft}); }));
  CHECK(is_change([&] { s.remove(*group); }));
  CHECK(is_change([&] { s.release(banner.pins, std::vector<Index>{Banner::columns * 15 + 1}); }));
  CHECK(is_change([&] { force = s.add(Wind{.velocity = {0, 1, 0}}); }));
  CHECK(is_change([&] { s.replace(*force, Wind{.velocity = {0, 2, 0}}); }));
  CHECK(is_change([&] { s.remove(*force); }));
  CHECK(is_change([&] { ball = s.add(SphereCollider{.center = {0, 3, 0}, .radius = 0.1}); }));
  CHECK(is_change([&] { s.replace(*ball, SphereCollider{.center = {0, 3, 0}, .radius = 0.2}); }));
  CHECK(is_change([&] { s.remove(*ball); }));
  CHECK(is_change([&] { s.set_contact(ContactSettings{.surfaces = true}); }));
  CHECK(is_change([&] { s.set_contact(cloth, BodyContact{.self = false}); }));
  CHECK(is_change([&] { s.set_mass(cloth, Mass::total(1)); }));
  SolverSettings settings = s.settings();
  settings.most_iterations = 50;
  CHECK(!is_change([&] { s.set_settings(settings); }));
  Timeline timeline;
  CHECK(is_change([&] { timeline.start(s, banner.pins, rigid_path({{.time = 1, .translate = {1, 0, 0}}})); }));
  CHECK(is_change([&] { timeline.stop(s, banner.pins); }));
}

TEST_CASE("a change that is taken back is none, nor is one before the first step or a look") {
  Banner banner;
  banner.advance(12);
  CHECK(banner.simulation.state().changed_step == 0);
  {
    const Transaction transaction(banner.simulation);
    banner.simulation.remove(banner.pins);
    CHECK(banner.simulation.state().changed_step == 12);
  }
  CHECK(banner.simulation.state().changed_step == 0);
  (void)find_step_error(banner.simulation);
  CHECK(banner.simulation.state().changed_step == 0);
}

TEST_CASE(
    "a run that is taken up between a change and the looks after it has the same bits, on any number of threads") {
  Banner whole, threads(3);
  std::string bytes;
  for (Banner* each : {&whole, &threads}) {
    each->advance(40);
    each->simulation.remove(each->pins);
    each->advance(2);
    if (each == &whole) bytes = state_bytes(whole.simulation);
    each->advance(32);
  }
  CHECK(same_bits(whole.simulation.state(), threads.simulation.state()));

  Banner resumed;
  resumed.simulation.remove(resumed.pins);
  restore_state(bytes, "banner", resumed.simulation);
  CHECK(resumed.simulation.state().changed_step == 40);
  const Index before = resumed.iterations();
  resumed.advance(32);
  CHECK(resumed.iterations() < before);
  CHECK(same_bits(whole.simulation.state(), resumed.simulation.state()));
}

TEST_CASE("a timeline says when its next event is due") {
  Banner banner;
  Timeline timeline;
  Simulation& s = banner.simulation;
  CHECK(!timeline.next_due(s).has_value());
  timeline.add(When::at_time(0.5), [](Simulation&) {});
  CHECK(timeline.next_due(s) == 30);
  timeline.add(When::at_step(2), [](Simulation&) {});
  CHECK(timeline.next_due(s) == 2);
  for (int i = 0; i < 3; ++i) timeline.step(s);
  CHECK(timeline.next_due(s) == 30);
  timeline.add(When::at_step(1), [](Simulation&) {});  // late
  CHECK(timeline.next_due(s) == 3);
  timeline.add(When::at_time(1e300), [](Simulation&) {});
  for (int i = 3; i < 31; ++i) timeline.step(s);
  CHECK(timeline.next_due(s).value() > 1'000'000'000);
}

}  // namespace test_followed_changes
