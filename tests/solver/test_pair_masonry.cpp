// Stiff blocks that stand on each other by weight and friction: an arch, a tower. `contact_scenes tower arch
// --friction 0.6 --frames 3600` lets them stand for a minute.
#include <doctest/doctest.h>

#include "tests/pairs/masonry_scenes.h"
#include "tests/scene/whole_scenes.h"

namespace test_pair_masonry {

using namespace pliant;
using namespace pliant_tests;

namespace {

PairOptions with_friction(Real friction) {
  PairOptions options;
  options.contact.friction = friction;
  return options;
}

Standing standing_after(PairScene& scene, Index frames) {
  for (Index i = 0; i < frames; ++i) scene.step();
  return standing(scene.simulation);
}

}  // namespace

TEST_CASE("masonry: an arch of wedges stands by friction") {
  PairScene scene = arch(with_friction(0.6), 11);
  REQUIRE(count_crossings(scene.simulation) == 0);
  const Standing begin = standing_after(scene, runs_whole_scenes ? 120 : 2);
  CHECK(begin.sag < 0.02);
  CHECK(begin.sideways < 0.01);
  CHECK(count_crossings(scene.simulation) == 0);
  if (!runs_whole_scenes) return;
  const Standing end = standing_after(scene, 240);
  CHECK(end.sag < begin.sag + 1e-4);
  CHECK(end.sideways < begin.sideways + 1e-4);
  CHECK(end.fastest < 1e-3);
}

TEST_CASE("masonry: with too little friction an arch falls" * doctest::skip(!runs_whole_scenes)) {
  // Statics: a semicircular arch of whatever thickness slides apart below a friction of about 0.3.
  PairScene scene = arch(with_friction(0.2), 11);
  CHECK(standing_after(scene, 180).sag > 0.5);
  CHECK(count_crossings(scene.simulation) == 0);
}

TEST_CASE("masonry: a tower of 20 boxes stands in short steps" * doctest::skip(!runs_whole_scenes)) {
  PairOptions options = with_friction(0.6);
  options.settings.substeps = 4;
  options.vertices = 20 * 27;
  PairScene scene = tower(options, 20);
  const Standing now = standing_after(scene, 90);
  CHECK(now.sag < 0.005);  // of 4 m
  CHECK(now.sideways < 0.04);
  CHECK(now.fastest < 0.05);
  CHECK(count_crossings(scene.simulation) == 0);
}

}  // namespace test_pair_masonry
