// Surfaces do not pass through each other: no crossing, by the exact checker, at the end of any step.
#include <algorithm>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "tests/pairs/cloth_scenes.h"
#include "tests/pairs/pair_scene.h"
#include "tests/scene/whole_scenes.h"

namespace test_pair_contact {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// A scene and how many of its steps are taken: enough for its surfaces to meet.
struct Trial {
  std::string name;
  Index frames;
};

/// What a scene has come to.
struct Outcome {
  std::int64_t crossings = 0;  // of the frame that has most
  Index active = 0;            // pairs that push, of the frame that has most
  bool is_finite = true;
};

Outcome outcome_of(PairScene& scene, Index frames) {
  Outcome outcome;
  outcome.crossings = count_crossings(scene.simulation);
  for (Index i = 0; i < frames; ++i) {
    outcome.active = std::max(outcome.active, scene.step().contact.active);
    outcome.crossings = std::max(outcome.crossings, count_crossings(scene.simulation));
  }
  outcome.is_finite = scene.simulation.state().positions.allFinite();
  return outcome;
}

void check_trials(const std::vector<Trial>& trials, const PairOptions& options) {
  for (const Trial& trial : trials) {
    CAPTURE(trial.name);
    PairScene scene = make_pair_scene(trial.name, options);
    const Outcome outcome = outcome_of(scene, runs_whole_scenes ? trial.frames : 2);
    CHECK(outcome.crossings == 0);
    // A drape touches itself by chance at this size, and one iteration makes a strip so stiff that it hardly folds.
    const bool must_touch = runs_whole_scenes && trial.name != "drape" && options.settings.iterations > 1;
    if (must_touch) CHECK(outcome.active > 0);
    CHECK(outcome.is_finite);
  }
}

/// The scenes that are varied, with steps of 1/60 s.
std::vector<Trial> usual_trials() {
  return {{"drape", 60}, {"twist", 150}, {"fold", 70}, {"stack", 45}, {"pile", 60}, {"rope", 45}};
}

/// As many seconds with another time step.
std::vector<Trial> trials_of_step(Real time_step, Real share = 1) {
  std::vector<Trial> trials = usual_trials();
  for (Trial& trial : trials) trial.frames = static_cast<Index>(share * trial.frames / 60 / time_step);
  return trials;
}

Positions positions_of(const Simulation& simulation, std::size_t body) {
  const Body& it = simulation.bodies()[body];
  return simulation.state().positions.middleRows(it.first_vertex, it.mesh.vertex_count());
}

/// How far the second body is above the lowest vertex of the first [m], where it is over the middle of the first: what
/// hangs over a border may hang deeper.
Real height_above(const Simulation& simulation) {
  const Positions below = positions_of(simulation, 0);
  const Positions above = positions_of(simulation, 1);
  const Vec3 low = below.colwise().minCoeff();
  const Vec3 high = below.colwise().maxCoeff();
  Real height = std::numeric_limits<Real>::infinity();
  for (Index v = 0; v < above.rows(); ++v) {
    const Vec3 away = (row(above, v) - (low + high) / 2).cwiseAbs();
    const Vec3 middle = 0.4 * (high - low);
    if (away.x() < middle.x() && away.y() < middle.y()) height = std::min(height, above(v, 2) - low.z());
  }
  return height;
}

}  // namespace

TEST_CASE("pairs: the checker sees what happens when surfaces do not touch") {
  PairOptions options;
  options.contact.surfaces = false;
  for (const Trial& trial : usual_trials()) {
    if (trial.name == "drape") continue;  // so early nothing meets but by chance
    CAPTURE(trial.name);
    PairScene scene = make_pair_scene(trial.name, options);
    if (runs_whole_scenes) CHECK(outcome_of(scene, trial.frames).crossings > 0);
  }
}

TEST_CASE("pairs: no crossing in any frame") {
  check_trials(usual_trials(), {});
}

TEST_CASE("pairs: no crossing in a scene that is not varied") {
  check_trials({{"block", 60},
                {"fall", 60},
                {"two_sheets", 60},
                {"rotating_sphere", 120},
                {"layers_free", 40},
                {"collision", 40}},
               {});
}

TEST_CASE("pairs: no crossing with one iteration") {
  check_trials(usual_trials(), {.settings = {.iterations = 1, .threads = 1}});
}

TEST_CASE("pairs: no crossing with three iterations") {
  check_trials(usual_trials(), {.settings = {.iterations = 3, .threads = 1}});
}

TEST_CASE("pairs: no crossing with steps of 1/15 s") {
  check_trials(trials_of_step(1.0 / 15, 2), {.settings = {.time_step = 1.0 / 15, .threads = 1}});
}

TEST_CASE("pairs: no crossing with steps of 1/240 s") {
  check_trials(trials_of_step(1.0 / 240), {.settings = {.time_step = 1.0 / 240, .threads = 1}});
}

TEST_CASE("pairs: no crossing with BDF2") {
  check_trials(usual_trials(), {.settings = {.integrator = Integrator::bdf2, .threads = 1}});
}

TEST_CASE("pairs: no crossing with any acceleration, or none") {
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::anderson, Acceleration::chebyshev}) {
    CAPTURE(static_cast<int>(acceleration));
    // A plain fold is still in the air after as many frames.
    check_trials({{"twist", 60}, {"stack", 25}, {"pile", 30}},
                 {.settings = {.acceleration = acceleration, .threads = 1}});
  }
}

TEST_CASE("pairs: no crossing with four substeps") {
  check_trials({{"twist", 60}, {"fold", 40}, {"stack", 25}, {"pile", 30}}, {.settings = {.substeps = 4, .threads = 1}});
}

TEST_CASE("pairs: no crossing when thrown at 30 m/s") {
  check_trials({{"drape", 25}, {"fold", 45}, {"stack", 25}, {"pile", 25}, {"rope", 25}, {"collision", 25}},
               {.speed = 30});
}

TEST_CASE("pairs: no crossing with half the contact distance and with twice") {
  for (const Real scale : {0.5, 2.0}) {
    CAPTURE(scale);
    check_trials({{"twist", 100}, {"fold", 60}, {"stack", 40}, {"pile", 40}}, {.distance_scale = scale});
  }
}

TEST_CASE("pairs: no crossing where a drag of 1e6 N/m pulls a vertex through the others") {
  check_trials({{"drape", 60}, {"fold", 40}, {"stack", 40}, {"pile", 40}}, {.drag = 1e6});
}

TEST_CASE("pairs: no crossing in ten piles drawn by chance") {
  for (std::uint64_t seed = 1; seed <= (runs_whole_scenes ? 10 : 2); ++seed) {
    CAPTURE(seed);
    check_trials({{"pile", 40}}, {.seed = seed});
  }
}

TEST_CASE("pairs: what falls on a pinned sheet stays above it, whatever its speed") {
  // Whatever is through as a whole crosses nothing any more.
  for (const char* name : {"two_sheets", "rope"}) {
    for (const Real speed : {0.0, 5.0, 30.0}) {
      for (const Real time_step : {1.0 / 60, 1.0 / 15}) {
        CAPTURE(name);
        CAPTURE(speed);
        CAPTURE(time_step);
        PairScene scene = make_pair_scene(name, {.settings = {.time_step = time_step, .threads = 1}, .speed = speed});
        const Real duration = runs_whole_scenes ? 0.5 : 0.04;
        for (Index i = 0; i < static_cast<Index>(duration / time_step); ++i) {
          scene.step();
          CHECK(height_above(scene.simulation) > 0);
        }
      }
    }
  }
}

TEST_CASE("pairs: a report tells of gaps, and of none where there are no surfaces") {
  PairOptions options;
  PairScene scene = layers_free(options, {.count = 2});
  const Real distance = scene.simulation.contact().distance;
  ContactReport contact;
  for (int i = 0; i < 20; ++i) contact = scene.step().contact;
  CHECK(contact.pairs >= contact.active);
  CHECK(contact.active > 0);
  CHECK(contact.smallest_gap < distance);
  CHECK(contact.smallest_gap > 0.9 * distance);
  options.contact.surfaces = false;
  PairScene plain = layers_free(options, {.count = 2});
  contact = plain.step().contact;
  CHECK(contact.pairs == 0);
  CHECK(contact.active == 0);
  CHECK(contact.shortened == 0);
  CHECK(contact.smallest_gap == std::numeric_limits<Real>::infinity());
}

}  // namespace test_pair_contact
