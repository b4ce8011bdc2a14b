// Groups and forces that are found, replaced and released; states that are restored; changes that are taken back.
#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "everything.h"
#include "pliant/forces/builtin.h"
#include "pliant/simulation/transaction.h"
#include "run.h"

namespace test_edits {

using namespace pliant;
using namespace pliant_tests;

namespace {

struct Sheet {
  Simulation simulation{SolverSettings{.iterations = 5, .threads = 1}};
  BodyId body = simulation.add_body(grid({.columns = 4, .rows = 4}), Mass::total(1), {.name = "sheet"});
  GroupId springs = simulation.add(body, EdgeSpring{.stiffness = 200}, "springs");
  GroupId pins = simulation.add(body, Position{.on = {12, 13, 15}}, "pins");
};

std::vector<Vec3> targets(const Simulation& simulation, GroupId group) {
  std::vector<Vec3> all;
  for (Index i = 0; i < simulation.target_count(group); ++i) all.push_back(simulation.target(group, i));
  return all;
}

Positions after(Simulation& simulation, int steps) {
  advance(simulation, steps);
  return simulation.state().positions;
}

}  // namespace

TEST_CASE("groups and forces are found by their names") {
  Sheet sheet;
  Simulation& simulation = sheet.simulation;
  CHECK(simulation.find_group("pins") == sheet.pins);
  CHECK(simulation.find_group("springs") == sheet.springs);
  CHECK(simulation.find_group("pin") == std::nullopt);
  CHECK(simulation.find_group("") == std::nullopt);
  const GroupId second = simulation.add(sheet.body, EdgeSpring{}, "springs");
  CHECK(simulation.find_group("springs") == sheet.springs);
  simulation.remove(sheet.springs);
  CHECK(simulation.find_group("springs") == second);

  const ForceId breeze = simulation.add(sheet.body, Wind{}, "breeze");
  const ForceId wind = simulation.add(sheet.body, Wind{});
  const ForceId another = simulation.add(Wind{});
  CHECK(simulation.name(breeze) == "breeze");
  CHECK(simulation.name(wind) == "wind");
  CHECK(simulation.name(another) == "wind 2");
  CHECK(simulation.find_force("wind 2") == another);
  CHECK(simulation.find_force("gravity") == std::nullopt);
  simulation.remove(wind);
  CHECK(simulation.find_force("wind") == std::nullopt);
  CHECK(contains(error_of([&] { simulation.name(wind); }), "force 1 does not exist"));
  CHECK(contains(error_of([&] { simulation.replace(wind, Gravity{}); }), "force 1 does not exist"));
  CHECK(contains(error_of([&] { simulation.replace(breeze, nullptr); }), "there is none"));
  const MouseSpring far{.vertices = {16}};
  CHECK(contains(error_of([&] { simulation.replace(breeze, far); }), "vertex 16 is out of range"));
}

TEST_CASE("a replaced group keeps id, name and targets; vertices that it did not have begin where they are") {
  Sheet sheet;
  Simulation& simulation = sheet.simulation;
  simulation.set_target(sheet.pins, 1, {9, 9, 9});
  advance(simulation, 3);
  const Vec3 place = row(simulation.state().positions, 14);

  SUBCASE("other vertices") {
    simulation.replace(sheet.pins, Position{.on = {13, 14, 15}});
    CHECK(targets(simulation, sheet.pins) == std::vector<Vec3>{{9, 9, 9}, place, {1, 0, 1}});
    CHECK(simulation.groups().at(sheet.pins).points == std::vector<Index>{1, 3, 2});
  }
  SUBCASE("another hold") {
    simulation.replace(sheet.pins, Position{.on = {12, 13, 15}, .hold = Hold::soft, .stiffness = 50});
    CHECK(targets(simulation, sheet.pins)[1] == Vec3(9, 9, 9));
    CHECK(simulation.groups().at(sheet.pins).points == std::vector<Index>{0, 1, 2});
    CHECK(simulation.stiffness(sheet.pins) == 50);
    simulation.replace(sheet.pins, Position{.on = {12, 13}});
    CHECK(targets(simulation, sheet.pins)[1] == Vec3(9, 9, 9));
    CHECK(simulation.stiffness(sheet.pins) == std::nullopt);
  }
  SUBCASE("targets that are given count") {
    simulation.replace(sheet.pins, Position{.on = {12, 13}, .targets = Vec3(1, 2, 3)});
    CHECK(targets(simulation, sheet.pins) == std::vector<Vec3>{{1, 2, 3}, {1, 2, 3}});
    simulation.replace(sheet.pins, Position{.on = {12, 13}, .targets = Vec3(7, 7, 7)}, Anchors::kept);
    CHECK(targets(simulation, sheet.pins) == std::vector<Vec3>{{1, 2, 3}, {1, 2, 3}});
  }
  CHECK(simulation.find_group("pins") == sheet.pins);
  CHECK(simulation.groups().size() == 2);
  CHECK_NOTHROW(simulation.step());
}

TEST_CASE("a replaced drag keeps its targets by vertices and weights, a line its origin") {
  Sheet sheet;
  Simulation& simulation = sheet.simulation;
  const GroupId drag = simulation.add(sheet.body, Drag{.stencils = {{0, 1}, {2}}, .weights = {{0.25, 0.75}, {1}}});
  simulation.set_target(drag, 0, {1, 1, 1});
  simulation.set_target(drag, 1, {2, 2, 2});
  simulation.replace(drag, Drag{.stencils = {{2}, {0, 1}, {0, 1}}, .weights = {{1}, {0.25, 0.75}, {0.5, 0.5}}});
  const Vec3 middle = (row(simulation.state().positions, 0) + row(simulation.state().positions, 1)) / 2;
  CHECK(targets(simulation, drag) == std::vector<Vec3>{{2, 2, 2}, {1, 1, 1}, middle});
  CHECK(simulation.groups().at(drag).points == std::vector<Index>{1, 0, 2});

  const GroupId line = simulation.add(sheet.body, Line{.on = {5}, .direction = Vec3(0, 0, 1)});
  const auto origin = [&] {
    const std::span<const Real> numbers = simulation.groups().at(line).set.batches[0]->anchor(0);
    return Vec3(numbers[0], numbers[1], numbers[2]);
  };
  const Vec3 before = origin();
  add_gravity(simulation, {3, 0, 0});
  advance(simulation, 10);
  simulation.replace(line, Line{.on = {5}, .stiffness = 3, .direction = Vec3(0, 1, 0)});
  CHECK(origin() == before);
  simulation.replace(line, Line{.on = {5}, .direction = Vec3(0, 1, 0), .origin = Vec3(4, 0, 0)});
  CHECK(origin() == Vec3(4, 0, 0));
}

TEST_CASE("released vertices go, the others stay") {
  Sheet sheet;
  Simulation& simulation = sheet.simulation;
  SUBCASE("hard") {}
  SUBCASE("soft, with a stiffness each") {
    simulation.replace(sheet.pins,
                       Position{.on = {12, 13, 15}, .hold = Hold::soft, .stiffness = std::vector<Real>{1, 2, 3}});
  }
  simulation.set_target(sheet.pins, 2, {3, 3, 3});
  const std::array<Index, 2> released = {12, 13};
  simulation.release(sheet.pins, std::span(released).first(1));
  CHECK(targets(simulation, sheet.pins) == std::vector<Vec3>{row(simulation.state().positions, 13), {3, 3, 3}});
  CHECK(simulation.groups().at(sheet.pins).points == std::vector<Index>{1, 2});
  CHECK(simulation.groups().at(sheet.pins).set.count == 2);
  const auto& batch = simulation.groups().at(sheet.pins).set.batches[0];
  if (batch->shape().count > 0)
    CHECK(std::vector<Real>(batch->rest_measure().begin(), batch->rest_measure().end()) == std::vector<Real>{2, 3});
  CHECK(contains(error_of([&] { simulation.release(sheet.pins, released); }), "vertex 12 is not pinned here"));
  CHECK(simulation.target_count(sheet.pins) == 2);
  const std::array<Index, 2> others = {15, 13};
  simulation.release(sheet.pins, others);
  CHECK(simulation.target_count(sheet.pins) == 0);
  CHECK_NOTHROW(simulation.step());
  const std::array<Index, 1> far = {16};
  CHECK(contains(error_of([&] { simulation.release(sheet.pins, far); }), "vertex 16 is out of range"));
  CHECK(contains(error_of([&] { simulation.release(sheet.springs, released); }), "only positions can be released"));
  simulation.add(sheet.body, Position{.on = {12}});  // it is free
}

TEST_CASE("a replacement that is refused changes nothing") {
  Sheet sheet;
  Simulation& simulation = sheet.simulation;
  Sheet untouched;
  simulation.add(sheet.body, Position{.on = {0}}, "corner");
  untouched.simulation.add(untouched.body, Position{.on = {0}}, "corner");
  CHECK(contains(error_of([&] {
                   simulation.replace(sheet.pins, Position{.on = {0, 12}});
                 }),
                 "already pinned by 'corner'"));
  CHECK(contains(error_of([&] { simulation.replace(sheet.pins, Position{.on = {16}}); }), "out of range"));
  CHECK(contains(error_of([&] { simulation.replace(sheet.springs, EdgeSpring{.stiffness = -1}); }), "stiffness"));
  CHECK(contains(error_of([&] { simulation.replace(GroupId{9}, EdgeSpring{}); }), "group 9 does not exist"));
  CHECK(after(simulation, 5) == after(untouched.simulation, 5));
}

TEST_CASE("a restored state goes on with the same bits") {
  Simulation first = everything({.iterations = 4, .threads = 1}, 6);
  Simulation second = everything({.iterations = 4, .threads = 1}, 6);
  advance(first, 7);
  second.restore(first.state());
  CHECK(second.state().step == 7);
  CHECK(second.state().time == first.state().time);
  CHECK(after(first, 6) == after(second, 6));
  CHECK(first.state().velocities == second.state().velocities);
  CHECK(first.state().time == second.state().time);

  State wrong = first.state();
  wrong.masses[3] *= 2;
  CHECK(contains(error_of([&] { second.restore(wrong); }), "the masses differ"));
  wrong = first.state();
  wrong.positions.conservativeResize(5, 3);
  CHECK(contains(error_of([&] { second.restore(wrong); }), "5 rows"));
  wrong = first.state();
  wrong.step = -1;
  CHECK(contains(error_of([&] { second.restore(wrong); }), "step -1"));
  wrong = first.state();
  wrong.time = std::numeric_limits<Real>::quiet_NaN();
  CHECK(contains(error_of([&] { second.restore(wrong); }), "not a state of a simulation"));
  CHECK(after(first, 3) == after(second, 3));
}

TEST_CASE("with its numbers and stiffness, a group made anew has the bits of the first") {
  Simulation first = everything({.iterations = 4, .threads = 1}, 6);
  advance(first, 5);
  first.set_target(GroupId{6}, 0, {0.1, 0.2, 0.9});
  first.set_stiffness(GroupId{0}, 321);
  advance(first, 5);
  const GroupId late = first.add(BodyId{0}, Position{.on = {8}});  // pinned where it is now
  Simulation second = everything({.iterations = 4, .threads = 1}, 6);
  second.add(BodyId{0}, Position{.on = {8}});
  for (const auto& [id, group] : first.groups()) {
    for (std::size_t p = 0; p < group.set.batches.size(); ++p) {
      ConstraintGroup& copy = *second.groups().at(id).set.batches[p];
      std::ranges::copy(group.set.batches[p]->parameters(), copy.parameters().begin());
      if (copy.shape().count > 0) copy.set_stiffness(group.set.batches[p]->stiffness());
      if (id == late) copy.set_beside_factor(group.set.batches[p]->is_beside_factor());
    }
  }
  second.restore(first.state());
  CHECK(first.target(late, 0) == second.target(late, 0));
  CHECK(after(first, 5) == after(second, 5));
}

namespace {

/// Does all that an Transaction takes back.
void change_everything(Simulation& simulation) {
  simulation.set_target(GroupId{5}, 0, {5, 5, 5});
  simulation.set_stiffness(GroupId{0}, 7);
  simulation.replace(GroupId{5}, Position{.on = {3}});
  simulation.set_target(GroupId{5}, 0, {6, 6, 6});
  simulation.remove(GroupId{1});
  simulation.remove(simulation.add(BodyId{0}, EdgeSpring{}));
  const GroupId added = simulation.add(BodyId{0}, Position{.on = {13}});
  simulation.replace(added, Position{.on = {14}});
  simulation.replace(ForceId{0}, Gravity{Vec3(1, 1, 1)});
  simulation.remove(ForceId{0});
  simulation.remove(ForceId{1});
  simulation.add(Wind{.velocity = {9, 9, 9}});
  SolverSettings settings = simulation.settings();
  settings.time_step = 0.5;
  simulation.set_settings(settings);
  simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::total(1));
  simulation.set_state(2 * simulation.state().positions, simulation.state().velocities);
}

}  // namespace

TEST_CASE("changes are taken back, all of them") {
  Simulation changed = everything({.iterations = 4, .threads = 1}, 6);
  Simulation untouched = everything({.iterations = 4, .threads = 1}, 6);
  advance(changed, 3);
  advance(untouched, 3);
  const std::size_t warnings = changed.warnings().size();
  SUBCASE("at the end") {
    const Transaction transaction(changed);
    change_everything(changed);
  }
  SUBCASE("by an error") {
    const auto fail = [&] {
      Transaction transaction(changed);
      change_everything(changed);
      changed.set_stiffness(GroupId{0}, -1);
      transaction.commit();
    };
    CHECK(contains(error_of(fail), "stiffness"));
  }
  SUBCASE("those that an inner one kept, with those before and after it") {
    const Transaction transaction(changed);
    changed.set_stiffness(GroupId{2}, 3);
    changed.set_target(GroupId{5}, 1, {2, 2, 2});
    {
      Transaction inner(changed);
      change_everything(changed);
      inner.commit();
    }
    changed.remove(GroupId{0});
  }
  SUBCASE("of an inner one alone") {
    Transaction transaction(changed);
    changed.set_stiffness(GroupId{0}, 3);
    {
      const Transaction inner(changed);
      change_everything(changed);
    }
    CHECK(changed.stiffness(GroupId{0}) == 3);
    changed.set_stiffness(GroupId{0}, 400);
    transaction.commit();
  }
  CHECK(changed.bodies().size() == 3);
  CHECK(changed.warnings().size() == warnings);
  CHECK(changed.settings() == untouched.settings());
  CHECK(changed.groups().size() == untouched.groups().size());
  CHECK(changed.find_force("test_force") == untouched.find_force("test_force"));
  CHECK(after(changed, 5) == after(untouched, 5));
  // Ids go on where they were.
  CHECK(changed.add(BodyId{0}, Position{.on = {13}}) == untouched.add(BodyId{0}, Position{.on = {13}}));
  CHECK(after(changed, 5) == after(untouched, 5));
}

TEST_CASE("changes that are kept stay") {
  Simulation changed = everything({.iterations = 4, .threads = 1}, 6);
  {
    Transaction transaction(changed);
    changed.remove(GroupId{1});
    transaction.commit();
  }
  CHECK(!changed.groups().contains(GroupId{1}));
  changed.remove(GroupId{2});
  CHECK(!changed.groups().contains(GroupId{2}));
}

}  // namespace test_edits
