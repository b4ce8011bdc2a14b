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

TEST_CASE("pair loads: two free bodies that collide keep their momentum" * doctest::skip(!runs_whole_scenes)) {
  for (const Real friction : {0.0, 0.3}) {
    CAPTURE(friction);
    PairOptions options;
    options.settings.iterations = 400;
    options.settings.tolerance = 1e-7;
    options.contact.friction = friction;
    PairScene scene = collision_of_two(options);
    Real scale = 0;  // of one of the two
    for (const Real mass : scene.simulation.state().masses) scale += mass / 2;
    const Vec3 begin = momentum(scene.simulation);
    Index touching_exactly = 0;
    Real worst = 0, touched = 0;
    for (Index i = 0; i < scene.frames(); ++i) {
      const Vec3 before = momentum(scene.simulation);
      const StepReport report = scene.step();
      touched += report.contact.active;
      if (!report.reached_tolerance || report.contact.shortened > 0) continue;
      touching_exactly += report.contact.active > 0 ? 1 : 0;
      worst = std::max(worst, (momentum(scene.simulation) - before).norm() / scale);
    }
    CHECK(touched > 0);
    CHECK(touching_exactly > 0);
    CHECK(worst < 1e-9);
    CHECK((momentum(scene.simulation) - begin).norm() / scale < 0.01);
    // They do not fly on through each other; without friction they keep what goes along the faces that met.
    const Body& second = scene.simulation.bodies()[1];
    const Positions& v = scene.simulation.state().velocities;
    CHECK(v.middleRows(second.first_vertex, second.mesh.vertex_count()).col(0).mean() > -0.3);
    CHECK(count_crossings(scene.simulation) == 0);
  }
}

namespace {

/// What a collision of two free bodies has lost, over the momentum of one of them.
struct Loss {
  Real reported = 0;
  Real not_reported = 0;  // the most of a step
};

Loss loss_of_collision(const PairOptions& options) {
  PairScene scene = collision_of_two(options);
  const bool is_bdf2 = options.settings.integrator == Integrator::bdf2;
  Real scale = 0;
  for (const Real mass : scene.simulation.state().masses) scale += mass / 2;  // at 1 m/s
  Vec3 before = momentum(scene.simulation);
  Vec3 last = Vec3::Zero();
  Vec3 lost = Vec3::Zero();
  Loss loss;
  for (Index i = 0; i < (runs_whole_scenes ? scene.frames() : 3); ++i) {
    const ContactReport contact = scene.step().contact;
    const Vec3 change = momentum(scene.simulation) - before;
    const Vec3 carried = is_bdf2 ? Vec3(last / 3) : Vec3(Vec3::Zero());  // from the step before
    loss.not_reported = std::max(loss.not_reported, (change - carried + contact.momentum_lost).norm() / scale);
    lost += contact.momentum_lost;
    before += change;
    last = change;
  }
  loss.reported = lost.norm() / scale;
  return loss;
}

}  // namespace

TEST_CASE("pair loads: the report tells what momentum a collision loses") {
  for (const Index iterations : {3, 10}) {
    for (const Index substeps : {1, 3}) {
      PairOptions options;
      options.settings.iterations = iterations;
      options.settings.substeps = substeps;
      const Loss loss = loss_of_collision(options);
      CHECK(loss.not_reported < 1e-9);
      if (runs_whole_scenes) CHECK(loss.reported > 1e-6);
    }
  }
  PairOptions options;
  options.settings.integrator = Integrator::bdf2;
  CHECK(loss_of_collision(options).not_reported < 1e-9);
}

TEST_CASE("pair loads: a collision loses less than a hundredth of its momentum with 20 iterations" *
          doctest::skip(!runs_whole_scenes)) {
  std::vector<Real> losses;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PairOptions options;
    options.settings.iterations = 20;
    options.seed = seed;
    losses.push_back(loss_of_collision(options).reported);
  }
  std::ranges::sort(losses);
  CHECK(losses[2] < 0.01);
  CHECK(losses[4] < 0.05);
}

}  // namespace test_pair_loads
