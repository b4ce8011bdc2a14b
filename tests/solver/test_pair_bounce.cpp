// Without friction a bounce ends with no more energy than it began with, whatever the step and the iterations; and at
// rest nothing trembles.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "tests/pairs/body_scenes.h"
#include "tests/pairs/bounce_scenes.h"
#include "tests/pairs/cloth_scenes.h"
#include "tests/scene/whole_scenes.h"

namespace test_pair_bounce {

using namespace pliant;
using namespace pliant_tests;

namespace {

using MakeScene = PairScene (*)(const PairOptions&);

PairOptions bouncing(Real time_step, Index iterations, Integrator integrator = Integrator::implicit_euler) {
  PairOptions options;
  options.vertices = 250;
  options.settings.time_step = time_step;
  options.settings.iterations = iterations;
  options.settings.integrator = integrator;
  options.contact.friction = 0;
  return options;
}

struct Bounce {
  Real gain = 0;   // at the end, over the energy of what falls
  Real most = 0;   // on the way
  Real taken = 0;  // the sum over all steps
};

Bounce bounce(MakeScene make, const PairOptions& options) {
  PairScene scene = make(options);
  Real kinetic = 0;
  for (Index v = 0; v < scene.simulation.state().vertex_count(); ++v) {
    kinetic += scene.simulation.state().masses[static_cast<std::size_t>(v)] / 2 *
               row(scene.simulation.state().velocities, v).squaredNorm();
  }
  const Real begin = total_energy(scene.simulation);
  Bounce result;
  Index touched = 0;
  const Index frames = runs_whole_scenes ? scene.frames() : 2;
  for (Index i = 0; i < frames; ++i) {
    const ContactReport contact = scene.step().contact;
    touched = std::max(touched, contact.active);
    result.taken += contact.energy_taken / kinetic;
    result.gain = (total_energy(scene.simulation) - begin) / kinetic;
    result.most = std::max(result.most, result.gain);
  }
  if (runs_whole_scenes && options.contact.surfaces) CHECK(touched > 0);
  if (options.contact.surfaces) CHECK(count_crossings(scene.simulation) == 0);
  return result;
}

/// What it may gain: with one iteration a pinned sheet is stretched by its own weight in long steps, whether something
/// falls on it or not.
Real gain_without_contact(MakeScene make, PairOptions options) {
  options.contact.surfaces = false;
  return std::max(Real(0), bounce(make, options).gain);
}

constexpr std::array<Real, 3> time_steps = {1.0 / 240, 1.0 / 60, 1.0 / 15};
constexpr std::array<MakeScene, 3> all_bounces = {bounce_block, bounce_sheet, bounce_ball};

Vec3 momentum_of(const Simulation& simulation) {
  Vec3 sum = Vec3::Zero();
  for (Index v = 0; v < simulation.state().vertex_count(); ++v) {
    sum += simulation.state().masses[static_cast<std::size_t>(v)] * row(simulation.state().velocities, v);
  }
  return sum;
}

Real median(std::vector<Real> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Of three runs that differ in friction: folds are chaotic [m/s].
Real speed_at_rest(MakeScene make) {
  std::vector<Real> speeds;
  for (const Real friction : {0.27, 0.3, 0.33}) {
    PairOptions options;
    options.vertices = 200;
    options.settings.iterations = 20;
    options.settings.damping = 2;
    options.contact.friction = friction;
    PairScene scene = make(options);
    for (Index i = 0; i < 300; ++i) scene.step();
    speeds.push_back(rms_speed(scene.simulation));
  }
  return median(speeds);
}

}  // namespace

TEST_CASE("bounce: implicit Euler ends with no more energy than it began with") {
  for (const Index iterations : {1, 3, 10, 30}) {
    for (const Real time_step : time_steps) {
      for (const MakeScene make : all_bounces) {
        CAPTURE(iterations);
        CAPTURE(time_step);
        const PairOptions options = bouncing(time_step, iterations);
        const Bounce result = bounce(make, options);
        const bool is_stretched = iterations == 1 && time_step > 0.05 && make == bounce_sheet;
        CHECK(result.gain <= (is_stretched ? gain_without_contact(make, options) : 0));
        if (iterations >= 10) CHECK(result.most <= 0);
      }
      if (!runs_whole_scenes) return;
    }
  }
}

/// With one iteration blocks and balls may gain: what residuals put in is not all that there is too much.
TEST_CASE("bounce: BDF2 ends with at most a hundredth more" * doctest::skip(!runs_whole_scenes)) {
  for (const Index iterations : {3, 10, 30}) {
    for (const Real time_step : time_steps) {
      for (const MakeScene make : all_bounces) {
        CAPTURE(iterations);
        CAPTURE(time_step);
        CHECK(bounce(make, bouncing(time_step, iterations, Integrator::bdf2)).gain <= 0.01);
      }
    }
  }
}

TEST_CASE("bounce: nothing is taken where iterations have converged" * doctest::skip(!runs_whole_scenes)) {
  CHECK(bounce(bounce_sheet, bouncing(1.0 / 60, 200)).taken < 1e-9);
  CHECK(bounce(bounce_block, bouncing(1.0 / 240, 200)).taken < 1e-9);
  CHECK(bounce(bounce_block, bouncing(1.0 / 240, 200, Integrator::bdf2)).taken < 1e-9);
}

TEST_CASE("bounce: what is taken leaves the momentum of bodies that nothing holds") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const Index iterations : {1, 2}) {
      PairScene scene = collision_of_two(bouncing(1.0 / 60, iterations, integrator));
      const Vec3 scale = momentum_of(scene.simulation);
      Real mass = 0;
      for (const Real each : scene.simulation.state().masses) mass += each;
      Vec3 before = scale;
      Vec3 last = Vec3::Zero();
      Real taken = 0;
      Real worst = 0;
      for (Index i = 0; i < (runs_whole_scenes ? scene.frames() : 3); ++i) {
        const ContactReport contact = scene.step().contact;
        const Vec3 change = momentum_of(scene.simulation) - before;
        const Vec3 carried = integrator == Integrator::bdf2 ? Vec3(last / 3) : Vec3(Vec3::Zero());
        worst = std::max(worst, (change - carried + contact.momentum_lost).norm() / mass);
        taken += contact.energy_taken;
        before += change;
        last = change;
      }
      if (runs_whole_scenes) CHECK(taken > 0.01);
      CHECK(worst < 1e-9);
    }
  }
}

TEST_CASE("bounce: what begins as energy of contact is given back, whatever the state says is owed is not") {
  const PairOptions options = bouncing(1.0 / 60, 10);
  PairScene scene = bounce_block(options);
  Simulation& simulation = scene.simulation;
  while (simulation.state().contact.energies.empty()) scene.step();
  State state = simulation.state();
  const auto kinetic_after = [&](Real owed) {
    state.contact.energies.front() -= owed;
    simulation.restore(state);
    state.contact.energies.front() += owed;
    const Real taken = simulation.step().contact.energy_taken;
    return std::pair(rms_speed(simulation), taken);
  };
  const auto [usual, nothing] = kinetic_after(0);
  const auto [slower, taken] = kinetic_after(5);
  CHECK(nothing < 1);
  CHECK(taken > 1);
  CHECK(slower < usual);
}

TEST_CASE("rest: with damping, what has folded, draped and fallen lies still after 5 s" *
          doctest::skip(!runs_whole_scenes)) {
  CHECK(speed_at_rest(fold) < 1e-3);
  CHECK(speed_at_rest(drape) < 1e-3);
  CHECK(speed_at_rest(block) < 1e-3);
}

}  // namespace test_pair_bounce
