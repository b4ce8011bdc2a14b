// A simulation twice: both go on with the same bits, and neither knows of the other.
#include <doctest/doctest.h>

#include "everything.h"
#include "own_types.h"
#include "pliant/collision/colliders/builtin.h"
#include "pliant/core/error.h"
#include "pliant/simulation/parameters.h"
#include "run.h"

namespace test_copy {

using namespace pliant;
using namespace pliant_tests;

namespace {

void check_same_bits(Simulation& a, Simulation& b, int steps) {
  for (int i = 0; i < steps; ++i) {
    a.step();
    b.step();
    REQUIRE(a.state().positions == b.state().positions);
    REQUIRE(a.state().velocities == b.state().velocities);
  }
  CHECK(a.state().time == b.state().time);
}

/// Two sheets, one of them on a ball, the other on it.
Simulation two_sheets(const SolverSettings& settings) {
  Simulation simulation(settings);
  for (const Real height : {0.32, 0.36}) {
    Mesh mesh = grid({.columns = 9, .rows = 9, .plane = Plane::xy});
    mesh.vertices.col(2).array() += height;
    const BodyId sheet = simulation.add_body(std::move(mesh), Mass::area_density(0.2));
    simulation.add(sheet, TriangleStrain{.stiffness = 300});
    simulation.add(sheet, HingeBending{.stiffness = 1e-3});
  }
  simulation.add(SphereCollider{.center = {0.5, 0.5, 0}, .radius = 0.3, .friction = 0.4});
  simulation.set_contact({});
  simulation.add(Gravity{});
  return simulation;
}

/// Constraints and forces of a user's own that have no copy().
class Nothing final : public ConstraintGroup {
 public:
  std::string_view type() const override { return "nothing"; }
  GroupShape shape() const override { return {}; }
  std::span<const Index> stencil() const override { return {}; }
  std::span<const Real> reduction() const override { return {}; }
  std::span<const Real> rest_measure() const override { return {}; }
  Real project(const Positions&, std::span<Real>, Index, Index) const override { return 0; }
};

class NoForce final : public Force {
 public:
  std::string_view type() const override { return "no_force"; }
  void add_to(Positions&, const StateView&, Real) override {}
};

}  // namespace

TEST_CASE("a copy goes on with the same bits, of every type") {
  Simulation simulation = everything({.iterations = 4, .threads = 2}, 7);
  advance(simulation, 5);
  Simulation copy = simulation.copy();
  CHECK(copy.state().step == 5);
  CHECK(copy.group_names() == simulation.group_names());
  CHECK(list_parameters(copy).size() == list_parameters(simulation).size());
  check_same_bits(simulation, copy, 15);
}

TEST_CASE("a copy goes on with the same bits, with BDF2, L-BFGS, substeps and contact") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const Index substeps : {1, 2}) {
      Simulation simulation = two_sheets({.integrator = integrator,
                                          .substeps = substeps,
                                          .iterations = 10,
                                          .acceleration = Acceleration::lbfgs,
                                          .threads = 1});
      advance(simulation, 25);
      CHECK_FALSE(simulation.state().contact.pairs.empty());
      CHECK_FALSE(simulation.contacts().empty());
      Simulation copy = simulation.copy();
      check_same_bits(simulation, copy, 25);
    }
  }
}

TEST_CASE("what is changed in a copy is not changed in the other, and the other way round") {
  Simulation simulation = everything({.iterations = 4, .threads = 1}, 6);
  const Simulation untouched = simulation.copy();
  Simulation other = simulation.copy();
  const GroupId pins = simulation.find_group("position").value();
  const GroupId springs = simulation.find_group("edge_spring").value();
  other.set_target(pins, 0, {1, 2, 3});
  other.set_stiffness(springs, 7);
  other.remove(other.find_force("gravity").value());
  CHECK(simulation.target(pins, 0) == untouched.target(pins, 0));
  CHECK(simulation.stiffness(springs) == untouched.stiffness(springs));
  CHECK(simulation.find_force("gravity").has_value());
  advance(simulation, 5);
  CHECK(untouched.state().step == 0);
  CHECK(untouched.state().positions != simulation.state().positions);
  Simulation again = untouched.copy(), fresh = everything({.iterations = 4, .threads = 1}, 6);
  check_same_bits(again, fresh, 5);
  // What comes next has the same ids in both.
  CHECK(again.add(BodyId{0}, Position{.on = {12}}) == fresh.add(BodyId{0}, Position{.on = {12}}));
}

TEST_CASE("types of one's own are copied by their copy(), and refused by name without it") {
  Simulation simulation({.threads = 1});
  const BodyId cloth = simulation.add_body(grid({.columns = 5, .rows = 5}), Mass::area_density(0.2));
  simulation.add(cloth, EdgeSpring{.stiffness = 100});
  simulation.add(cloth, OutsideBall{});
  simulation.add(Whirl{});
  simulation.add(EggCollider{});
  advance(simulation, 3);
  Simulation copy = simulation.copy();
  check_same_bits(simulation, copy, 5);

  const ForceId force = simulation.add_force(std::make_unique<NoForce>(), "mine");
  CHECK_THROWS_WITH_AS(simulation.copy(),
                       "force 'mine': its type 'no_force' cannot be copied; override copy() in it, or make a second "
                       "simulation as the first was made",
                       Error);
  simulation.remove(force);
  ConstraintSet set;
  set.count = 1;
  set.batches.push_back(std::make_unique<Nothing>());
  simulation.add_set(cloth, std::move(set), "nothing", "none");
  CHECK_THROWS_WITH_AS(simulation.copy(),
                       "group 'none': its type 'nothing' cannot be copied; override copy() in it, or make a second "
                       "simulation as the first was made",
                       Error);
}

}  // namespace test_copy
