// Light in pictures: shadows of bodies on bodies, corners that see little of the sky, edges of solids, samples.
#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "pliant/mesh/topology.h"
#include "render/hard_edges.h"
#include "render/offscreen_context.h"
#include "render/surface_programs.h"
#include "studio.h"
#include "viewer/quality_chooser.h"

namespace test_light {

using namespace pliant_render;
using namespace pliant_tests;

namespace {

int brightness(const Rgb& color) {
  return color[0] + color[1] + color[2];
}

/// A square that lies and another, a third as wide, above its middle, which the camera sees past.
Studio two_sheets() {
  Studio studio;
  const auto count = static_cast<std::uint32_t>(studio.frame.positions.size());
  for (Vec3f& p : studio.frame.positions) p = {p.x(), p.z(), 0};
  for (std::uint32_t i = 0; i < count; ++i) {
    studio.frame.positions.push_back(0.3F * studio.frame.positions[i] + Vec3f(0, 0, 0.5F));
  }
  studio.bodies.push_back({"upper", studio.bodies[0].mesh, static_cast<pliant::Index>(count)});
  studio.options.appearance.camera.position = pliant::Vec3(0, -2, 1.2);
  studio.options.appearance.light = pliant::Vec3(0, 0, 1);
  studio.options.bounds = bounds_of(studio.frame.positions);
  return studio;
}

pliant::Mesh crate() {
  return pliant::bar({.cells = {3, 3, 3}, .size = {1, 1, 1}});
}

}  // namespace

TEST_CASE("a body throws a shadow on another, where the light comes from, and none at low quality") {
  Studio studio = two_sheets();
  const std::optional<Image> bare = studio.draw();
  studio.options.appearance.shadow = true;
  const std::optional<Image> shaded = studio.draw();
  studio.options.appearance.quality = pliant::Quality::low;
  const std::optional<Image> low = studio.draw();
  if (!bare || !shaded) return;
  const auto in_shadow = [&](const Image& image) { return brightness(at(image, 0, -0.05)); };
  const auto beside = [&](const Image& image) { return brightness(at(image, 0.42, -0.05)); };
  CHECK(in_shadow(*shaded) < in_shadow(*bare) - 60);
  CHECK(std::abs(beside(*shaded) - beside(*bare)) < 6);
  CHECK(std::abs(in_shadow(*low) - beside(*low)) < 6);
  // The light comes from the left now, and the shadow lies on the right.
  studio.options.appearance.quality = pliant::Quality::high;
  studio.options.appearance.light = pliant::Vec3(-0.6, 0, 1);
  const std::optional<Image> aside = studio.draw();
  CHECK(brightness(at(*aside, 0.25, -0.05)) < brightness(at(*aside, -0.25, -0.05)) - 60);
}

TEST_CASE("what is lit throws no shadow on itself") {
  Studio studio;
  studio.options.appearance.shadow = true;
  for (const pliant::Vec3& light :
       {pliant::Vec3(0, -1, 0.2), pliant::Vec3(-1, -0.3, 0.5), pliant::Vec3(0.8, -0.1, 0)}) {
    CAPTURE(light.transpose());
    studio.options.appearance.light = light;
    studio.options.appearance.quality = pliant::Quality::high;
    const std::optional<Image> high = studio.draw();
    studio.options.appearance.quality = pliant::Quality::low;
    const std::optional<Image> low = studio.draw();
    if (!high) return;
    CHECK(difference(*high, *low) == 0);
  }
}

TEST_CASE("it is darker in a corner that sees less of the sky, and nowhere on what is flat") {
  Studio studio;
  const std::optional<Image> flat = studio.draw();
  studio.options.appearance.quality = pliant::Quality::low;
  const std::optional<Image> flat_low = studio.draw();
  if (!flat) return;
  CHECK(difference(*flat, *flat_low) == 0);
  for (Vec3f& p : studio.frame.positions) p.y() = -1.5F * std::abs(p.x());  // a valley, open towards the eye
  const std::optional<Image> low = studio.draw();
  studio.options.appearance.quality = pliant::Quality::high;
  const std::optional<Image> high = studio.draw();
  CHECK(brightness(at(*high, 0, 0)) < brightness(at(*low, 0, 0)) - 15);
  CHECK(brightness(at(*high, 0, 0)) < brightness(at(*high, 0.3, 0)) - 10);
}

TEST_CASE("a crate has six evenly lit faces, with an edge between them") {
  Studio studio;
  studio.bodies = {{"crate", crate(), 0}};
  studio.frame.positions = to_floats(studio.bodies[0].mesh.vertices);
  const Vec3f middle = bounds_of(studio.frame.positions).center();
  studio.options.bounds = bounds_of(studio.frame.positions);
  studio.options.appearance.quality = pliant::Quality::low;
  studio.options.appearance.camera.target = middle.cast<double>();
  studio.options.appearance.camera.position = middle.cast<double>() + pliant::Vec3(0, -4, 0);
  const std::optional<Image> front = studio.draw();
  if (!front) return;
  CHECK(distance(at(*front, -0.15, 0.25), at(*front, 0.15, -0.25)) < 12);
  studio.options.appearance.camera.position = middle.cast<double>() + pliant::Vec3(-2.5, -2.5, 0);
  const std::optional<Image> edge = studio.draw();
  CHECK(distance(at(*edge, -0.02, 0), at(*edge, 0.02, 0)) > 18);
}

TEST_CASE("vertices are copied at the edges of a crate and nowhere on a sheet or a ball") {
  pliant::Mesh mesh = crate();
  const std::vector<pliant::Triangle> skin = pliant::boundary_triangles(mesh.tetrahedra);
  const ShadedCorners corners = split_at_hard_edges(mesh.vertices, skin);
  REQUIRE(corners.numbers.size() == 3 * skin.size());
  CHECK(corners.copies.size() == 8 * 2 + 12 * 2);  // corners belong to three faces, the two vertices of an edge to two
  const auto count = static_cast<std::uint32_t>(mesh.vertex_count());
  for (std::size_t i = 0; i < corners.numbers.size(); ++i) {
    const std::uint32_t number = corners.numbers[i];
    const std::uint32_t vertex = number < count ? number : corners.copies.at(number - count);
    CHECK(vertex == static_cast<std::uint32_t>(skin[i / 3][i % 3]));
  }
  // What one number has lies on one face.
  std::vector<std::set<int>> faces(count + corners.copies.size());
  for (std::size_t t = 0; t < skin.size(); ++t) {
    const pliant::Vec3 a = mesh.vertices.row(skin[t][0]).transpose(), b = mesh.vertices.row(skin[t][1]).transpose(),
                       c = mesh.vertices.row(skin[t][2]).transpose();
    const pliant::Vec3 normal = (b - a).cross(c - a);
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const int face = 2 * static_cast<int>(axis) + (normal[axis] > 0 ? 1 : 0);
    for (std::size_t k = 0; k < 3; ++k) faces[corners.numbers[3 * t + k]].insert(face);
  }
  for (const std::set<int>& each : faces) CHECK(each.size() <= 1);

  const pliant::Mesh sheet = pliant::grid({.columns = 5, .rows = 4});
  CHECK(split_at_hard_edges(sheet.vertices, sheet.triangles).copies.empty());
  const pliant::Mesh ring = pliant::torus({});
  const auto triangles = ring.triangles.empty() ? pliant::boundary_triangles(ring.tetrahedra) : ring.triangles;
  CHECK(split_at_hard_edges(ring.vertices, triangles).copies.empty());
  CHECK(split_at_hard_edges(sheet.vertices, {}).numbers.empty());
}

TEST_CASE("a picture has as many samples as were asked for, and looks the same but for its outlines") {
  Studio studio;
  for (Vec3f& p : studio.frame.positions) p = {p.x() + 0.31F * p.z(), p.y(), p.z()};  // slanted sides
  std::vector<std::size_t> tones;
  std::optional<Image> first;
  for (const int samples : {1, 4, 16}) {
    CAPTURE(samples);
    studio.options.samples = samples;
    const std::optional<Image> image = studio.draw();
    if (!image) return;
    CHECK(PictureMaker(make_render_mesh(studio.bodies), studio.options).samples() == samples);
    std::set<Rgb> seen;
    for (int x = 0; x < image->width; ++x) {
      for (double v = -0.3; v < 0.3; v += 0.02) seen.insert(at(*image, 2.0 * x / image->width - 1, v));
    }
    tones.push_back(seen.size());
    if (!first) first = image;
    CHECK(difference(*first, *image) < 0.03);
  }
  CHECK(tones[1] > tones[0]);
  CHECK(tones[2] > tones[1]);
}

TEST_CASE("a window leaves light out where pictures take too long, unless the scene says otherwise") {
  using pliant::Quality;
  pliant_viewer::QualityChooser chooser;
  CHECK(chooser.choose(Quality::automatic) == Quality::high);
  chooser.add(5);  // while the driver compiles
  for (int i = 0; i < 100; ++i) chooser.add(0.03);
  CHECK(chooser.choose(Quality::automatic) == Quality::high);
  for (int i = 0; i < 16; ++i) chooser.add(0.06);
  CHECK(chooser.choose(Quality::automatic) == Quality::low);
  CHECK(chooser.choose(Quality::high) == Quality::high);
  for (int i = 0; i < 100; ++i) chooser.add(0.001);
  CHECK(chooser.choose(Quality::automatic) == Quality::low);  // does not go to and fro
  chooser.forget();
  CHECK(chooser.choose(Quality::automatic) == Quality::high);
  CHECK(chooser.choose(Quality::low) == Quality::low);
}

TEST_CASE("ropes are lit as tubes, and what hangs above them keeps light away") {
  Studio studio;
  studio.show_rope();
  studio.options.appearance.camera.position = pliant::Vec3(0, -1, 0);
  studio.options.appearance.camera.field_of_view = 40;
  studio.options.appearance.light = pliant::Vec3(0, 0, 1);
  const std::optional<Image> from_above = studio.draw();
  if (!from_above) return;
  const auto brightest = [](const Image& image, double from, double to) {  // of rows near the middle
    int most = 0;
    for (double v = from; v <= to; v += 1.0 / image.height) {
      const Rgb color = at(image, 0.1, v);
      if (color[0] > color[2] + 20) most = std::max(most, brightness(color));  // the rope is brown
    }
    return most;
  };
  const int top = brightest(*from_above, 0, 0.02);
  CHECK(top > brightest(*from_above, -0.02, -0.001) + 10);
  studio.options.appearance.light = pliant::Vec3(0, 0, -1);
  CHECK(brightest(*studio.draw(), 0, 0.02) < top - 10);

  // A sheet above the right half of it.
  const pliant::Mesh sheet = pliant::grid({.columns = 9, .rows = 9, .size = {1, 1}});
  const auto first = static_cast<pliant::Index>(studio.frame.positions.size());
  for (pliant::Index i = 0; i < sheet.vertex_count(); ++i) {
    const pliant::Vec3 x = sheet.vertices.row(i).transpose();
    studio.frame.positions.push_back({static_cast<float>(x.x()), static_cast<float>(x.y() + x.z() - 0.5), 0.3F});
  }
  studio.bodies.push_back({"sheet", sheet, first});
  studio.options.bounds = bounds_of(studio.frame.positions);
  studio.options.appearance.light = pliant::Vec3(0, 0, 1);
  studio.options.appearance.shadow = true;
  const Image shaded = *studio.draw();
  const auto brightest_at = [&](double u) {
    int most = 0;
    for (double v = -0.02; v <= 0.02; v += 1.0 / shaded.height) {
      const Rgb color = at(shaded, u, v);
      if (color[0] > color[2] + 20) most = std::max(most, brightness(color));
    }
    return most;
  };
  CHECK(brightest_at(0.5) > 0);
  CHECK(brightest_at(0.5) < brightest_at(-0.5) - 30);
}

TEST_CASE("pictures can be drawn with the camera among the bodies, and with all bodies beside the picture") {
  Studio studio = two_sheets();
  studio.options.appearance.shadow = studio.options.appearance.ground = true;
  for (const pliant::Vec3& eye : {pliant::Vec3(0.1, -0.2, 0.2), pliant::Vec3(0, 0, 0.01), pliant::Vec3(30, -2, 0)}) {
    studio.options.appearance.camera.position = eye;
    studio.options.appearance.camera.target = eye + pliant::Vec3(0, 1, -0.1);
    std::optional<PictureMaker> maker;
    if (!make_if_drawable(maker, make_render_mesh(studio.bodies), studio.options)) return;
    maker->draw(studio.frame, {});
    CHECK(glGetError() == GL_NO_ERROR);
  }
  const Image beside = *studio.draw();  // of the last one, in which nothing but the ground is seen
  CHECK(distance(at(beside, 0, -0.9), at(beside, -0.5, -0.9)) < 12);
}

TEST_CASE("what a picture has of the light does not depend on the picture before") {
  Studio studio = two_sheets();
  studio.options.appearance.shadow = studio.options.appearance.ground = true;
  studio.options.ground_height = -0.02F;
  studio.options.appearance.camera.position = pliant::Vec3(0, -4, 2);
  std::optional<PictureMaker> maker;
  if (!make_if_drawable(maker, make_render_mesh(studio.bodies), studio.options)) return;
  const auto wall = [&studio](float x) {
    FrameContent frame = studio.frame;
    for (Vec3f& p : frame.positions) p = {x, p.y(), p.x() + 0.48F};
    return frame;
  };
  // What is looked up ends at another pixel each time, where the foot of a wall was dark before, or not.
  for (float x = 0.3F; x < 0.32F; x += 0.002F) {
    FrameContent aside = studio.frame;
    for (Vec3f& p : aside.positions) p = 0.4F * p + Vec3f(x, 0, 0);
    maker->draw(wall(x + 0.26F), {});
    const Image after_wall = maker->draw(aside, {});
    maker->draw(wall(-2), {});
    CHECK(maker->draw(aside, {}).pixels == after_wall.pixels);
  }
}

TEST_CASE("programs of surfaces compile with any two traits") {
  std::optional<OffscreenContext> context;
  if (!make_if_drawable(context)) return;
  constexpr std::array<bool SurfaceTraits::*, 11> traits = {
      &SurfaceTraits::is_colored,    &SurfaceTraits::has_looks,   &SurfaceTraits::has_fields,
      &SurfaceTraits::has_gradient,  &SurfaceTraits::has_picture, &SurfaceTraits::has_weave,
      &SurfaceTraits::has_cloth,     &SurfaceTraits::has_gloss,   &SurfaceTraits::has_shadows,
      &SurfaceTraits::has_occlusion, &SurfaceTraits::is_flat};
  SurfacePrograms programs;
  std::set<const Program*> made;
  SurfaceTraits all;
  for (const auto first : traits) {
    for (const auto second : traits) {
      SurfaceTraits both;
      both.*first = both.*second = true;
      made.insert(&programs.of(both));
      all = all.with(both);
    }
  }
  CHECK(made.size() == 11 + 11 * 10 / 2);
  made.insert(&programs.of(all));
  for (const bool is_lit : {false, true}) {
    made.insert(&programs.of({.is_solid = true, .has_shadows = is_lit, .has_occlusion = is_lit}));
    made.insert(&programs.of({.is_rope = true, .has_shadows = is_lit, .has_occlusion = is_lit}));
  }
  CHECK(made.size() == 66 + 1 + 4);
}

}  // namespace test_light
