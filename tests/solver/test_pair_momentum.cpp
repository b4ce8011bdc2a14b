// Free bodies that push each other keep their momentum, whatever the iterations have left of the balance of each.
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "tests/core/random.h"
#include "tests/pairs/body_scenes.h"
#include "tests/pairs/parts.h"
#include "tests/scene/whole_scenes.h"

namespace test_pair_momentum {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// Sums over all vertices.
struct Momenta {
  Vec3 linear = Vec3::Zero();   // [N s]
  Vec3 angular = Vec3::Zero();  // about the origin [N m s]
  Vec3 turning = Vec3::Zero();  // Σ v × m v₀ with v₀ before the step [N m]
};

Momenta momenta(const Simulation& simulation, const Positions& velocities_before) {
  const State& state = simulation.state();
  Momenta sum;
  for (Index v = 0; v < state.vertex_count(); ++v) {
    const Vec3 momentum = state.masses[at(v)] * row(state.velocities, v);
    sum.linear += momentum;
    sum.angular += row(state.positions, v).cross(momentum);
    sum.turning += momentum.cross(row(velocities_before, v));
  }
  return sum;
}

Momenta momenta(const Simulation& simulation) {
  return momenta(simulation, simulation.state().velocities);
}

Vec3 momentum(const Simulation& simulation) {
  return momenta(simulation).linear;
}

/// Half of all mass [kg]: times 1 m/s the momentum of one of two bodies that meet.
Real half_mass(const Simulation& simulation) {
  Real mass = 0;
  for (const Real each : simulation.state().masses) mass += each / 2;
  return mass;
}

/// What a collision of two free bodies of 0.2 m has lost, over the momentum of one of them.
struct Loss {
  Real reported = 0;      // sum over its steps
  Real not_reported = 0;  // the most of a step
  Real angular = 0;       // sum over its steps of one substep of implicit Euler; with 0.2 m as the arm
  Index touching = 0;     // steps
};

/// L − L₀ = h Σ v × m v₀ is the law of implicit Euler, of which the vertices go on with the velocities that they get.
Loss loss_of(PairScene scene) {
  const Real h = scene.simulation.settings().time_step;
  const bool is_bdf2 = scene.simulation.settings().integrator == Integrator::bdf2;
  const Real scale = half_mass(scene.simulation);
  Momenta before = momenta(scene.simulation);
  Vec3 last = Vec3::Zero();
  Loss loss;
  for (Index i = 0; i < (runs_whole_scenes ? scene.frames() : 3); ++i) {
    const Positions velocities = scene.simulation.state().velocities;
    const ContactReport contact = scene.step().contact;
    const Momenta now = momenta(scene.simulation, velocities);
    const Vec3 change = now.linear - before.linear;
    const Vec3 carried = is_bdf2 ? Vec3(last / 3) : Vec3(Vec3::Zero());  // from the step before
    loss.not_reported = std::max(loss.not_reported, (change - carried + contact.momentum_lost).norm() / scale);
    loss.reported += contact.momentum_lost.norm() / scale;
    loss.angular += (now.angular - before.angular - h * now.turning).norm() / (0.2 * scale);
    loss.touching += contact.active > 0 ? 1 : 0;
    before = now;
    last = change;
  }
  return loss;
}

/// Whether colliders push more somewhere than they did before the step: κ of a vertex, 1 where there is none.
bool has_grown(const std::vector<Real>& before, const std::vector<Real>& after) {
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i] > (before.empty() ? 1 : before[i])) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("pair momentum: two free bodies that collide keep their momentum" * doctest::skip(!runs_whole_scenes)) {
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

TEST_CASE("pair momentum: a collision keeps it in ten iterations, the angular one too") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const Real friction : {0.0, 0.3}) {
      CAPTURE(seed);
      CAPTURE(friction);
      PairOptions options{.contact = {.friction = friction, .surfaces = true}, .seed = seed};
      const Loss loss = loss_of(collision_of_two(options));
      CHECK(loss.reported < 1e-5);
      // Friction acts on both surfaces up to r apart, a twentieth of the size: μ times that of what they push.
      CHECK(loss.angular < (friction > 0 ? 0.03 : 2e-3));
      CHECK(loss.touching > (runs_whole_scenes ? 3 : -1));
    }
  }
}

TEST_CASE("pair momentum: bodies that are too many to be solved for at once keep it as well") {
  PairScene scene{empty_simulation({}, Vec3::Zero()), 1};
  constexpr Index count = 210;
  constexpr Real size = 0.1;
  Random random(7);
  for (Index i = 0; i < count; ++i) {
    Mesh box = cube_mesh(1, size);
    box.vertices.rowwise() +=
        Vec3(1.2 * size * i, random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02)).transpose();
    add_rubber(scene.simulation, box, 1e5, {0.4 * (count / 2 - i) * size, 0, 0});
  }
  finish(scene, {.distance_scale = 1});
  const Vec3 begin = momentum(scene.simulation);
  const Real scale = half_mass(scene.simulation);
  Index most_active = 0;
  for (int i = 0; i < (runs_whole_scenes ? 30 : 2); ++i) {
    most_active = std::max(most_active, scene.step().contact.active);
  }
  CHECK((momentum(scene.simulation) - begin).norm() / scale < 1e-5);
  if (runs_whole_scenes) CHECK(most_active > count);
}

TEST_CASE("pair momentum: no motion raises the objective") {
  const auto has_risen = [](Real from, Real to) { return to > from * (1 + 1e-12) + 1e-13; };
  for (const char* name : {"collision", "layers_free", "stack", "pile"}) {
    for (const Real friction : {0.0, 0.3}) {
      CAPTURE(name);
      CAPTURE(friction);
      PairScene scene = make_pair_scene(name, {.contact = {.friction = friction, .surfaces = true}, .speed = 1});
      Index risen = 0, forgiven = 0, fallen_at_end = 0, touching = 0;
      for (int i = 0; i < (runs_whole_scenes ? 60 : 2); ++i) {
        const std::vector<Real> before = scene.simulation.state().contact.stiffening;
        touching += scene.step().contact.active > 0 ? 1 : 0;
        Index risen_now = 0;
        const std::span<const Real> history = scene.simulation.objective_history();
        for (std::size_t k = 1; k < history.size(); ++k) {
          if (k == 3 || k == 8) continue;  // friction is refreshed there, which makes another objective
          risen_now += has_risen(history[k - 1], history[k]) ? 1 : 0;
        }
        if (risen_now == 1 && has_grown(before, scene.simulation.state().contact.stiffening)) {
          ++forgiven;  // a collider that is made to push more within the step makes another one as well
        } else {
          risen += risen_now;
        }
        if (friction > 0) continue;  // what it remembers is that of the next step by now
        const Real end = scene.simulation.evaluate().objective();
        risen += has_risen(history.back(), end) ? 1 : 0;
        fallen_at_end += end < history.back() ? 1 : 0;
      }
      CHECK(risen == 0);
      CHECK(forgiven <= 1);
      if (!runs_whole_scenes) continue;
      CHECK(touching > 4);
      if (friction == 0) CHECK(fallen_at_end > 50);
    }
  }
}

TEST_CASE("pair momentum: the report tells what a step loses") {
  for (const Index iterations : {3, 10}) {
    for (const Index substeps : {1, 3}) {
      const SolverSettings settings{.substeps = substeps, .iterations = iterations, .threads = 1};
      CHECK(loss_of(collision_of_two({.settings = settings})).not_reported < 1e-9);
    }
  }
  const SolverSettings bdf2{.integrator = Integrator::bdf2, .iterations = 10, .threads = 1};
  CHECK(loss_of(collision_of_two({.settings = bdf2})).not_reported < 1e-9);
  // What is pulled at, however little, is left to the iterations.
  PairScene scene = collision_of_two({});
  const Index vertex = scene.simulation.vertex(BodyId{1}, 0);
  const Vec3 target = row(scene.simulation.state().positions, vertex);
  scene.simulation.add(BodyId{1}, Drag{.stencils = {{0}}, .stiffness = 1e-12, .targets = {target}});
  const Loss loss = loss_of(std::move(scene));
  CHECK(loss.not_reported < 1e-9);
  if (runs_whole_scenes) CHECK(loss.reported > 1e-4);
}

}  // namespace test_pair_momentum
