// Contact between surfaces changes nothing where nothing touches, and gives the same bits whatever the threads.
#include <doctest/doctest.h>

#include "tests/pairs/bits.h"
#include "tests/pairs/parts.h"
#include "tests/scene/whole_scenes.h"

namespace test_pair_bits {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// Takes steps, and returns how many of them had pairs that push.
Index advance(PairScene& scene, Index steps) {
  Index touching = 0;
  for (Index i = 0; i < steps; ++i) touching += scene.step().contact.active > 0 ? 1 : 0;
  return touching;
}

struct Trial {
  const char* name;
  Index frames;
  Real speed;
};
constexpr std::array trials{Trial{"stack", 30, 2}, Trial{"pile", 30, 3}, Trial{"twist", 60, 0},
                            Trial{"rope", 25, 2},  Trial{"fold", 40, 3}, Trial{"sleeve", 40, 0}};

/// A sheet that hangs by its upper border, and is pulled at in the middle of the lower one.
PairScene pulled_sheet(const PairOptions& options) {
  PairScene scene{empty_simulation(options)};
  const Index n = 17;
  const Mesh mesh = sheet_mesh(n, 1, Vec3::Zero(), Plane::xz);
  const BodyId body = add_cloth(scene.simulation, mesh);
  scene.simulation.add(body, Position{.on = {n * (n - 1), n * n - 1}});
  const Vec3 target = row(mesh.vertices, n / 2) + Vec3(0, 0.4, -0.3);
  scene.simulation.add(body, Drag{.stencils = {{n / 2}}, .stiffness = 1e6, .targets = {target}});
  finish(scene, options);
  return scene;
}

}  // namespace

TEST_CASE("pair bits: the same for any number of threads") {
  for (const Trial& trial : trials) {
    CAPTURE(std::string(trial.name));
    std::vector<Real> bits;
    for (const Index threads : {1, 2, 3, 8}) {
      CAPTURE(threads);
      PairScene scene = make_pair_scene(trial.name, {.settings = {.threads = threads}, .speed = trial.speed});
      CHECK(advance(scene, runs_whole_scenes ? trial.frames : 3) > (runs_whole_scenes ? 3 : -1));
      if (threads == 1) bits = bits_of(scene.simulation);
      CHECK(same_bits(bits_of(scene.simulation), bits));
    }
  }
}

TEST_CASE("pair bits: the same after a state is restored in the middle") {
  for (const Trial& trial : trials) {
    CAPTURE(std::string(trial.name));
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
      const PairOptions options{.settings = {.integrator = integrator, .threads = 1}, .speed = trial.speed};
      PairScene scene = make_pair_scene(trial.name, options);
      CHECK(advance(scene, runs_whole_scenes ? trial.frames : 3) > (runs_whole_scenes ? 0 : -1));
      const State middle = scene.simulation.state();
      PairScene resumed = make_pair_scene(trial.name, options);
      resumed.simulation.restore(middle);
      advance(scene, 6);
      advance(resumed, 6);
      CHECK(same_bits(bits_of(scene.simulation), bits_of(resumed.simulation)));
      // And back: what the steps since have left behind outside the state does not count.
      scene.simulation.restore(middle);
      advance(scene, 6);
      CHECK(same_bits(bits_of(scene.simulation), bits_of(resumed.simulation)));
    }
  }
}

TEST_CASE("pair bits: set_contact lets surfaces touch, and without them nothing is left of that") {
  for (const char* name : {"drape", "pile"}) {
    CAPTURE(name);
    PairOptions off{.contact = {.surfaces = false}, .speed = 2};
    PairScene scene = make_pair_scene(name, off);
    PairScene switched = make_pair_scene(name, off);
    switched.simulation.set_contact({.surfaces = true});
    switched.simulation.set_contact({.surfaces = false});
    PairScene on = make_pair_scene(name, {.speed = 2});
    PairScene other = make_pair_scene(name, off);
    other.simulation.set_contact({.friction = on.simulation.contact().friction});
    for (PairScene* each : {&scene, &switched, &on, &other}) advance(*each, runs_whole_scenes ? 40 : 5);
    CHECK(same_bits(bits_of(scene.simulation), bits_of(switched.simulation)));
    CHECK(same_bits(bits_of(on.simulation), bits_of(other.simulation)));
    if (runs_whole_scenes) CHECK_FALSE(same_bits(bits_of(scene.simulation), bits_of(on.simulation)));
  }
}

TEST_CASE("pair bits: a sheet that is pulled hard moves as without surfaces while nothing touches") {
  for (const Acceleration acceleration :
       {Acceleration::none, Acceleration::lbfgs, Acceleration::anderson, Acceleration::chebyshev}) {
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
      CAPTURE(static_cast<int>(acceleration));
      CAPTURE(static_cast<int>(integrator));
      const PairOptions options{.settings = {.integrator = integrator, .acceleration = acceleration, .threads = 1}};
      PairOptions without = options;
      without.contact.surfaces = false;
      PairScene scene = pulled_sheet(options);
      PairScene plain = pulled_sheet(without);
      const Real distance = usual_distance(scene.simulation.bodies()[0].mesh);
      Index free_steps = 0;
      for (; free_steps < 12; ++free_steps) {
        const Positions before = scene.simulation.state().positions;
        const ContactReport contact = scene.step().contact;
        plain.step();
        if (contact.shortened > 0) break;  // the prediction of BDF2 folds the sheet through itself
        CHECK(contact.active == 0);
        const Positions& after = scene.simulation.state().positions;
        // Many times as far in one step as the room that a search for pairs leaves by itself.
        if (free_steps == 0) CHECK((after - before).rowwise().norm().maxCoeff() > 20 * distance);
        CHECK((after - plain.simulation.state().positions).cwiseAbs().maxCoeff() < 1e-9);
      }
      CHECK(free_steps >= (integrator == Integrator::bdf2 ? 2 : 12));
    }
  }
}

}  // namespace test_pair_bits
