// The built-in scenes of docs/gallery.md that no other file of tests runs.
#include <algorithm>

#include <doctest/doctest.h>

#include "load_builtin_scene.h"
#include "whole_scenes.h"

namespace test_gallery_scenes {

namespace {

using namespace pliant;
using pliant_tests::load_builtin_scene;
using pliant_tests::runs_whole_scenes;

const Body& body_named(const Scene& scene, std::string_view name) {
  const auto found = std::ranges::find(scene.simulation.bodies(), name, &Body::name);
  REQUIRE(found != scene.simulation.bodies().end());
  return *found;
}

Positions positions_of(const Scene& scene, std::string_view name) {
  const Body& body = body_named(scene, name);
  return scene.simulation.state().positions.middleRows(body.first_vertex, body.mesh.vertex_count());
}

Vec3 middle_of(const Scene& scene, std::string_view name) {
  return positions_of(scene, name).colwise().mean().transpose();
}

/// Mean height of the boards that begin nearer than 0.3 m to that place along the bridge.
Real deck_height(const Scene& scene, Real x) {
  const Mesh& mesh = body_named(scene, "boards").mesh;
  const Positions now = positions_of(scene, "boards");
  Real sum = 0;
  int count = 0;
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    if (std::abs(mesh.vertices(i, 0) - x) > 0.3) continue;
    sum += now(i, 2);
    ++count;
  }
  REQUIRE(count > 0);
  return sum / count;
}

}  // namespace

TEST_CASE("scenes of the gallery open and take a step") {
  for (const char* name : {"walkers", "trampoline_crowd", "silk_on_figure"}) {
    CAPTURE(name);
    Scene scene = load_builtin_scene(name);
    const Positions before = scene.simulation.state().positions;
    scene.step();
    CHECK(scene.simulation.state().positions.allFinite());
    CHECK(scene.simulation.state().positions != before);
    CHECK((scene.simulation.state().positions - before).cwiseAbs().maxCoeff() < 0.2);
  }
}

TEST_CASE("scene walkers: they cross, and the deck is lower where they stand" * doctest::skip(!runs_whole_scenes)) {
  Scene scene = load_builtin_scene("walkers");
  const Real span = 5.2;
  const Real start = deck_height(scene, span / 2);
  Real deepest = 0;
  int let_go = 0;
  for (std::int64_t step = 1; step <= scene.steps; ++step) {
    let_go += static_cast<int>(scene.step().contact.let_go);
    const Real x = middle_of(scene, "boots of one").x();
    if (std::abs(x - span / 2) < 0.1) deepest = std::max(deepest, start - deck_height(scene, x));
  }
  CHECK(let_go == 0);
  CHECK(deepest > 0.08);
  CHECK(middle_of(scene, "coat of one").x() > span);
  CHECK(middle_of(scene, "coat of two").x() > 0.7 * span);
  // The boards hang on the ropes, and those on their posts.
  CHECK(std::abs(middle_of(scene, "boards").x() - span / 2) < 0.1);
  CHECK(positions_of(scene, "boards").col(2).minCoeff() > -0.8);
  CHECK(scene.simulation.warnings().empty());
}

TEST_CASE("scene trampoline_crowd: it throws dolls up, and all stay on it" * doctest::skip(!runs_whole_scenes)) {
  Scene scene = load_builtin_scene("trampoline_crowd");
  const auto height = [&] { return middle_of(scene, "red").z(); };
  Real lowest = height(), thrown = 0;
  for (std::int64_t step = 1; step <= scene.steps; ++step) {
    scene.step();
    lowest = std::min(lowest, height());
    thrown = std::max(thrown, height() - lowest);
  }
  CHECK(thrown > 0.2);
  for (const char* name : {"red", "yellow", "green", "blue", "violet", "teal", "orange"}) {
    CAPTURE(name);
    const Vec3 doll = middle_of(scene, name);
    CHECK(std::abs(doll.x()) < 1.4);
    CHECK(std::abs(doll.y()) < 1.4);
    CHECK(doll.z() > positions_of(scene, "mat").col(2).minCoeff());
  }
  CHECK(scene.simulation.warnings().empty());
}

TEST_CASE("scene silk_on_figure: the silk hangs on head and arms, and reaches down to the hips" *
          doctest::skip(!runs_whole_scenes)) {
  Scene scene = load_builtin_scene("silk_on_figure");
  while (scene.simulation.state().step < scene.steps) scene.step();
  const Positions silk = positions_of(scene, "silk"), figure = positions_of(scene, "figure");
  CHECK(silk.col(2).maxCoeff() > figure.col(2).maxCoeff());
  CHECK(silk.col(2).maxCoeff() < figure.col(2).maxCoeff() + 0.03);
  CHECK(silk.col(2).minCoeff() > 0);
  CHECK(silk.col(2).minCoeff() < 1);
  CHECK(scene.simulation.warnings().empty());
}

}  // namespace test_gallery_scenes
