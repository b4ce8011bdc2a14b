// Factors of a stiffness from vertex to vertex.
#include <doctest/doctest.h>

#include "own_types.h"
#include "pliant/constraints/builtin.h"
#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "pliant/simulation/parameters.h"
#include "pliant/timeline/timeline.h"
#include "run.h"

namespace test_stiffness_factors {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Index side = 6;

struct Sheet {
  Simulation simulation{{.iterations = 8, .threads = 1}};
  BodyId first = simulation.add_body(grid({.columns = 2, .rows = 2}), Mass::total(1));  // so that numbers differ
  BodyId body = simulation.add_body(grid({.columns = side, .rows = side}), Mass::area_density(0.3), {.name = "sheet"});
  GroupId springs;

  explicit Sheet(const Values& stiffness = 200.0)
      : springs(simulation.add(body, EdgeSpring{.stiffness = stiffness}, "springs")) {
    simulation.add(body, Position{.on = {30, 35}});
    add_gravity(simulation);
  }
  const Positions& positions() const { return simulation.state().positions; }
};

/// From 0.1 at one side to 10 at the other.
std::vector<Real> rising() {
  std::vector<Real> factors(side * side);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    factors[i] = std::pow(10.0, 2.0 * static_cast<Real>(i % side) / (side - 1) - 1);
  }
  return factors;
}

/// What each spring of the sheet has then.
std::vector<Real> stiffnesses(const Sheet& sheet, Real common, const std::vector<Real>& factors) {
  const ConstraintGroup& batch = *sheet.simulation.groups().at(sheet.springs).set.batches.front();
  const Index first = sheet.simulation.body(sheet.body).first_vertex;
  std::vector<Real> list;
  for (std::size_t i = 0; i < batch.stencil().size(); i += 2) {
    const auto at = [&](std::size_t k) { return factors[static_cast<std::size_t>(batch.stencil()[i + k] - first)]; };
    list.push_back(common * (at(0) + at(1)) / 2);
  }
  return list;
}

}  // namespace

TEST_CASE("factors move a body as stiffnesses of each constraint do") {
  Sheet sheet, plain;
  sheet.simulation.set_stiffness_factors(sheet.springs, rising());
  Sheet listed(Values(stiffnesses(plain, 200, rising())));
  for (Sheet* each : {&sheet, &listed, &plain}) advance(each->simulation, 20);
  CHECK(largest_difference(sheet.positions(), listed.positions()) < 1e-12);
  CHECK(largest_difference(sheet.positions(), plain.positions()) > 1e-2);
}

TEST_CASE("the common stiffness multiplies them, and a group that is replaced keeps them") {
  Sheet sheet, set_later;
  sheet.simulation.set_stiffness_factors(sheet.springs, rising());
  sheet.simulation.set_stiffness(sheet.springs, 700);
  set_later.simulation.set_stiffness(set_later.springs, 700);
  set_later.simulation.set_stiffness_factors(set_later.springs, rising());
  CHECK(set_later.simulation.stiffness(set_later.springs) == 700);
  Sheet replaced;
  replaced.simulation.set_stiffness_factors(replaced.springs, rising());
  replaced.simulation.replace(replaced.springs, EdgeSpring{.stiffness = 700});
  CHECK(replaced.simulation.groups().at(replaced.springs).factors == rising());
  for (Sheet* each : {&sheet, &set_later, &replaced}) advance(each->simulation, 15);
  CHECK(sheet.positions() == set_later.positions());
  CHECK(sheet.positions() == replaced.positions());
}

TEST_CASE("without factors, or with ones, all has the bits of a group that never had any") {
  Sheet plain;
  for (const std::vector<Real>& none : {std::vector<Real>(), std::vector<Real>(side * side, 1)}) {
    Sheet sheet;
    sheet.simulation.set_stiffness_factors(sheet.springs, rising());
    sheet.simulation.set_stiffness_factors(sheet.springs, none);
    CHECK(sheet.simulation.groups().at(sheet.springs).factors.empty());
    Sheet again;
    advance(sheet.simulation, 10);
    advance(again.simulation, 10);
    CHECK(sheet.positions() == again.positions());
  }
}

TEST_CASE("every type of constraint with a stiffness takes them, of one's own as well, and copies have them") {
  Simulation simulation({.threads = 1});
  const BodyId cloth = simulation.add_body(grid({.columns = 5, .rows = 5}), Mass::area_density(0.2), {.name = "cloth"});
  std::vector<Real> factors(25, 3);
  factors[7] = 0.5;
  const auto check = [&](BodyId body, const auto& options) {
    const GroupId id = simulation.add(body, options);
    std::vector<Real> before;
    for (const auto& batch : simulation.groups().at(id).set.batches) {
      for (const Real measure : batch->rest_measure()) before.push_back(measure);
    }
    std::vector<Real> of_body(static_cast<std::size_t>(simulation.body(body).mesh.vertex_count()), 3);
    of_body[7] = 0.5;
    simulation.set_stiffness_factors(id, of_body);
    const Simulation copy = simulation.copy();
    std::size_t i = 0;
    for (const auto& batch : copy.groups().at(id).set.batches) {
      for (const Real measure : batch->rest_measure()) {
        CHECK(measure > 0.4 * before[i]);
        CHECK(measure < 3.01 * before[i++]);
      }
    }
    CHECK(copy.groups().at(id).factors == of_body);
    simulation.remove(id);
  };
  check(cloth, EdgeSpring{});
  check(cloth, EdgeStrain{});
  check(cloth, TriangleStrain{});
  check(cloth, TriangleArea{});
  check(cloth, FibreStrain{});
  check(cloth, Bending{});
  check(cloth, HingeBending{});
  check(cloth, TriangleBending{});
  check(cloth, Line{.direction = Vec3(1, 0, 0)});
  check(cloth, OnPlane{.normal = Vec3(1, 0, 0)});
  check(cloth, Position{.hold = Hold::soft});
  check(cloth, OutsideBall{});
  const BodyId block = simulation.add_body(bar({.cells = {2, 2, 2}}), Mass::density(500));
  check(block, TetrahedronStrain{});
  check(block, TetrahedronVolume{});
  check(block, TetrahedronNeoHookean{});
  check(block, TetrahedronStvk{});
  check(cloth, TriangleNeoHookean{});
  check(cloth, TriangleStvk{});
}

TEST_CASE("targets and released pins stay where they are") {
  Sheet sheet;
  const GroupId soft = sheet.simulation.add(
      sheet.body, Position{.on = {0, 1, 2}, .hold = Hold::soft, .stiffness = 50, .targets = Vec3(0, 1, 0)});
  sheet.simulation.set_target(soft, 1, {3, 4, 5});
  sheet.simulation.set_stiffness_factors(soft, rising());
  CHECK(sheet.simulation.target(soft, 1) == Vec3(3, 4, 5));
  const Index released = 0;
  sheet.simulation.release(soft, {&released, 1});
  CHECK(sheet.simulation.target(soft, 0) == Vec3(3, 4, 5));
  const auto measure_of_first = [&] {
    return sheet.simulation.groups().at(soft).set.batches.front()->rest_measure()[0];
  };
  CHECK(measure_of_first() == doctest::Approx(rising()[1]));
  sheet.simulation.set_stiffness_factors(soft, {});
  CHECK(measure_of_first() == 1);
  CHECK(sheet.simulation.groups().at(soft).set.count == 2);
  CHECK(sheet.simulation.target(soft, 0) == Vec3(3, 4, 5));
}

TEST_CASE("pins keep their factors while they are hard; rest lengths that have crept, and warnings, stay") {
  Sheet sheet;
  const GroupId pins = sheet.simulation.find_group("position").value();
  sheet.simulation.set_stiffness_factors(pins, rising());
  sheet.simulation.replace(pins, Position{.on = {30, 35}, .hold = Hold::soft, .stiffness = 50});
  const ConstraintGroup& soft = *sheet.simulation.groups().at(pins).set.batches.front();
  CHECK(soft.rest_measure()[0] == doctest::Approx(rising()[30]));
  sheet.simulation.add(sheet.body, Bending{});
  const GroupId bend = sheet.simulation.find_group("bending").value();
  const std::size_t warnings = sheet.simulation.warnings().size();
  CHECK(warnings > 0);  // of the border, which does not bend
  sheet.simulation.set_stiffness_factors(bend, rising());
  CHECK(sheet.simulation.warnings().size() == warnings);
  const auto batch = [&]() -> ConstraintGroup& {
    return *sheet.simulation.groups().at(sheet.springs).set.batches.front();
  };
  REQUIRE_FALSE(batch().parameters().empty());
  batch().parameters()[0] *= 1.5;
  const Real crept = batch().parameters()[0];
  sheet.simulation.set_stiffness_factors(sheet.springs, rising());
  CHECK(batch().parameters()[0] == crept);
}

TEST_CASE("a tie that takes the place of a group has no factors, nor what leaves its body") {
  Sheet sheet;
  sheet.simulation.set_stiffness_factors(sheet.springs, rising());
  sheet.simulation.replace(sheet.springs, Attachment{.on = {0}, .to = sheet.first, .to_on = {0}});
  CHECK(sheet.simulation.groups().at(sheet.springs).factors.empty());
  const GroupId tie = sheet.simulation.add(sheet.body, EdgeSpring{}, "again");
  sheet.simulation.set_stiffness_factors(tie, rising());
  sheet.simulation.replace(tie, EdgeSpring{.stiffness = 1e300});
  CHECK_THROWS_AS(sheet.simulation.set_stiffness_factors(tie, std::vector<Real>(side * side, 1e308)), Error);
  CHECK(sheet.simulation.groups().at(tie).factors == rising());
}

TEST_CASE("an event that fails puts the factors back") {
  Sheet sheet;
  sheet.simulation.set_stiffness_factors(sheet.springs, rising());
  Timeline timeline;
  timeline.add(When::at_step(0), [&](Simulation& simulation) {
    simulation.set_stiffness_factors(sheet.springs, std::vector<Real>(side * side, 7));
    simulation.set_stiffness(sheet.springs, -1);
  });
  CHECK_THROWS_AS(timeline.step(sheet.simulation), Error);
  CHECK(sheet.simulation.groups().at(sheet.springs).factors == rising());
}

TEST_CASE("what is no list of factors is refused, and nothing has changed") {
  Sheet sheet;
  const auto refuses = [&](GroupId group, const std::vector<Real>& factors, const char* reason) {
    CHECK_THROWS_WITH_AS(sheet.simulation.set_stiffness_factors(group, factors), reason, Error);
    CHECK(sheet.simulation.groups().at(group).factors.empty());
  };
  refuses(sheet.springs, {1, 2},
          "springs on body 'sheet': 2 factors of the stiffness for 36 vertices; give one for each");
  std::vector<Real> bad(36, 1);
  bad[3] = 0;
  refuses(sheet.springs, bad,
          "springs on body 'sheet': the factor of the stiffness at vertex 3 is 0; give a finite number above 0");
  const GroupId tie = sheet.simulation.add(sheet.body, Attachment{.on = {0}, .to = sheet.first, .to_on = {0}}, "tie");
  refuses(tie, rising(), "tie on body 'sheet': ties between bodies take no factors of the stiffness");
}

}  // namespace test_stiffness_factors
