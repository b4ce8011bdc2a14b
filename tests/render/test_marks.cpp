// Marks of selected vertices, and the collider under the mouse.
#include "pliant/collision/colliders/builtin.h"
#include "render/offscreen_context.h"
#include "render/render_target.h"
#include "render/renderer.h"
#include "studio.h"

namespace test_marks {

using namespace pliant_tests;
using namespace pliant_render;

/// How many pixels have a tone like that of selected vertices, or of pins.
int count_like(const Image& image, const Rgb& tone) {
  int count = 0;
  for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3) {
    count += distance({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]}, tone) < 40 ? 1 : 0;
  }
  return count;
}

constexpr Rgb amber = {255, 178, 31};
constexpr Rgb pin_tone = {250, 250, 247};

TEST_CASE("selected vertices have marks where they are seen, around those of pins, and none where none are wanted") {
  Studio studio;
  pliant::Simulation simulation;
  simulation.add(pliant::SphereCollider{.center = {0.25, -0.4, 0.25}, .radius = 0.1});
  ColliderSurfaces surfaces;
  studio.frame.colliders = surfaces.find(simulation);
  std::optional<OffscreenContext> context;
  if (!make_if_drawable(context)) return;
  Renderer renderer(make_render_mesh(studio.bodies));
  const RenderTarget target(640, 480, 1);
  pliant::ViewSettings appearance = studio.options.appearance;
  DrawOptions options{.viewpoint = place_camera(appearance.camera, studio.options.bounds, 4.0F / 3)};
  const auto draw = [&] {
    target.begin();
    renderer.draw(appearance, options, 640, 480);
    target.resolve();
    return target.read();
  };
  renderer.set_frame(studio.frame, pliant::ColorBy::none);
  const Image bare = draw();
  CHECK(count_like(bare, amber) == 0);
  renderer.set_selection({40});
  CHECK(draw().pixels == bare.pixels);  // not asked for
  options.selection = true;
  const int of_one = count_like(draw(), amber);
  CHECK(of_one > 30);
  renderer.set_selection({10, 20, 40});
  CHECK(count_like(draw(), amber) == doctest::Approx(3 * of_one).epsilon(0.2));
  renderer.set_selection({60});  // behind the ball
  CHECK(count_like(draw(), amber) < of_one / 4);

  studio.frame.markers = {40};
  renderer.set_frame(studio.frame, pliant::ColorBy::none);
  renderer.set_selection({});
  const int of_pin = count_like(draw(), pin_tone);
  CHECK(of_pin > 5);
  renderer.set_selection({40});
  const Image both = draw();
  CHECK(count_like(both, pin_tone) == doctest::Approx(of_pin).epsilon(0.2));
  CHECK(count_like(both, amber) > 15);
  options.selection = false;
  CHECK(count_like(draw(), amber) == 0);

  const Image usual = draw();
  options.lit_collider = studio.frame.colliders.at(0).number;
  const Image lit = draw();
  int brighter = 0, darker = 0;
  for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
    brighter += lit.pixels[i] > usual.pixels[i] ? 1 : 0;
    darker += lit.pixels[i] < usual.pixels[i] ? 1 : 0;
  }
  CHECK(brighter > 500);
  CHECK(darker == 0);
  options.lit_collider = 77;  // none
  CHECK(draw().pixels == usual.pixels);
}

}  // namespace test_marks
