// A step that would leave the finite numbers is refused, names the culprit, and leaves the state as it was.
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "pliant/constraints/batch.h"
#include "pliant/core/error.h"
#include "pliant/pliant.h"

namespace test_divergence {

using namespace pliant;

namespace {

/// Becomes NaN once its vertex has fallen below the first field.
struct Brittle {
  static constexpr std::string_view name = "brittle";
  static constexpr int vertices = 1;
  static constexpr int rows = 1;
  static constexpr int fields = 1;
  static constexpr bool translation_invariant = false;
  static void project(const Real* field, const Real* z, Real* p) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = z[axis];
    if (z[2] < field[0]) p[0] = std::numeric_limits<Real>::quiet_NaN();
  }
};

Simulation falling_with_culprit(Index iterations, Real tolerance, Index culprit) {
  Simulation simulation({.iterations = iterations, .tolerance = tolerance});
  const BodyId body = simulation.add_body(grid({.columns = 4, .rows = 4}), Mass::per_vertex(1));
  simulation.add(body, EdgeSpring{});
  auto batch = std::make_unique<Batch<Brittle>>(1e3);
  const Real one = 1;
  const Real height = simulation.state().positions(culprit, 2) - 0.1;
  batch->add({&culprit, 1}, {&one, 1}, 1, {&height, 1});
  ConstraintSet set;
  set.count = 1;
  set.batches.push_back(std::move(batch));
  simulation.add_set(body, std::move(set), "brittle");
  simulation.add(Gravity{});
  return simulation;
}

std::string refusal(Simulation& simulation) {
  for (int i = 0; i < 60; ++i) {
    const Positions before = simulation.state().positions;
    const Positions velocities = simulation.state().velocities;
    try {
      simulation.step();
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::diverged);
      CHECK(simulation.state().positions == before);
      CHECK(simulation.state().velocities == velocities);
      CHECK(simulation.state().step == i);
      return error.what();
    }
    CHECK(simulation.state().positions.allFinite());
  }
  return "";
}

}  // namespace

TEST_CASE("a constraint that returns NaN is named, whatever the iterations and the tolerance") {
  for (const Index iterations : {1, 10}) {
    for (const Real tolerance : {0.0, 1e6}) {
      CAPTURE(iterations);
      CAPTURE(tolerance);
      Simulation simulation = falling_with_culprit(iterations, tolerance, 9);
      const std::string message = refusal(simulation);
      CHECK(message.find("the brittle constraint of 'brittle' on vertex 9 of 'body 0'") != message.npos);
      CHECK(message.find("vertex 9 ") != message.npos);
    }
  }
}

namespace {

struct Nowhere {
  static constexpr std::string_view name = "nowhere";
  static constexpr int vertices = dynamic_vertices;
  static constexpr int rows = 1;
  static constexpr int fields = 0;
  static constexpr bool translation_invariant = false;
  static void project(const Real*, const Real*, Real* p) { std::fill_n(p, 3, std::numeric_limits<Real>::quiet_NaN()); }
};

/// The message of a step in which a constraint on these vertices of the second body has no finite force.
std::string message_on(Mesh mesh, std::vector<Index> vertices) {
  Simulation simulation;
  simulation.add_body(grid({.columns = 2, .rows = 2}), Mass::total(1));
  const BodyId body = simulation.add_body(std::move(mesh), Mass::total(1), {.name = "sail"});
  for (Index& vertex : vertices) vertex = simulation.vertex(body, vertex);
  auto batch = std::make_unique<Batch<Nowhere>>(1, static_cast<int>(vertices.size()));
  const std::vector<Real> ones(vertices.size(), 1);
  batch->add(vertices, ones, 1, {});
  ConstraintSet set;
  set.count = 1;
  set.batches.push_back(std::move(batch));
  simulation.add_set(body, std::move(set), "nowhere", "stretch");
  return refusal(simulation);
}

}  // namespace

TEST_CASE("a divergence names body, group and element by the body's own numbers") {
  const Mesh sheet = grid({.columns = 3, .rows = 3});
  const auto [a, b, c] = sheet.triangles[5];
  const auto says = [](const std::string& message, const std::string& words) {
    CAPTURE(message);
    CHECK(message.find(words) != std::string::npos);
  };
  says(message_on(sheet, {c, a, b}), "the nowhere constraint of 'stretch' on triangle 5 of 'sail' has a force");
  says(message_on(sheet, {c, a, b}), "vertex " + std::to_string(c) + " of 'sail' would leave");
  says(message_on(sheet, {4}), "on vertex 4 of 'sail'");
  says(message_on(sheet, {4, 1}), "on the edge from vertex 4 to vertex 1 of 'sail'");
  says(message_on(sheet, {8, 0, 1, 2, 3}), "on vertices 8, 0, 1, 2 and others of 'sail'");
  says(message_on(chain({.links = 3}), {2, 1}), "on edge 1 of 'sail'");
  const Mesh block = bar({.cells = {1, 1, 1}});
  const auto [p, q, r, s] = block.tetrahedra[2];
  says(message_on(block, {s, r, p, q}), "on tetrahedron 2 of 'sail'");
}

TEST_CASE("a force that grows without bound says itself what helps") {
  struct Endless final : Force {
    std::string_view type() const override { return "endless"; }
    void add_to(Positions& forces, const StateView&, Real) override { forces.setConstant(1e200); }
    std::string remedy() const override { return "give it an end"; }
  };
  Simulation simulation;
  const BodyId body = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::per_vertex(1));
  simulation.add(body, EdgeSpring{});
  simulation.add_force(std::make_unique<Endless>());
  CHECK(refusal(simulation).find("the force 'endless' on it has grown without bound; give it an end") !=
        std::string::npos);
}

TEST_CASE("a simulation goes on after what broke it is gone") {
  Simulation simulation = falling_with_culprit(10, 0, 5);
  CHECK(refusal(simulation) != "");
  CHECK(simulation.evaluate().inertia == 0);  // no prediction of the refused step is left
  for (const auto& [id, group] : simulation.groups()) {
    if (group.type != "brittle") continue;
    simulation.remove(id);
    break;
  }
  for (int i = 0; i < 60; ++i) simulation.step();
  CHECK(simulation.state().positions.allFinite());
}

TEST_CASE("groups that do not keep to their shape are refused by name") {
  Simulation simulation;
  const BodyId body = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::per_vertex(1));
  const auto add = [&](std::vector<Index> stencil, Real measure) {
    auto batch = std::make_unique<Batch<EdgeSpringProjection>>(1);
    const std::array<Real, 2> difference = {-1, 1};
    const Real length = 1;
    batch->add(stencil, difference, measure, {&length, 1});
    ConstraintSet set;
    set.count = 1;
    set.batches.push_back(std::move(batch));
    simulation.add_set(body, std::move(set), "mine");
  };
  CHECK_NOTHROW(add({0, 1}, 1));
  CHECK_THROWS_WITH_AS(add({0, 9}, 1),
                       "mine on body 'body 0': constraint 0: vertex 9 is out of range; there are vertices 0 to 8",
                       Error);
  CHECK_THROWS_WITH_AS(add({4, 4}, 1),
                       "mine on body 'body 0': constraint 0 names vertex 4 twice; its vertices must differ", Error);
  for (const Real measure : {0.0, -1.0, std::numeric_limits<Real>::infinity(), std::nan("")}) {
    CHECK_THROWS_AS(add({0, 1}, measure), Error);
  }
  CHECK_THROWS_AS(add({0, 1, 2}, 1), Error);
}

TEST_CASE("a vertex is pinned at one place only") {
  Simulation simulation;
  const BodyId body = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::per_vertex(1));
  simulation.add(body, Position{.on = {0, 1}}, "pins");
  CHECK_THROWS_WITH_AS(simulation.add(body, Position{.on = {1, 2}}, "more"),
                       "more on body 'body 0': vertex 1 is already pinned by 'pins'; leave it out of one of the two",
                       Error);
  CHECK_THROWS_AS(simulation.add(body, Position{.stencils = {{3}, {3}}}), Error);
  CHECK_NOTHROW(simulation.add(body, Position{.on = {1, 2}, .hold = Hold::soft}));
}

TEST_CASE("an evaluation between a changed time step and a failed step does not reach the next step") {
  struct Throwing final : Force {
    bool throws = false;
    std::string_view type() const override { return "throwing"; }
    void add_to(Positions&, const StateView&, Real) override {
      if (throws) fail_input("as asked");
    }
  };
  const auto make = [](std::unique_ptr<Throwing> force) {
    Simulation simulation({.time_step = 1.0 / 60});
    const BodyId body = simulation.add_body(grid({.columns = 5, .rows = 5}), Mass::per_vertex(1));
    simulation.add(body, EdgeSpring{});
    simulation.add(body, Position{.on = {20, 24}});
    simulation.add(Gravity{});
    simulation.add_force(std::move(force));
    simulation.step();
    simulation.set_settings({.time_step = 0.1});
    return simulation;
  };
  auto force = std::make_unique<Throwing>();
  Throwing& switchable = *force;
  Simulation disturbed = make(std::move(force));
  switchable.throws = true;
  CHECK_THROWS_AS(disturbed.step(), Error);
  switchable.throws = false;
  disturbed.evaluate();
  disturbed.step();
  Simulation calm = make(std::make_unique<Throwing>());
  calm.step();
  CHECK(disturbed.state().positions == calm.state().positions);
}

}  // namespace test_divergence
