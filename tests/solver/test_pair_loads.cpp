// Surfaces that touch carry what they should: loads through a stack, friction, momentum.
#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "tests/pairs/body_scenes.h"
#include "tests/pairs/cloth_scenes.h"
#include "tests/scene/whole_scenes.h"

namespace test_pair_loads {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Index layer_count = 5;

Vec3 momentum(const Simulation& simulation) {
  const State& state = simulation.state();
  Vec3 sum = Vec3::Zero();
  for (Index v = 0; v < state.vertex_count(); ++v) sum += state.masses[at(v)] * row(state.velocities, v);
  return sum;
}

Real weight_of(const Simulation& simulation) {
  Real mass = 0;
  for (const Real each : simulation.state().masses) mass += each;
  return 9.81 * mass;
}

/// Mean of the coordinate z of a body [m].
Real mean_height(const Simulation& simulation, Index body) {
  const Body& it = simulation.bodies()[at(body)];
  return simulation.state().positions.middleRows(it.first_vertex, it.mesh.vertex_count()).col(2).mean();
}

struct RestedLayers {
  Simulation simulation;
  Real carried = 0;  // by the plane, over the weight: mean of the last steps
};

RestedLayers rested_layers(Real shift) {
  PairOptions options;
  options.settings.iterations = 20;
  options.settings.damping = 5;
  PairScene scene = layers_free(options, {.count = layer_count, .shift = shift});
  constexpr int counted = 40;
  Real carried = 0;
  for (int i = 0; i < 120; ++i) {
    scene.step();
    if (i < 120 - counted) continue;
    for (const ContactPoint& each : scene.simulation.contacts()) carried += each.force.z();
  }
  const Real weight = weight_of(scene.simulation);
  return {std::move(scene.simulation), carried / counted / weight};
}

/// Gaps between the layers over r, and what the plane carries over the weight.
void check_layers(const RestedLayers& layers) {
  const Simulation& simulation = layers.simulation;
  const Real distance = simulation.contact().distance;
  Real below = 0;
  for (Index layer = 0; layer < layer_count; ++layer) {
    CAPTURE(layer);
    const Real height = mean_height(simulation, layer);
    CHECK((height - below) / distance == doctest::Approx(1).epsilon(0.05));
    below = height;
  }
  CHECK(layers.carried == doctest::Approx(1).epsilon(1e-3));
}

}  // namespace

TEST_CASE("pair loads: five layers rest a contact distance apart, each vertex with its share" *
          doctest::skip(!runs_whole_scenes)) {
  const RestedLayers layers = rested_layers(0);
  check_layers(layers);
  const Simulation& simulation = layers.simulation;
  CHECK(simulation.state().velocities.rowwise().norm().maxCoeff() < 1e-3);
  // All layers lie exactly above each other, so a vertex of the lowest carries those of its number.
  const Body& lowest = simulation.bodies()[0];
  std::vector<Real> carried(at(lowest.mesh.vertex_count()));
  for (const ContactPoint& each : simulation.contacts()) {
    REQUIRE(each.vertex < lowest.mesh.vertex_count());
    carried[at(each.vertex)] += each.force.z();
  }
  Real worst = 0;
  for (Index v = 0; v < lowest.mesh.vertex_count(); ++v) {
    const Real share = layer_count * 9.81 * simulation.state().masses[at(v)];
    worst = std::max(worst, std::abs(carried[at(v)] / share - 1));
  }
  CHECK(worst < 0.02);
}

TEST_CASE("pair loads: layers that are shifted against each other rest a contact distance apart" *
          doctest::skip(!runs_whole_scenes)) {
  check_layers(rested_layers(0.37));
}

TEST_CASE("pair loads: a sheet at 16 degrees sticks to a sheet, one at 30 degrees slides as Coulomb says" *
          doctest::skip(!runs_whole_scenes)) {
  PairOptions options;
  options.vertices = 1000;
  options.settings.iterations = 20;
  for (const Real degrees : {16.0, 30.0}) {
    CAPTURE(degrees);
    SlopeScene slope = slope2(options, degrees);
    constexpr Index steps = 60;
    for (Index i = 0; i < steps; ++i) slope.scene.step();
    const Real exact = slope.exact_way(steps);
    if (degrees < 16.7) {
      CHECK(exact == 0);
      CHECK(std::abs(slope.way()) < 1e-3);
    } else {
      CHECK(exact == doctest::Approx(1.198).epsilon(1e-3));
      CHECK(slope.way() / exact == doctest::Approx(1).epsilon(0.02));
    }
  }
}

TEST_CASE("pair loads: without friction a sheet slides on a sheet as it falls" * doctest::skip(!runs_whole_scenes)) {
  PairOptions options;
  options.vertices = 350;
  options.settings.iterations = 20;
  options.contact.friction = 0;
  SlopeScene slope = slope2(options, 16);
  constexpr Index steps = 40;
  for (Index i = 0; i < steps; ++i) slope.scene.step();
  CHECK(slope.way() / slope.exact_way(steps) == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("pair loads: a sheet that slides on a free one gives it its momentum, less what the floor takes") {
  PairOptions options;
  options.settings.iterations = 20;
  PairScene scene = two_layers_free(options);
  const Real begin = momentum(scene.simulation).x();
  scene.step();
  const Real after = momentum(scene.simulation).x();
  // Both surfaces rub at their limit or less: the floor takes at most μ times the weight.
  const Real most = 0.3 * weight_of(scene.simulation) / 60;
  CHECK(after < begin);
  CHECK(after > begin - 1.05 * most);
  if (!runs_whole_scenes) return;
  for (int i = 0; i < 119; ++i) scene.step();
  CHECK(std::abs(momentum(scene.simulation).x()) < 1e-3 * begin);
}

}  // namespace test_pair_loads
