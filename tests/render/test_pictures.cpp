// Pictures are looked at where it is known what must be there.
#include <optional>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant/mesh/geometry.h"
#include "render/scalar_fields.h"
#include "studio.h"

namespace test_pictures {

using namespace pliant_render;
using namespace pliant_tests;

namespace {

/// The edge of the square, seen from 3 m with 40 degrees.
const double edge_v = 0.5 / 3 / std::tan(20 * 3.14159265358979 / 180);

}  // namespace

TEST_CASE("a square stands where it is projected to, before the background") {
  const Studio studio;
  const std::optional<Image> image = studio.draw();
  if (!image) return;
  CHECK(image->width == 320);
  CHECK(image->height == 240);
  const Rgb background = rgb(studio.options.appearance.background);
  CHECK(distance(at(*image, 0, edge_v + 0.03), background) < 4);
  CHECK(distance(at(*image, 0, -edge_v - 0.03), background) < 4);
  CHECK(distance(at(*image, 0, edge_v - 0.03), background) > 60);
  CHECK(distance(at(*image, (edge_v - 0.03) * 0.75, 0), background) > 60);
  CHECK(distance(at(*image, (edge_v + 0.03) * 0.75, 0), background) < 4);
}

TEST_CASE("the two sides have their own tones") {
  Studio studio;
  studio.options.appearance.front = pliant::Color{0.9, 0.1, 0.1};
  studio.options.appearance.back = pliant::Color{0.1, 0.1, 0.9};
  const std::optional<Image> one = studio.draw();
  studio.options.appearance.camera.position = pliant::Vec3(0, 3, 0);
  const std::optional<Image> other = studio.draw();
  if (!one || !other) return;
  const pliant::Mesh& mesh = studio.bodies[0].mesh;
  const pliant::Vec3 normal = pliant::triangle_normals(mesh.vertices, mesh.triangles).row(0).transpose();
  REQUIRE(std::abs(normal.y()) > 0.99);
  const Rgb before = at(*one, 0.1, 0.1), behind = at(*other, 0.1, 0.1);
  const Rgb front = normal.y() < 0 ? before : behind;
  const Rgb back = normal.y() < 0 ? behind : before;
  CHECK(front[0] > 2 * front[2]);
  CHECK(back[2] > 2 * back[0]);
}

TEST_CASE("of several bodies each has a tone of its own, unless the scene gives one; what is held is not counted") {
  Studio studio;
  pliant::Mesh right = studio.bodies[0].mesh;
  right.vertices.col(0).array() += 1.1;
  studio.bodies.push_back({"right square", right, 81});
  for (pliant::Index i = 0; i < 81; ++i)
    studio.frame.positions.push_back(right.vertices.row(i).transpose().cast<float>());
  const std::optional<Image> two = studio.draw();
  studio.options.appearance.front = pliant::Color{0.9, 0.1, 0.1};
  const std::optional<Image> given = studio.draw();
  if (!two || !given) return;
  const auto tones = [](const Image& image) { return std::pair(at(image, 0, 0.1), at(image, 0.7, 0.1)); };
  const auto [left_tone, right_tone] = tones(*two);
  CHECK(distance(left_tone, right_tone) > 60);
  CHECK(left_tone[0] > left_tone[2]);    // red
  CHECK(right_tone[2] > right_tone[0]);  // blue
  const auto [left_given, right_given] = tones(*given);
  CHECK(distance(left_given, right_given) < 12);
  std::vector<std::uint32_t> held;
  for (std::uint32_t i = 0; i < 81; ++i) held.push_back(i);
  CHECK(make_render_mesh(studio.bodies).tones.back() == 1);
  CHECK(make_render_mesh(studio.bodies, held).tones.back() == 0);
  const std::vector<pliant::Body> eight(8, studio.bodies[0]);
  CHECK(make_render_mesh(eight).tones.back() == 0);  // they begin anew after seven
}

TEST_CASE("what is held as a whole has the tone of colliders on both sides, unless values are shown") {
  Studio studio;
  studio.options.appearance.front = studio.options.appearance.back = pliant::Color{0.9, 0.1, 0.1};
  for (std::uint32_t i = 0; i < 81; ++i) studio.frame.held.push_back(i);
  const std::optional<Image> one = studio.draw();
  studio.options.appearance.camera.position = pliant::Vec3(0, 3, 0);
  const std::optional<Image> other = studio.draw();
  if (!one || !other) return;
  for (const Rgb& tone : {at(*one, 0.1, 0.1), at(*other, 0.1, 0.1)}) {
    CHECK(tone[2] > tone[0]);
    CHECK(tone[0] > 60);
  }
  studio.options.appearance.color = pliant::ColorBy::speed;
  studio.frame.values.assign(81, 0);
  const std::optional<Image> with_values = studio.draw();
  studio.frame.held.clear();
  const std::optional<Image> free = studio.draw();
  CHECK(difference(*with_values, *free) == 0);
}

TEST_CASE("marks are drawn only when asked for, in a tone that no body has, edges too, and both are small") {
  Studio studio;
  studio.options.appearance.front = studio.options.appearance.back = pliant::Color{0.3, 0.6, 0.4};
  const std::optional<Image> plain = studio.draw();
  if (!plain) return;
  studio.frame.markers = {40};  // the middle of 9 x 9
  CHECK(difference(*plain, *studio.draw()) == 0);
  studio.options.appearance.markers = true;
  const std::optional<Image> marked = studio.draw();
  const Rgb mark = at(*marked, 0, 0);
  CHECK(*std::ranges::min_element(mark) > 215);
  CHECK(difference(*plain, *marked) > 0);
  CHECK(difference(*plain, *marked) < 0.003);
  studio.frame.markers.clear();
  studio.options.appearance.wireframe = true;
  const std::optional<Image> wired = studio.draw();
  CHECK(difference(*plain, *wired) > 0.02);
  CHECK(difference(*plain, *wired) < 0.2);
}

TEST_CASE("values are told by the colors of the map, with a legend beside") {
  Studio studio;
  studio.options.appearance.color = pliant::ColorBy::speed;
  studio.options.appearance.legend = false;
  studio.options.range = {0, 2};
  const auto map = color_map(pliant::ColorBy::speed);
  int last = -1;
  for (const float value : {0.0F, 1.0F, 2.0F}) {
    studio.frame.values.assign(studio.frame.positions.size(), value);
    const std::optional<Image> image = studio.draw();
    if (!image) return;
    const Rgb seen = at(*image, 0.1, 0.1);
    CHECK(seen[0] + seen[1] + seen[2] > last);
    last = seen[0] + seen[1] + seen[2];
    const auto& expected = map[static_cast<std::size_t>(value / 2 * 255)];
    // Lit from the side: the hue stays, the brightness is another.
    const double ratio = static_cast<double>(seen[1]) / expected[1];
    CHECK(ratio > 0.6);
    CHECK(ratio < 1.25);
  }
  const std::optional<Image> without = studio.draw();
  studio.options.appearance.legend = true;
  const std::optional<Image> with = studio.draw();
  CHECK(difference(*without, *with) > 0.01);
  // The upper end of the bar has the last color of the map, unlit.
  const Rgb top = at(*with, 1 - 2.0 * 30 * 0.65 / 320, 1 - 2 * 0.32);
  CHECK(distance(top, {map[250][0], map[250][1], map[250][2]}) < 30);
}

TEST_CASE("a body throws its shadow on the ground, on the side that is away from the light") {
  Studio studio;
  studio.options.appearance.camera.position = pliant::Vec3(0, -3, 3);
  studio.options.appearance.camera.target = pliant::Vec3(0, 0, -0.6);
  studio.options.appearance.light = pliant::Vec3(-1, 0, 1);
  studio.options.appearance.ground = true;
  studio.options.ground_height = -0.6F;
  for (Vec3f& p : studio.frame.positions) p = {0.2F * p.x(), p.z(), 0.2F * p.x()};  // lies along y, low
  const std::optional<Image> bare = studio.draw();
  studio.options.appearance.shadow = true;
  const std::optional<Image> shaded = studio.draw();
  if (!bare || !shaded) return;
  CHECK(difference(*bare, *shaded) > 0.01);
  int darker_left = 0, darker_right = 0;
  for (double v = -0.9; v < 0.9; v += 0.02) {
    for (double u = 0.02; u < 0.9; u += 0.02) {
      darker_right += at(*bare, u, v)[1] > at(*shaded, u, v)[1] + 8;
      darker_left += at(*bare, -u, v)[1] > at(*shaded, -u, v)[1] + 8;
    }
  }
  CHECK(darker_right > 20);
  CHECK(darker_left < darker_right / 4);
}

TEST_CASE("flat shading has an edge where smooth shading has none, and samples soften the outline") {
  Studio studio;
  for (Vec3f& p : studio.frame.positions) p.y() = 0.6F * std::abs(p.x());  // a fold in the middle
  const std::optional<Image> smooth = studio.draw();
  studio.options.appearance.shading = pliant::Shading::flat;
  const std::optional<Image> flat = studio.draw();
  if (!smooth || !flat) return;
  const auto step = [](const Image& image) { return distance(at(image, -0.012, 0.1), at(image, 0.012, 0.1)); };
  CHECK(step(*flat) > 2 * step(*smooth) + 10);
  studio.options.samples = 1;
  const std::optional<Image> hard = studio.draw();
  CHECK(difference(*flat, *hard) > 0);
}

TEST_CASE("ropes are drawn, the wind has its arrow, and a frame of nothing is the background") {
  Studio studio;
  studio.show_rope();
  const std::optional<Image> image = studio.draw();
  if (!image) return;
  const Rgb background = rgb(studio.options.appearance.background);
  CHECK(distance(at(*image, 0.1, 0), background) > 60);
  CHECK(distance(at(*image, 0.1, 0.05), background) < 4);
  studio.options.appearance.color = pliant::ColorBy::speed;
  studio.options.appearance.legend = false;
  studio.options.appearance.ground = studio.options.appearance.shadow = true;  // whose shadow is a texture as well
  studio.options.ground_height = -2;
  studio.frame.values = {0, 0};
  const Rgb slow = at(*studio.draw(), 0.1, 0);
  CHECK(slow[2] > slow[0]);
  studio.frame.values = {1, 1};
  const Rgb fast = at(*studio.draw(), 0.1, 0);
  CHECK(fast[0] > fast[2]);
  CHECK(fast[1] > fast[2]);
  studio.options.appearance.color = pliant::ColorBy::none;
  studio.options.appearance.ground = studio.options.appearance.shadow = false;
  studio.wind = WindAnnotation{{1, 0, 0}, "wind 1 m/s"};
  CHECK(difference(*image, *studio.draw()) > 0.002);
  studio.wind.reset();
  studio.bodies.clear();
  studio.frame.positions.clear();
  const std::optional<Image> nothing = studio.draw();
  for (const double u : {-0.9, 0.0, 0.9}) CHECK(distance(at(*nothing, u, 0.3), background) < 4);
}

TEST_CASE("a size past what the driver draws is refused") {
  Studio studio;
  studio.options.appearance.size = {1 << 20, 16};
  try {
    PictureMaker maker(make_render_mesh(studio.bodies), studio.options);
    FAIL("a picture of a million columns");
  } catch (const pliant::Error& error) {
    const std::string message = error.what();
    CHECK((contains(message, "size: ") || contains(message, "OpenGL: ")));
  }
}

}  // namespace test_pictures
