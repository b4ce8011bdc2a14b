// Without friction a bounce ends with no more energy than it began with, whatever the step and the iterations; and at
// rest nothing trembles.
#include <algorithm>
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

/// What a bounce has gained, over the energy of what falls.
Real gain_of(MakeScene make, const PairOptions& options) {
  PairScene scene = make(options);
  Real kinetic = 0;
  for (Index v = 0; v < scene.simulation.state().vertex_count(); ++v) {
    kinetic += scene.simulation.state().masses[static_cast<std::size_t>(v)] / 2 *
               row(scene.simulation.state().velocities, v).squaredNorm();
  }
  const Real begin = total_energy(scene.simulation);
  Index touched = 0;
  const Index frames = runs_whole_scenes ? scene.frames() : 2;
  for (Index i = 0; i < frames; ++i) touched = std::max(touched, scene.step().contact.active);
  if (runs_whole_scenes) CHECK(touched > 0);
  CHECK(count_crossings(scene.simulation) == 0);
  return (total_energy(scene.simulation) - begin) / kinetic;
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

TEST_CASE("bounce: implicit Euler gains nothing from three iterations on") {
  for (const Index iterations : {3, 10, 30}) {
    for (const Real time_step : {1.0 / 240, 1.0 / 60, 1.0 / 15}) {
      CAPTURE(iterations);
      CAPTURE(time_step);
      for (const MakeScene make : {bounce_block, bounce_sheet, bounce_ball}) {
        CHECK(gain_of(make, bouncing(time_step, iterations)) <= 0);
      }
      if (!runs_whole_scenes) return;
    }
  }
}

TEST_CASE("bounce: BDF2 gains at most a hundredth where blocks and sheets meet" * doctest::skip(!runs_whole_scenes)) {
  for (const Index iterations : {10, 30}) {
    for (const Real time_step : {1.0 / 240, 1.0 / 60, 1.0 / 15}) {
      CAPTURE(iterations);
      CAPTURE(time_step);
      for (const MakeScene make : {bounce_block, bounce_sheet}) {
        CHECK(gain_of(make, bouncing(time_step, iterations, Integrator::bdf2)) <= 0.01);
      }
    }
  }
}

TEST_CASE("rest: with damping, what has folded, draped and fallen lies still after 5 s" *
          doctest::skip(!runs_whole_scenes)) {
  CHECK(speed_at_rest(fold) < 1e-3);
  CHECK(speed_at_rest(drape) < 1e-3);
  CHECK(speed_at_rest(block) < 1e-3);
}

}  // namespace test_pair_bounce
