// Extreme time steps, stiffnesses and forces: finite, or an error that names the cause.
#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "everything.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/geometry.h"
#include "run.h"

namespace test_robustness {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr std::array<Real, 6> time_steps = {1e-6, 1e-4, 1.0 / 60, 0.3, 1.0, 8.0};

/// Takes steps; everything must stay within a hundred sizes of its scene.
void check_bounded(Simulation& simulation, int steps) {
  for (int step = 0; step < steps; ++step) {
    simulation.step();
    REQUIRE(simulation.state().positions.allFinite());
    REQUIRE(simulation.state().velocities.allFinite());
  }
  CHECK(simulation.state().positions.cwiseAbs().maxCoeff() < 100);
}

Simulation curtain(const SolverSettings& settings, Real soft, Real stiff) {
  Simulation simulation(settings);
  const BodyId body = simulation.add_body(grid({.columns = 8, .rows = 8}), Mass::total(1));
  simulation.add(body, EdgeSpring{.stiffness = stiff});
  simulation.add(body, TriangleStrain{.stiffness = soft});
  simulation.add(body, Bending{.stiffness = soft});
  simulation.add(body, Position{.on = {56, 63}});
  add_gravity(simulation);
  return simulation;
}

Simulation pulled_torus(const SolverSettings& settings, Real soft, Real stiff) {
  Simulation simulation(settings);
  const BodyId body = simulation.add_body(torus({.major_segments = 12, .minor_segments = 6}), Mass::total(1));
  simulation.add(body, EdgeSpring{.stiffness = soft});
  simulation.add(body, HingeBending{.stiffness = soft});
  simulation.add(body, Bending{.stiffness = stiff, .orientation = Orientation::signed_});
  simulation.add(
      body,
      Position{
          .on = {0, 36}, .hold = Hold::soft, .stiffness = stiff, .targets = std::vector<Vec3>{{2, 0, 0}, {-2, 0, 1}}});
  add_gravity(simulation);
  return simulation;
}

Simulation clamped_bar(const SolverSettings& settings, Real soft, Real stiff) {
  Simulation simulation(settings);
  const BodyId body = simulation.add_body(bar({.cells = {5, 2, 2}}), Mass::total(1));
  simulation.add(body, TetrahedronStrain{.stiffness = stiff});
  simulation.add(body, EdgeStrain{.stiffness = soft});
  simulation.add(body, Position{.on = {0, 6, 12, 18}});
  add_gravity(simulation);
  return simulation;
}

}  // namespace

TEST_CASE("time steps from 1e-6 to 8 s, and stiffnesses a million apart") {
  for (const Real time_step : time_steps) {
    for (const auto& stiffnesses : {std::pair(1.0, 1e6), std::pair(1e3, 1e9), std::pair(1e6, 1.0)}) {
      const SolverSettings settings{.time_step = time_step, .iterations = 10, .threads = 1};
      CAPTURE(time_step);
      CAPTURE(stiffnesses.second);
      for (const auto& make : {curtain, pulled_torus, clamped_bar}) {
        Simulation simulation = make(settings, stiffnesses.first, stiffnesses.second);
        check_bounded(simulation, 30);
      }
    }
  }
}

TEST_CASE("bodies crushed to a point, or mirrored, come out of it") {
  for (const Real factor : {0.0, -1.0, 1e-12}) {
    for (const Mesh& mesh : {bar({.cells = {3, 2, 2}}), torus({.major_segments = 10, .minor_segments = 6})}) {
      Simulation simulation({.iterations = 20});
      const BodyId body = simulation.add_body(mesh, Mass::total(1), {.start = factor * mesh.vertices});
      simulation.add(body, EdgeSpring{.stiffness = 1e3});
      simulation.add(body, TetrahedronStrain{.stiffness = 1e4});
      simulation.add(body, TriangleStrain{.stiffness = 1e3});
      simulation.add(body, Bending{.stiffness = 0.1});
      simulation.add(body, HingeBending{.stiffness = 0.1, .orientation = Orientation::signed_});
      check_bounded(simulation, 100);
      if (mesh.tetrahedra.empty()) continue;
      for (const Real volume : tetrahedron_volumes(simulation.state().positions, mesh.tetrahedra)) CHECK(volume > 0);
    }
  }
}

TEST_CASE("a force that is too large is named with its vertex, not with the vertex that suffers first") {
  for (const Start start : {Start::prediction, Start::positions}) {
    Simulation simulation({.start = start});
    const BodyId body = simulation.add_body(grid({.columns = 10, .rows = 10}), Mass::total(1));
    simulation.add(body, EdgeSpring{});
    simulation.add(body, Position{.on = {0}});
    simulation.add(TestForce{.vertices = {50}, .force = Vec3(0, 1e200, 0), .frames = {3, TestForce::forever}});
    advance(simulation, 3);
    const State before = simulation.state();
    const std::string message = error_of([&] { simulation.step(); }, ErrorKind::diverged);
    CAPTURE(message);
    CHECK(contains(message, "step 4"));
    CHECK(contains(message, "vertex 50 "));
    CHECK(contains(message, "test_force"));
    CHECK(simulation.state().positions == before.positions);
    CHECK(simulation.state().step == 3);
  }
}

namespace {

/// Projects to nowhere from the third step on.
class Broken final : public ConstraintGroup {
 public:
  std::string_view type() const override { return "broken"; }
  GroupShape shape() const override { return {1, 1, 1}; }
  std::span<const Index> stencil() const override { return {&vertex_, 1}; }
  std::span<const Real> reduction() const override { return {&one_, 1}; }
  std::span<const Real> rest_measure() const override { return {&one_, 1}; }
  void begin_step(const StateView& state, Real) override { is_broken_ = state.step >= 2; }
  Real project(const Positions&, std::span<Real> out, Index, Index) const override {
    for (std::size_t i = 0; i < 3; ++i) out[i] = is_broken_ ? std::numeric_limits<Real>::quiet_NaN() : 0;
    return 0;
  }

 private:
  Index vertex_ = 0;
  Real one_ = 1;
  bool is_broken_ = false;
};

}  // namespace

TEST_CASE("a constraint that yields no number is named, even when a tolerance is given") {
  for (const Real tolerance : {0.0, 1e9}) {
    Simulation simulation({.tolerance = tolerance});
    const BodyId body = simulation.add_body(mesh_of({{0, 0, 0}}), Mass::total(1));
    ConstraintSet set;
    set.batches.push_back(std::make_unique<Broken>());
    set.count = 1;
    simulation.add_set(body, std::move(set), "broken");
    advance(simulation, 2);
    const std::string message = error_of([&] { simulation.step(); }, ErrorKind::diverged);
    CAPTURE(message);
    CHECK(contains(message, "the broken constraint of 'broken' on vertex 0 of 'body 0'"));
    CHECK(simulation.state().step == 2);
  }
}

TEST_CASE("strange meshes are simulated; what bending leaves out is counted") {
  std::vector<std::pair<Mesh, std::string>> cases;
  cases.emplace_back(moebius_strip(16), "32 on the boundary, 0 non-manifold, 0 without triangles");
  cases.emplace_back(book_of_three_pages(), "9 on the boundary, 3 non-manifold, 0 without triangles");
  cases.emplace_back(joined(moebius_strip(16), book_of_three_pages()), "41 on the boundary, 3 non-manifold");
  cases.emplace_back(joined(sphere({.subdivisions = 1}), mesh_of({{3, 0, 0}})), "1 without triangles");
  for (const auto& [mesh, reason] : cases) {
    Random random;
    Simulation simulation({.iterations = 10});
    const std::vector<Real> masses(static_cast<std::size_t>(mesh.vertex_count()), 0.1);
    const BodyId body = simulation.add_body(mesh, Mass::each(masses), {.name = "odd"});
    simulation.add(body, EdgeSpring{.stiffness = 100});
    simulation.add(body, TriangleStrain{.stiffness = 100});
    simulation.add(body, Bending{.stiffness = 0.01, .orientation = Orientation::signed_});
    simulation.add(body, HingeBending{.stiffness = 0.01, .orientation = Orientation::signed_});
    simulation.add(body, Position{.on = {0}});
    add_gravity(simulation);
    simulation.add(Wind{.velocity = {1, 3, 0}});
    check_bounded(simulation, 60);
    REQUIRE_FALSE(simulation.warnings().empty());
    CAPTURE(simulation.warnings()[0]);
    CHECK(contains(simulation.warnings()[0], "bending on body 'odd': left out at"));
    CHECK(contains(simulation.warnings()[0], reason));
  }
}

TEST_CASE("a vertex without elements falls freely beside its body") {
  Simulation simulation({.iterations = 3});
  const Mesh mesh = joined(sphere({.subdivisions = 1}), mesh_of({{3, 0, 0}}));
  std::vector<Real> masses(static_cast<std::size_t>(mesh.vertex_count()), 0.1);
  masses.back() = 7;
  const BodyId body = simulation.add_body(mesh, Mass::each(masses));
  simulation.add(body, EdgeSpring{});
  simulation.add(body, Position{.on = {0}});
  add_gravity(simulation);
  advance(simulation, 60);
  CHECK(simulation.state().positions(mesh.vertex_count() - 1, 2) ==
        doctest::Approx(-9.81 / 3600 * 60 * 61 / 2).epsilon(1e-12));
}

}  // namespace test_robustness
