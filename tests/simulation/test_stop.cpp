// A step that is given up leaves everything as it was, and the same step taken again has the same bits.
#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant/pliant.h"
#include "pliant/timeline/timeline.h"

namespace test_stop {

using namespace pliant;
using namespace pliant_tests;

namespace {

struct Cloth {
  explicit Cloth(Index iterations) {
    simulation = Simulation({.iterations = iterations, .tolerance = 0, .threads = 1});
    body = simulation.add_body(grid({.columns = 5, .rows = 5}), Mass::total(1));
    springs = simulation.add(body, EdgeSpring{.stiffness = 100});
    simulation.add(body, Position{.on = {0, 4}});
    simulation.add(Gravity{});
    simulation.add(body, Wind{.velocity = {0, 3, 0}, .gust_strength = 0.5});
  }
  Simulation simulation;
  BodyId body{};
  GroupId springs{};
};

}  // namespace

TEST_CASE("a step is given up before the iteration in which that is asked") {
  Cloth whole(20);
  Cloth stopped(20);
  for (int i = 0; i < 3; ++i) whole.simulation.step();
  stopped.simulation.step();
  const State before = stopped.simulation.state();
  int asked = 0;
  stopped.simulation.set_stop([&] { return ++asked > 7; });
  CHECK_THROWS_WITH_AS(stopped.simulation.step(), doctest::Contains("step 2: given up"), Error);
  CHECK(asked == 8);
  CHECK(stopped.simulation.state().positions == before.positions);
  CHECK(stopped.simulation.state().velocities == before.velocities);
  CHECK(stopped.simulation.state().step == before.step);
  CHECK(stopped.simulation.state().time == before.time);

  stopped.simulation.set_stop({});
  stopped.simulation.step();
  stopped.simulation.step();
  CHECK(asked == 8);
  CHECK(stopped.simulation.state().positions == whole.simulation.state().positions);
  CHECK(stopped.simulation.state().velocities == whole.simulation.state().velocities);
}

TEST_CASE("a group that was added since has no energy yet") {
  Cloth cloth(5);
  for (int i = 0; i < 3; ++i) cloth.simulation.step();
  cloth.simulation.evaluate();
  CHECK(cloth.simulation.elastic_energy(cloth.springs) > 0);
  cloth.simulation.remove(cloth.springs);
  const GroupId added = cloth.simulation.add(cloth.body, EdgeSpring{.stiffness = 7});
  CHECK(cloth.simulation.elastic_energy(added) == 0);
  cloth.simulation.evaluate();
  CHECK(cloth.simulation.elastic_energy(added) > 0);
}

TEST_CASE("a step of a thousand million iterations can be given up") {
  Cloth cloth(1'000'000'000);
  int asked = 0;
  cloth.simulation.set_stop([&] { return ++asked > 1000; });
  try {
    cloth.simulation.step();
    FAIL("the step ended");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::interrupted);
  }
  CHECK(cloth.simulation.state().step == 0);
}

TEST_CASE("a step that is given up takes back the events of its step") {
  Cloth cloth(5);
  Timeline timeline;
  timeline.add(When::at_step(1), [&](Simulation& s) { s.set_stiffness(cloth.springs, 900); });
  timeline.step(cloth.simulation);
  cloth.simulation.set_stop([] { return true; });
  CHECK_THROWS_AS(timeline.step(cloth.simulation), Error);
  CHECK(cloth.simulation.stiffness(cloth.springs) == 100);
  CHECK(!timeline.is_over());
  cloth.simulation.set_stop({});
  timeline.step(cloth.simulation);
  CHECK(cloth.simulation.stiffness(cloth.springs) == 900);
}

}  // namespace test_stop
