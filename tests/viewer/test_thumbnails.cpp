#include <set>

#include <doctest/doctest.h>

#include "pliant_io/scene/builtin_scenes.h"
#include "viewer/panels/thumbnails.h"

namespace test_thumbnails {

TEST_CASE("every built-in scene has a picture of its own, in which something is to be seen") {
  std::set<std::vector<std::uint8_t>> seen;
  for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) {
    CAPTURE(scene.name);
    const auto picture = pliant_viewer::thumbnail(scene.name);  // scripts/thumbnails.sh draws them
    REQUIRE(picture.has_value());
    CHECK(picture->width == 256);
    CHECK(picture->height == 160);
    REQUIRE(pliant_render::is_whole(*picture));
    const std::set<std::uint8_t> tones(picture->pixels.begin(), picture->pixels.end());
    CHECK(tones.size() > 50);
    CHECK(seen.insert(picture->pixels).second);
  }
  CHECK_FALSE(pliant_viewer::thumbnail("no_such_scene").has_value());
  CHECK_FALSE(pliant_viewer::thumbnail("").has_value());
}

}  // namespace test_thumbnails
