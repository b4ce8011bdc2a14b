// How stiff groups are, as it is shown.
#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/pliant.h"
#include "pliant/simulation/group_stiffness.h"

namespace test_group_stiffness {

using namespace pliant;

namespace {

struct Sheets {
  Sheets() {
    other = simulation.add_body(grid({.columns = 2, .rows = 2}), Mass::total(1));
    sheet = simulation.add_body(grid({.columns = 3, .rows = 2}), Mass::total(1));
  }
  StiffnessRange range(GroupId id) const { return stiffness_range(simulation, id).value(); }

  Simulation simulation;
  BodyId sheet{}, other{};
};

void check(const StiffnessRange& range, Real least, Real most, std::string_view unit) {
  CHECK(range.least == doctest::Approx(least));
  CHECK(range.most == doctest::Approx(most));
  CHECK(range.unit == unit);
}

}  // namespace

TEST_CASE("a group has the stiffness of its constraints as it is now, with the unit of its type") {
  Sheets sheets;
  Simulation& s = sheets.simulation;
  const GroupId strain = s.add(sheets.sheet, TriangleStrain{.stiffness = 700});
  check(sheets.range(strain), 700, 700, "N/m");
  s.set_stiffness(strain, 300);
  check(sheets.range(strain), 300, 300, "N/m");
  check(sheets.range(s.add(sheets.sheet, HingeBending{.stiffness = 1e-5})), 1e-5, 1e-5, "N·m");
  check(sheets.range(s.add(sheets.sheet, EdgeStrain{.measure = FibreMeasure::rope})), 1e3, 1e3, "N");
  check(sheets.range(s.add(sheets.sheet, EdgeStrain{.measure = FibreMeasure::cloth})), 1e3, 1e3, "N/m");
  check(sheets.range(s.add(sheets.sheet, Attachment{.on = {0}, .to = sheets.other})), 1e3, 1e3, "N/m");
  const StiffnessRange fibers = sheets.range(s.add(sheets.sheet, FibreStrain{.stiffness = 50, .taut_factor = 4}));
  check(fibers, 50, 50, "N/m");
  CHECK(fibers.taut_factor == 4);
}

TEST_CASE("where constraints differ, it is a range") {
  Sheets sheets;
  Simulation& s = sheets.simulation;
  const GroupId springs = s.add(sheets.sheet, EdgeSpring{.on = {0, 1, 2}, .stiffness = std::vector<Real>{5, 60}});
  check(sheets.range(springs), 5, 60, "N/m");
  s.set_stiffness(springs, 2);  // the common factor
  check(sheets.range(springs), 10, 120, "N/m");

  // Each constraint has the mean of its vertices.
  const GroupId by_vertices =
      s.add(sheets.sheet, EdgeSpring{.on = {0, 1, 2}, .stiffness = Values::of_vertices({1, 3, 9, 0.5, 0.5, 0.5})});
  check(sheets.range(by_vertices), 2, 6, "N/m");

  const GroupId painted = s.add(sheets.sheet, EdgeSpring{.on = {0, 1, 2}, .stiffness = 100});
  s.set_stiffness_factors(painted, {1, 1, 3, 1, 1, 1});
  check(sheets.range(painted), 100, 200, "N/m");
  s.set_stiffness_factors(by_vertices, {1, 1, 3, 1, 1, 1});
  check(sheets.range(by_vertices), 2, 12, "N/m");
}

TEST_CASE("what has no stiffness has no range; soft pins and constraints made elsewhere have one") {
  Sheets sheets;
  Simulation& s = sheets.simulation;
  CHECK(!stiffness_range(s, s.add(sheets.sheet, Position{.on = {0}})).has_value());
  check(sheets.range(s.add(sheets.sheet, Position{.on = {1}, .hold = Hold::soft, .stiffness = 40})), 40, 40, "N/m");
  ConstraintSet set = build(BodyView{s.body(sheets.other).mesh, s.state().positions.topRows(4), 0, "other", 0},
                            EdgeSpring{.stiffness = 9});
  check(sheets.range(s.add_set(sheets.other, std::move(set), "own")), 9, 9, "");
  CHECK_THROWS_AS((void)stiffness_range(s, GroupId{99}), Error);
}

}  // namespace test_group_stiffness
