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
  for (Vec3f& p : studio.frame.positions) p = {p.x(), p.z(), height};
  studio.options.appearance.camera.position = pliant::Vec3(0, -0.2, 2.5);
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
  int depth = 0;      ///< how much darker its darkest pixel is than without it, in thousandths
  int half_dark = 0;  ///< pixels of its right edge that are neither dark nor light
};

/// None where the machine has no OpenGL.
std::optional<ShadowProfile> profile(Studio studio) {
  const std::optional<Image> image = studio.draw();
  studio.options.appearance.shadow = false;
  const std::optional<Image> bare = studio.draw();
  if (!image || !bare) return {};
  std::vector<int> darker;
  for (int column = 0; column < image->width; ++column) {
    const int without = pixel(*bare, column, image->height / 2)[1];
    darker.push_back(1000 * (without - pixel(*image, column, image->height / 2)[1]) / without);
  }
  ShadowProfile found;
  const auto darkest = std::ranges::max_element(darker);
  found.depth = *darkest;
  found.half_dark = static_cast<int>(std::count_if(
      darkest, darker.end(), [&](int each) { return 5 * each > found.depth && 5 * each < 4 * found.depth; }));
  return found;
}

}  // namespace

TEST_CASE("a shadow on the ground is wider at its edge and lighter the higher what throws it") {
  const std::optional<ShadowProfile> near = profile(above_the_ground(0.05F)), far = profile(above_the_ground(0.6F));
  if (!near || !far) return;
  CHECK(near->depth > 280);
  CHECK(far->depth > 180);
  CHECK(far->depth < near->depth - 50);
  CHECK(near->half_dark <= 3);
  CHECK(far->half_dark >= 6);
  // At low quality it has one darkness.
  Studio low = above_the_ground(0.05F), high = above_the_ground(0.6F);
  low.options.appearance.quality = high.options.appearance.quality = pliant::Quality::low;
  const std::optional<ShadowProfile> low_one = profile(low), high_one = profile(high);
  CHECK(std::abs(low_one->depth - high_one->depth) < 20);
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
