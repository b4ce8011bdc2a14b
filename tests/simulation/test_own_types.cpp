// Types of a user's own: what they name can be listed and set like that of the built-in ones.
#include <doctest/doctest.h>

#include "own_types.h"
#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "pliant/simulation/parameters.h"
#include "run.h"

namespace test_own_types {

using namespace pliant;
using namespace pliant_tests;

namespace {

struct OwnTypes {
  Simulation simulation{{.iterations = 5, .threads = 1}};
  BodyId cloth = simulation.add_body(grid({.columns = 5, .rows = 5, .plane = Plane::xy}), Mass::area_density(0.2));
  GroupId ball = simulation.add(cloth, OutsideBall{.center = {0.5, 0.5, -0.1}, .radius = 0.2}, "ball");
  ForceId whirl = simulation.add(Whirl{});
  ColliderId egg = simulation.add(EggCollider{.center = {0, 0, -2}});
};

ConstraintSet no_springs(const BodyView& body, Real stiffness) {
  auto batch = std::make_unique<Batch<OutsideBallProjection>>(stiffness);
  const Real one = 1;
  const std::array<Real, 4> ball = {};
  batch->add({&body.first_vertex, 1}, {&one, 1}, 1, ball);
  ConstraintSet set;
  set.count = 1;
  set.batches.push_back(std::move(batch));
  return set;
}

enum class Unnamed { one, other };

/// With a stiffness of which the builder makes another one, and an option of a kind that nobody knows.
struct OwnStiffness {
  static constexpr ConstraintInfo info{"own_stiffness", "x", "a point", "", ""};
  Real stiffness = 70;
  Unnamed unnamed = Unnamed::one;
  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"stiffness", "N/m", "half of what it is", positive}, self.stiffness);
    field(OptionInfo{"unnamed", "", "without names"}, self.unnamed);
  }
};
ConstraintSet build(const BodyView& body, const OwnStiffness& options) {
  return no_springs(body, 2 * options.stiffness);
}

struct NoStiffness {
  static constexpr ConstraintInfo info{"no_stiffness", "x", "a point", "", ""};
  template <class Self, class Visitor>
  static void visit(Self&, Visitor&&) {}
};
ConstraintSet build(const BodyView& body, const NoStiffness&) {
  return no_springs(body, 9);
}

Vec3 value_of(const Simulation& simulation, const ParameterOwner& owner, const char* option) {
  return parameter(simulation, {owner, option}).value;
}

}  // namespace

TEST_CASE("the options that a constraint of one's own names are listed with unit, kind and range") {
  OwnTypes own;
  const std::vector<Parameter> list = list_parameters(own.simulation, own.ball);
  REQUIRE(list.size() == 5);
  CHECK(list[0].handle.option == "stiffness");
  CHECK(list[0].value[0] == 1e3);
  CHECK(list[0].unit == "N/m");
  CHECK(list[1].kind == ParameterKind::vector);
  CHECK(list[1].value == Vec3(0.5, 0.5, -0.1));
  CHECK(list[2].name == "ball");
  CHECK(list[2].type == "outside_ball");
  CHECK(list[2].range.excludes_min);
  CHECK(list[3].kind == ParameterKind::choice);
  CHECK(list[3].choices == std::vector<std::string>{"as_given", "double"});
  CHECK(list[4].kind == ParameterKind::flag);
}

TEST_CASE("setting them makes the constraints anew") {
  OwnTypes own;
  const auto nearest = [&] {
    const Vec3 center = own.simulation.options<OutsideBall>(own.ball)->center;
    return (own.simulation.state().positions.rowwise() - center.transpose()).rowwise().norm().minCoeff();
  };
  set_parameter(own.simulation, {own.ball, "stiffness"}, {1e5, 0, 0});
  CHECK(value_of(own.simulation, own.ball, "stiffness")[0] == 1e5);
  advance(own.simulation, 20);
  CHECK(nearest() == doctest::Approx(0.2).epsilon(0.05));
  set_parameter(own.simulation, {own.ball, "size"}, {1, 0, 0});
  advance(own.simulation, 20);
  CHECK(nearest() == doctest::Approx(0.4).epsilon(0.05));
  set_parameter(own.simulation, {own.ball, "is_hollow"}, {1, 0, 0});
  const auto options = own.simulation.options<OutsideBall>(own.ball);
  CHECK(options->is_hollow);
  CHECK(options->size == BallSize::double_);
  CHECK(own.simulation.stiffness(own.ball) == 1e5);
  CHECK_THROWS_WITH_AS(set_parameter(own.simulation, {own.ball, "radius"}, {0, 0, 0}),
                       "outside_ball: radius: 0 is out of range; give a finite number above 0 [m]", Error);
  CHECK_THROWS_AS(set_parameter(own.simulation, {own.ball, "passed_over"}, {1, 0, 0}), Error);
}

TEST_CASE("a stiffness that is a number, or none at all: the factor of the group stays to be set") {
  OwnTypes own;
  const GroupId numbered = own.simulation.add(own.cloth, OwnStiffness{});
  CHECK(value_of(own.simulation, numbered, "stiffness")[0] == 70);
  set_parameter(own.simulation, {numbered, "stiffness"}, {80, 0, 0});
  CHECK(own.simulation.options<OwnStiffness>(numbered)->stiffness == 80);
  CHECK(own.simulation.stiffness(numbered) == 160);  // what its builder makes of it
  const GroupId nameless = own.simulation.add(own.cloth, NoStiffness{});
  const std::vector<Parameter> list = list_parameters(own.simulation, nameless);
  REQUIRE(list.size() == 1);
  CHECK(list[0].handle.option == "stiffness");
  CHECK(list[0].value[0] == 9);
  set_parameter(own.simulation, {nameless, "stiffness"}, {5, 0, 0});
  CHECK(own.simulation.stiffness(nameless) == 5);
}

TEST_CASE("forces and colliders of one's own are set as well") {
  OwnTypes own;
  CHECK(list_parameters(own.simulation, own.whirl).size() == 1);
  set_parameter(own.simulation, {own.whirl, "strength"}, {0, 0, 0});
  own.simulation.step();
  CHECK(own.simulation.state().velocities.leftCols(2).cwiseAbs().maxCoeff() < 1e-12);
  set_parameter(own.simulation, {own.whirl, "strength"}, {4, 0, 0});
  own.simulation.step();
  CHECK(own.simulation.state().velocities.leftCols(2).cwiseAbs().maxCoeff() > 1e-2);
  CHECK_THROWS_AS(set_parameter(own.simulation, {own.whirl, "strength"}, {51, 0, 0}), Error);

  set_parameter(own.simulation, {own.egg, "velocity"}, {0, 0, 1});
  const Real before = own.simulation.pose(own.egg).position.z();
  own.simulation.step();
  CHECK(own.simulation.pose(own.egg).position.z() == doctest::Approx(before + 1.0 / 60));
  set_parameter(own.simulation, {own.egg, "height"}, {0.5, 0, 0});
  CHECK(own.simulation.options<EggCollider>(own.egg)->height == 0.5);
  CHECK(own.simulation.collider(own.egg).shape->distance({0, 0, 1}).distance == doctest::Approx(0.5));
}

}  // namespace test_own_types
