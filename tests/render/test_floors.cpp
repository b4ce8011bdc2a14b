// Floors in pictures: slow gradients without bands, and shadows that are wider and lighter the higher what throws them.
#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "studio.h"

namespace test_floors {

using namespace pliant_render;
using namespace pliant_tests;

namespace {

Rgb pixel(const Image& image, int column, int row) {
  const auto first =
      3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(column));
  return {image.pixels[first], image.pixels[first + 1], image.pixels[first + 2]};
}

/// A square that lies this far above the ground, which is seen from above with the light from there [m].
Studio above_the_ground(float height) {
  Studio studio;
  for (Vec3f& p : studio.frame.positions) p = {0.3F * p.x(), 0.3F * p.z(), height};
  studio.options.appearance.camera.position = pliant::Vec3(0, -4, 4);
  studio.options.appearance.camera.target = pliant::Vec3(0, 0, 0);
  studio.options.appearance.light = pliant::Vec3(-0.9, 0, 1);
  studio.options.appearance.shadow = studio.options.appearance.ground = true;
  studio.options.ground_height = 0;
  studio.options.bounds = bounds_of(studio.frame.positions);
  studio.frame.markers.clear();
  return studio;
}

/// Of a shadow along the row of pixels through its middle.
struct ShadowProfile {
  int depth = 0;      ///< how much darker its darkest pixel is than the ground beside it
  int half_dark = 0;  ///< pixels that are neither dark nor light, of its right edge
};

/// Without the sky, which is darker below a body too.
ShadowProfile profile(Studio& studio) {
  const std::optional<Image> image = studio.draw();
  studio.options.appearance.shadow = false;
  const std::optional<Image> bare = studio.draw();
  ShadowProfile found;
  if (!image || !bare) return found;
  std::vector<int> darker;
  const int middle = image->height / 2;
  for (int column = 0; column < image->width; ++column) {
    int most = 0;
    for (int row = middle - 3; row <= middle + 3; ++row) {
      most = std::max(most, pixel(*bare, column, row)[1] - pixel(*image, column, row)[1]);
    }
    darker.push_back(most);
  }
  const auto darkest = std::ranges::max_element(darker);
  found.depth = *darkest;
  found.half_dark = static_cast<int>(std::ranges::count_if(
      darkest, darker.end(), [&](int each) { return 5 * each > found.depth && 5 * each < 4 * found.depth; }));
  return found;
}

}  // namespace

TEST_CASE("a shadow on the ground is wider at its edge and lighter the higher what throws it") {
  Studio low_one = above_the_ground(0.05F), high_one = above_the_ground(1.2F);
  const ShadowProfile near = profile(low_one), far = profile(high_one);
  if (near.depth == 0) return;  // no OpenGL
  CHECK(near.depth > 40);
  CHECK(far.depth > 15);
  CHECK(far.depth < near.depth - 10);
  CHECK(far.half_dark > 2 * near.half_dark);
  CHECK(near.half_dark >= 1);
  // At low quality it has one darkness.
  Studio low = above_the_ground(0.05F), high = above_the_ground(1.2F);
  low.options.appearance.quality = high.options.appearance.quality = pliant::Quality::low;
  CHECK(std::abs(profile(low).depth - profile(high).depth) < 6);
}

TEST_CASE("the ground fades without bands, each frame alike, and what has one color keeps it") {
  Studio studio = above_the_ground(0.05F);
  studio.options.appearance.shadow = false;
  studio.options.appearance.camera.position = pliant::Vec3(0, -2, 0.5);
  studio.options.appearance.background = {0.93, 0.94, 0.95};
  const std::optional<Image> image = studio.draw();
  const std::optional<Image> again = studio.draw();
  if (!image) return;
  CHECK(image->pixels == again->pixels);
  // Rows of the sky are one color; those of the fading ground have both bytes between which they lie.
  int mixed = 0, rows = 0;
  for (int row = 0; row < image->height; ++row) {
    std::set<int> tones;
    for (int column = 0; column < 16; ++column) tones.insert(pixel(*image, column, row)[0]);
    if (*tones.begin() == 237) {
      CHECK(tones.size() == 1);
      continue;
    }
    ++rows;
    mixed += tones.size() == 2 && *tones.rbegin() == *tones.begin() + 1;
  }
  CHECK(rows > 30);
  CHECK(4 * mixed > rows);
}

}  // namespace test_floors
