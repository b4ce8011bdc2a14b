#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "pliant/collision/colliders/builtin.h"
#include "pliant/mesh/shapes.h"
#include "render/picture_maker.h"
#include "viewer/vertex_region.h"

namespace test_vertex_region {

using namespace pliant_viewer;

namespace {

constexpr std::uint32_t sheet_size = 21 * 15;

/// A sheet that is folded over itself, a ball before a part of it, and a rope.
struct Still {
  pliant::Simulation simulation;
  pliant_render::RenderMesh render_mesh;
  std::vector<Vec3f> positions;
  std::vector<pliant_render::DrawnCollider> colliders;
  Screen screen;

  Still() {
    simulation.add_body(pliant::grid({.columns = 21, .rows = 15, .size = {2, 1}, .plane = pliant::Plane::xy}),
                        pliant::Mass::total(1));
    simulation.add_body(pliant::chain({.links = 12, .direction = {1, 0, 0}}), pliant::Mass::total(1));
    simulation.add(pliant::SphereCollider{.center = {0.6, 0.1, 0.5}, .radius = 0.2});
    render_mesh = pliant_render::make_render_mesh(simulation.bodies());
    pliant_render::ColliderSurfaces surfaces;
    colliders = surfaces.find(simulation);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(simulation.state().vertex_count()); ++i) {
      Vec3f p = simulation.state().positions.row(i).transpose().cast<float>();
      p += i < sheet_size ? Vec3f(-1, -0.5F, 0) : Vec3f(-0.5F, 0.9F, 0);
      if (i < sheet_size && p.x() < -0.2F) p = Vec3f(-0.4F - p.x(), p.y(), 0.2F + 0.1F * std::sin(9 * p.y()));
      positions.push_back(p);
    }
    const pliant::Camera camera{.position = pliant::Vec3(0.3, -2.1, 2.3)};
    const Vec2f size(800, 600);
    screen = {place_camera(camera, pliant_render::bounds_of(positions), size.x() / size.y()), size};
  }
  Sight sight() const { return {screen, render_mesh, positions, colliders}; }
};

std::vector<std::uint32_t> range(std::uint32_t begin, std::uint32_t end) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = begin; i < end; ++i) list.push_back(i);
  return list;
}

}  // namespace

TEST_CASE("a place is inside a line by how often that goes around it, however it was drawn") {
  for (const auto& [a, b] :
       {std::pair(Vec2f(10, 20), Vec2f(50, 80)), {Vec2f(50, 80), Vec2f(10, 20)}, {Vec2f(50, 20), Vec2f(10, 80)}}) {
    const Outline box = box_between(a, b);
    CHECK(contains(box, {30, 50}));
    CHECK(contains(box, {11, 79}));
    for (const Vec2f& outside : {Vec2f(9, 50), Vec2f(51, 50), Vec2f(30, 19), Vec2f(30, 81)})
      CHECK_FALSE(contains(box, outside));
  }
  const Outline hook = {{0, 0}, {40, 0}, {40, 40}, {30, 40}, {30, 10}, {0, 10}};
  CHECK(contains(hook, {35, 35}));
  CHECK(contains(hook, {5, 5}));
  CHECK_FALSE(contains(hook, {15, 30}));
  const Outline eight = {{0, 0}, {20, 20}, {20, 0}, {0, 20}};
  CHECK(contains(eight, {18, 10}));
  CHECK(contains(eight, {2, 10}));
  CHECK_FALSE(contains(eight, {10, 3}));
  CHECK_FALSE(contains({}, {0, 0}));
  CHECK_FALSE(contains({{1, 1}}, {1, 1}));
}

TEST_CASE("a box takes what is seen in it, as rays from the eye tell, and through everything all that is drawn there") {
  const Still still;
  const Outline everything = box_between({-1e4F, -1e4F}, {1e4F, 1e4F});
  const auto all = vertices_inside(everything, still.sight(), true);
  CHECK(all == range(0, sheet_size + 13));
  const auto seen = vertices_inside(everything, still.sight(), false);
  std::size_t behind_sheet = 0, behind_ball = 0;
  for (const std::uint32_t vertex : all) {
    CAPTURE(vertex);
    const Vec3f& point = still.positions[vertex];
    const Vec2f place = still.screen.place_of(point).value();
    const auto front = pick_surface(still.render_mesh, still.positions, still.screen, place, 0);
    const auto ball = pick_collider(still.colliders, still.screen, place);
    const float depth = still.screen.depth_of(point);
    const bool is_behind_sheet = front && still.screen.depth_of(front->position(still.positions)) < 0.999F * depth;
    const bool is_behind_ball = ball && still.screen.depth_of(ball->position) < 0.99F * depth;
    behind_sheet += is_behind_sheet ? 1 : 0;
    behind_ball += is_behind_ball ? 1 : 0;
    CHECK(std::ranges::binary_search(seen, vertex) == (!is_behind_sheet && !is_behind_ball));
  }
  CHECK(behind_sheet > 20);
  CHECK(behind_ball > 5);
  Sight bare = still.sight();
  bare.colliders = {};  // hidden
  CHECK(vertices_inside(everything, bare, false).size() > seen.size());

  const Vec2f middle = still.screen.place_of(still.positions[200]).value();
  const Vec2f reach(60, 40);
  for (const std::uint32_t vertex : vertices_inside(box_between(middle - reach, middle + reach), still.sight(), true)) {
    const Vec2f from_middle = still.screen.place_of(still.positions[vertex]).value() - middle;
    CHECK((from_middle.array().abs() <= reach.array()).all());
  }
  CHECK(vertices_inside(box_between({0, 0}, {3, 3}), still.sight(), true).empty());
  CHECK(vertices_inside({}, still.sight(), true).empty());
}

TEST_CASE("what is behind the eye hides nothing that it should not, and is not selected") {
  Still still;
  still.positions[3] = still.screen.viewpoint.eye - 2 * still.screen.viewpoint.forward();
  const Outline everything = box_between({-1e4F, -1e4F}, {1e4F, 1e4F});
  const auto seen = vertices_inside(everything, still.sight(), true);
  CHECK_FALSE(std::ranges::binary_search(seen, 3U));
  CHECK(seen.size() == sheet_size + 12);
  const auto front = vertices_inside(everything, still.sight(), false);
  for (const std::uint32_t vertex : seen) {
    const Vec2f place = still.screen.place_of(still.positions[vertex]).value();
    const auto first = pick_surface(still.render_mesh, still.positions, still.screen, place, 0);
    const float depth = still.screen.depth_of(still.positions[vertex]);
    const bool is_hidden = first && still.screen.depth_of(first->position(still.positions)) < 0.999F * depth;
    if (is_hidden) CHECK_FALSE(std::ranges::binary_search(front, vertex));
  }
  CHECK(front.size() > 100);

  for (Vec3f& x : still.positions) x = 2 * still.screen.viewpoint.eye - x;  // all of it, but for that vertex
  CHECK(vertices_inside(everything, still.sight(), false) == std::vector<std::uint32_t>{3});
}

TEST_CASE("of two borders in the same place that of the vertex is meant") {
  pliant::Simulation simulation;
  const pliant::Mesh sheet = pliant::grid({.columns = 3, .rows = 3});
  pliant::Mesh both = sheet;
  both.vertices.conservativeResize(18, 3);
  both.vertices.bottomRows(9) = sheet.vertices;
  for (const auto& triangle : sheet.triangles)
    both.triangles.push_back({triangle[0] + 9, triangle[1] + 9, triangle[2] + 9});
  simulation.add_body(both, pliant::Mass::total(1));
  const auto mesh = pliant_render::make_render_mesh(simulation.bodies());
  const auto x = pliant_render::to_floats(simulation.state().positions);
  CHECK(border_at(mesh, x, 9) == std::vector<std::uint32_t>{9, 10, 11, 12, 14, 15, 16, 17});
  CHECK(border_at(mesh, x, 0) == std::vector<std::uint32_t>{0, 1, 2, 3, 5, 6, 7, 8});
}

TEST_CASE("the border of a sheet, of a hole in it, a rope, and none where a surface is closed") {
  const Still still;
  std::vector<std::uint32_t> border;
  for (std::uint32_t i = 0; i < sheet_size; ++i) {
    const bool is_outer = i % 21 == 0 || i % 21 == 20 || i / 21 == 0 || i / 21 == 14;
    if (is_outer) border.push_back(i);
  }
  CHECK(border_at(still.render_mesh, still.positions, 0) == border);
  CHECK(border_at(still.render_mesh, still.positions, 21 * 7 + 10) == border);  // from inside
  CHECK(border_at(still.render_mesh, still.positions, sheet_size + 5) == range(sheet_size, sheet_size + 13));

  pliant_render::RenderMesh holed = still.render_mesh;
  std::vector<std::uint32_t> rest;
  const std::uint32_t missing = 21 * 7 + 10;
  for (std::size_t t = 0; t + 2 < holed.triangles.size(); t += 3) {
    const std::span<const std::uint32_t> corners(&holed.triangles[t], 3);
    if (std::ranges::find(corners, missing) == corners.end()) rest.insert(rest.end(), corners.begin(), corners.end());
  }
  holed.triangles = rest;
  const auto hole = border_at(holed, still.positions, missing + 1);
  CHECK(hole.size() >= 4);
  CHECK(hole.size() <= 8);
  CHECK(std::ranges::binary_search(hole, missing + 1));
  CHECK(border_at(holed, still.positions, 0) == border);

  const pliant_render::RenderMesh ball = [] {
    pliant::Simulation simulation;
    simulation.add_body(pliant::sphere({.radius = 1}), pliant::Mass::total(1));
    return pliant_render::make_render_mesh(simulation.bodies());
  }();
  const std::vector<Vec3f> anywhere(static_cast<std::size_t>(ball.vertex_count), Vec3f::Zero());
  CHECK(border_at(ball, anywhere, 0).empty());
}

}  // namespace test_vertex_region
