#include <doctest/doctest.h>

#include "pliant/mesh/shapes.h"
#include "render/picture_maker.h"
#include "viewer/picking.h"

namespace test_picking {

using namespace pliant_viewer;
using pliant_render::Viewpoint;

namespace {

struct Sheet {
  pliant::Simulation simulation;
  pliant_render::RenderMesh render_mesh;
  std::vector<Vec3f> positions;

  Sheet() {
    simulation.add_body(pliant::grid({.columns = 9, .rows = 7}), pliant::Mass::total(1));
    render_mesh = pliant_render::make_render_mesh(simulation.bodies());
    const pliant::Positions& x = simulation.state().positions;
    for (pliant::Index i = 0; i < simulation.state().vertex_count(); ++i) {
      // Uneven, so that each triangle lies in a plane of its own.
      Vec3f p = x.row(i).transpose().cast<float>();
      p.z() += 0.1F * std::sin(7 * p.x() + 5 * p.y());
      positions.push_back(p);
    }
  }
};

/// As the automatic camera sees it, with room for a legend.
Screen look_at(const Sheet& sheet, const Vec2f& size, float inset = 0) {
  const pliant::Camera camera{.position = pliant::Vec3(0.2, -1.1, 1.3)};
  return {place_camera(camera, pliant_render::bounds_of(sheet.positions), size.x() / size.y(), inset), size};
}

SurfacePoint point_of_triangle(const Sheet& sheet, std::size_t triangle, const Vec3f& weights) {
  return {{sheet.render_mesh.triangles[3 * triangle], sheet.render_mesh.triangles[3 * triangle + 1],
           sheet.render_mesh.triangles[3 * triangle + 2]},
          weights};
}

}  // namespace

TEST_CASE("a point of the surface, projected, is hit to half a pixel, whatever the shape of the window") {
  const Sheet sheet;
  for (const Vec2f& size : {Vec2f(1280, 720), Vec2f(600, 900), Vec2f(2000, 500)}) {
    CAPTURE(size.x());
    for (const float inset : {0.0F, 0.15F}) {
      const Screen screen = look_at(sheet, size, inset);
      for (std::size_t t = 0; t < sheet.render_mesh.triangles.size() / 3; t += 5) {
        const SurfacePoint known = point_of_triangle(sheet, t, {0.5F, 0.3F, 0.2F});
        const auto place = screen.place_of(known.position(sheet.positions));
        REQUIRE(place.has_value());
        const auto picked = pick_surface(sheet.render_mesh, sheet.positions, screen, *place, 0);
        REQUIRE(picked.has_value());
        const Vec3f found = picked->position(sheet.positions);
        CHECK((screen.place_of(found).value() - *place).norm() < 0.5F);
        CHECK((found - known.position(sheet.positions)).norm() < 1e-4F);
      }
    }
  }
}

TEST_CASE("what is drawn stands where the mouse finds it, also where a place of the mouse has four pixels") {
  Sheet sheet;
  for (const auto& size : {std::pair{800, 450}, std::pair{400, 600}, std::pair{900, 300}}) {
    const int width = size.first, height = size.second;
    for (const int scale : {1, 2}) {
      CAPTURE(width);
      CAPTURE(scale);
      const Screen screen = look_at(sheet, {static_cast<float>(width), static_cast<float>(height)});
      pliant_render::PictureOptions options;
      options.appearance.size = {scale * width, scale * height};
      options.appearance.camera.position = pliant::Vec3(0.2, -1.1, 1.3);
      options.appearance.ground = false;
      options.appearance.markers = true;
      options.appearance.background = {0.2, 0.2, 0.2};
      options.bounds = pliant_render::bounds_of(sheet.positions);
      pliant_render::PictureMaker maker(sheet.render_mesh, options);
      const std::uint32_t vertex = 24;
      const pliant_render::Image image = maker.draw({sheet.positions, {}, {vertex}}, {});
      Vec2f sum = Vec2f::Zero();
      float count = 0;
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
          const auto at =
              3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
          // Marks alone are white.
          if (image.pixels[at] < 190 || image.pixels[at + 1] < 190 || image.pixels[at + 2] < 190) continue;
          sum += Vec2f(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
          count += 1;
        }
      }
      REQUIRE(count > 4);
      const Vec2f seen = sum / count / static_cast<float>(scale);  // in places of the mouse
      CHECK((seen - screen.place_of(sheet.positions[vertex]).value()).norm() < 0.5F);
      CHECK(pick_vertex(std::array{vertex}, sheet.positions, screen, seen, 2) == vertex);
    }
  }
}

TEST_CASE("of two surfaces the nearer is hit, and beside them nothing") {
  Sheet sheet;
  const auto count = sheet.positions.size();
  const std::vector<Vec3f> first = sheet.positions;
  const std::vector<std::uint32_t> triangles = sheet.render_mesh.triangles;
  const Screen screen = look_at(sheet, {1280, 720});
  for (const Vec3f& p : first) {
    sheet.positions.push_back(p + 0.3F * (screen.viewpoint.eye - p));  // towards the eye
  }
  for (const std::uint32_t vertex : triangles) {
    sheet.render_mesh.triangles.push_back(vertex + static_cast<std::uint32_t>(count));
  }
  const SurfacePoint known = point_of_triangle(sheet, 20, {0.2F, 0.2F, 0.6F});
  const auto place = screen.place_of(known.position(sheet.positions));
  const auto picked = pick_surface(sheet.render_mesh, sheet.positions, screen, place.value(), 0);
  REQUIRE(picked.has_value());
  CHECK(picked->vertices[0] == known.vertices[0] + count);
  CHECK_FALSE(pick_surface(sheet.render_mesh, sheet.positions, screen, {2, 2}, 0).has_value());
}

TEST_CASE("ropes are hit within reach, and the point is where perspective has it") {
  pliant_render::RenderMesh render_mesh;
  render_mesh.vertex_count = 2;
  render_mesh.ropes = {0, 1};
  const std::vector<Vec3f> positions = {{-1, 0, 0}, {1, 3, 0}};  // away from the eye
  const Screen screen{{.eye = {0, -4, 0}, .target = {0, 0, 0}}, {1000, 500}};
  const Vec3f middle = 0.5F * (positions[0] + positions[1]);
  const Vec2f place = screen.place_of(middle).value();
  const auto picked = pick_surface(render_mesh, positions, screen, place + Vec2f(0, 3), 5);
  REQUIRE(picked.has_value());
  CHECK((picked->position(positions) - middle).norm() < 1e-4F);
  CHECK_FALSE(pick_surface(render_mesh, positions, screen, place + Vec2f(0, 7), 5).has_value());
}

TEST_CASE("a point that is carried along at its depth stays under the mouse") {
  const Sheet sheet;
  const Screen screen = look_at(sheet, {900, 600});
  const Vec3f point = sheet.positions[10];
  const float depth = screen.depth_of(point);
  const Vec2f to(777, 31);
  const Vec3f carried = screen.point_at(to, depth);
  CHECK((screen.place_of(carried).value() - to).norm() < 0.01F);
  CHECK(screen.depth_of(carried) == doctest::Approx(depth));
  CHECK_FALSE(screen.place_of(screen.viewpoint.eye - screen.viewpoint.forward()).has_value());
}

}  // namespace test_picking
