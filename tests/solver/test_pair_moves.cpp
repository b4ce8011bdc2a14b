// Moves from iterate to iterate that lead far: nothing passes through anything on the way, so the sides on which
// surfaces lie stay as they are.
#include <algorithm>

#include <doctest/doctest.h>

#include "tests/pairs/pair_scene.h"
#include "tests/pairs/parts.h"
#include "tests/scene/whole_scenes.h"

namespace test_pair_moves {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real radius = 0.01;
constexpr Real time_step = 0.01;

/// The first iterate is where the step begins, so that the moves are long.
Simulation simulation_of(Index iterations) {
  Simulation simulation;
  simulation.set_settings({.time_step = time_step, .iterations = iterations, .start = Start::positions, .threads = 1});
  simulation.set_contact({.distance = radius, .surfaces = true});
  return simulation;
}

/// A stiff square sheet that falls.
BodyId add_falling(Simulation& simulation, const Vec3& corner, Real area_density, Real speed) {
  const Mesh mesh = sheet_mesh(3, 0.2, corner);
  const Positions velocities = Vec3(0, 0, -speed).transpose().replicate(mesh.vertex_count(), 1);
  const BodyId body = simulation.add_body(mesh, Mass::area_density(area_density), {.velocities = velocities});
  simulation.add(body, TriangleStrain{.stiffness = 1e3});
  simulation.add(body, Bending{.stiffness = 1e-3});
  return body;
}

Real lowest(const Simulation& simulation, BodyId id) {
  const Body& body = simulation.body(id);
  return simulation.state().positions.middleRows(body.first_vertex, body.mesh.vertex_count()).col(2).minCoeff();
}

Real highest(const Simulation& simulation, BodyId id) {
  const Body& body = simulation.body(id);
  return simulation.state().positions.middleRows(body.first_vertex, body.mesh.vertex_count()).col(2).maxCoeff();
}

}  // namespace

// The tip of one triangle lies over the middle of another, at rest so near that it pushes only from there on; it starts
// at 1.25 r, and both want to go 0.85 r towards each other, less than r each.
TEST_CASE("pair moves: parts that are near each other at rest do not pass through each other from afar") {
  Mesh mesh;
  mesh.vertices.resize(6, 3);
  mesh.vertices << -0.1, -0.1, 0, 0.1, -0.1, 0, 0, 0.1, 0,  //
      0, 0, 0.05 * radius, -0.03, 0, 0.1, 0.03, 0, 0.1;
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  Positions start = mesh.vertices;
  start.bottomRows(3).col(2).array() += 1.2 * radius;
  Positions velocities = Positions::Zero(6, 3);
  velocities.topRows(3).col(2).setConstant(0.85 * radius / time_step);
  velocities.bottomRows(3).col(2).setConstant(-0.85 * radius / time_step);
  Simulation simulation = simulation_of(10);
  const BodyId body = simulation.add_body(mesh, Mass::per_vertex(1), {.start = start, .velocities = velocities});
  simulation.add(body, EdgeSpring{.stiffness = 1});
  for (int i = 0; i < 3; ++i) {
    CHECK(simulation.step().contact.shortened > 0);
    CHECK(count_crossings(simulation) == 0);
  }
}

// A heavy sheet that hits the floor elsewhere makes the plain move of all so short that both others are moved as a
// whole: the lower one to where the floor begins to push it, so that its motion is taken back, and the upper one to
// where the lower one was.
TEST_CASE("pair moves: a body that is moved as a whole does not pass through one that could not be") {
  for (const Index iterations : {1, 3}) {
    for (const Real mass : {100.0, 1000.0}) {
      CAPTURE(iterations);
      CAPTURE(mass);
      Simulation simulation = simulation_of(iterations);
      simulation.add(PlaneCollider{});
      const Real speed = 5 * radius / time_step;
      const BodyId below = add_falling(simulation, {0, 0, 5.3 * radius}, 1, speed);
      const BodyId above = add_falling(simulation, {0.03, 0.02, 7.8 * radius}, 1, speed);
      add_falling(simulation, {2, 2, 0.95 * radius}, mass, 1);
      for (int i = 0; i < 4; ++i) {
        simulation.step();
        CHECK(count_crossings(simulation) == 0);
        CHECK(lowest(simulation, above) > highest(simulation, below));
      }
    }
  }
}

// Vertices that stop where their neighbors go on would stretch what is between them, and a pinned pole has no mass that
// matters: a strip whose halves met once gained a hundred times the energy that it had, and later it stopped in the
// air.
TEST_CASE("pair moves: halves of a strip that meet under a pole gain no energy") {
  Simulation simulation({.iterations = 10, .threads = 1});
  simulation.add(Gravity{});
  Mesh pole = cylinder({.segments = 12, .rows = 5, .radius = 0.05, .height = 0.4});
  for (Index v = 0; v < pole.vertex_count(); ++v) {
    pole.vertices.row(v) = Vec3(pole.vertices(v, 0), 0.2 - pole.vertices(v, 2), pole.vertices(v, 1)).transpose();
  }
  simulation.add(simulation.add_body(pole, Mass::per_vertex(1)), Position{});
  Mesh strip = grid({.columns = 31, .rows = 7, .size = {1.2, 0.24}, .plane = Plane::xy});
  strip.vertices.rowwise() += Vec3(-0.6, -0.12, 0.07).transpose();
  const BodyId body = add_cloth(simulation, strip);
  simulation.set_contact({.friction = 0.6, .surfaces = true});
  const auto energy_of = [&] {
    Real sum = simulation.evaluate().elastic;
    const State& state = simulation.state();
    for (Index v = simulation.vertex(body, 0); v < state.vertex_count(); ++v) {
      sum += state.masses[static_cast<std::size_t>(v)] *
             (9.81 * state.positions(v, 2) + state.velocities.row(v).squaredNorm() / 2);
    }
    return sum;
  };
  Real before = energy_of();
  Real fastest = 0;
  for (int i = 0; i < (runs_whole_scenes ? 90 : 3); ++i) {
    simulation.step();
    const Real now = energy_of();
    CHECK(now - before < 0.005);
    before = now;
    fastest = std::max(fastest, rms_speed(simulation));
  }
  if (runs_whole_scenes) CHECK(fastest > 1);
  CHECK(count_crossings(simulation) == 0);
}

}  // namespace test_pair_moves
