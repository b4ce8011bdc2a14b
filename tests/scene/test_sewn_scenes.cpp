// The built-in scenes of attachments: what is sewn or tied stays together, and the rest moves as such things do.
#include <algorithm>
#include <array>
#include <string_view>

#include <doctest/doctest.h>

#include "load_builtin_scene.h"
#include "pliant/collision/crossings.h"
#include "pliant/pliant.h"
#include "whole_scenes.h"

namespace test_sewn_scenes {

using namespace pliant;
using pliant_tests::load_builtin_scene;
using pliant_tests::runs_whole_scenes;

namespace {

const Body& body_of(const Scene& scene, std::string_view name) {
  const auto& bodies = scene.simulation.bodies();
  const auto found = std::ranges::find(bodies, name, &Body::name);
  REQUIRE(found != bodies.end());
  return *found;
}

Positions positions_of(const Scene& scene, std::string_view name) {
  const Body& body = body_of(scene, name);
  return scene.simulation.state().positions.middleRows(body.first_vertex, body.mesh.vertex_count());
}

Vec3 middle_of(const Scene& scene, std::string_view name) {
  return positions_of(scene, name).colwise().mean().transpose();
}

/// How far the vertices of two sides are apart, one by one in their order, at most [m].
Real widest_gap(const Scene& scene, std::string_view from, std::string_view from_side, std::string_view to,
                std::string_view to_side) {
  const auto side = [&](std::string_view body, std::string_view group) {
    return std::ranges::find(body_of(scene, body).mesh.vertex_groups, group, &VertexGroup::name)->vertices;
  };
  const std::vector<Index> a = side(from, from_side), b = side(to, to_side);
  REQUIRE(a.size() == b.size());
  const Positions x = positions_of(scene, from), y = positions_of(scene, to);
  Real widest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) widest = std::max(widest, (row(x, a[i]) - row(y, b[i])).norm());
  return widest;
}

/// Crossings of the panels but at their borders, where seams may leave a little of one in the other.
std::int64_t inner_crossings(const Scene& scene, const std::vector<std::string_view>& names) {
  std::vector<Triangle> triangles;
  for (const std::string_view name : names) {
    const Body& body = body_of(scene, name);
    std::vector<char> is_border(static_cast<std::size_t>(body.mesh.vertex_count()), 0);
    for (const Edge& edge : boundary_edges(body.mesh)) {
      for (const Index vertex : edge) is_border[static_cast<std::size_t>(vertex)] = 1;
    }
    const auto is_inner = [&](Index vertex) { return is_border[static_cast<std::size_t>(vertex)] == 0; };
    const Index first = body.first_vertex;
    for (const Triangle& t : body.mesh.triangles) {
      if (std::ranges::all_of(t, is_inner)) triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  std::int64_t count = 0;
  const std::vector<Edge> no_edges;
  visit_crossings({.positions = scene.simulation.state().positions, .triangles = triangles, .edges = no_edges},
                  [&](const Crossing&) { ++count; });
  return count;
}

}  // namespace

TEST_CASE("scene dress_from_panels: four panels become a dress that keeps its seams and swings") {
  Scene scene = load_builtin_scene("dress_from_panels");
  const auto hem = [&] { return positions_of(scene, "front skirt").leftCols<2>().rowwise().norm().maxCoeff(); };
  CHECK(widest_gap(scene, "front skirt", "left", "back skirt", "right") > 0.39);
  std::array<Real, 2> swing{};
  const std::int64_t steps = runs_whole_scenes ? scene.steps : 20;
  for (std::int64_t step = 1; step <= steps; ++step) {
    CAPTURE(step);
    scene.step();
    CHECK(inner_crossings(scene, {"front", "back", "front skirt", "back skirt"}) == 0);
    if (step == 190) swing[0] = hem();
    if (step > 200 && step < 320) swing[1] = std::max(swing[1], hem());
    if (step < 80) continue;
    CHECK(widest_gap(scene, "front skirt", "left", "back skirt", "right") < 2e-3);
    CHECK(widest_gap(scene, "front skirt", "right", "back skirt", "left") < 2e-3);
  }
  CHECK(scene.simulation.warnings().empty());
  if (!runs_whole_scenes) return;
  CHECK(swing[1] > swing[0] + 0.05);
  CHECK(positions_of(scene, "front").col(2).maxCoeff() > 1.4);  // it hangs on the shoulders
  CHECK(positions_of(scene, "front skirt").col(2).minCoeff() < 0.65);
}

TEST_CASE("scene parachute: the canopy brakes the fall, the parcel lands, and all lines hold" *
          doctest::skip(!runs_whole_scenes)) {
  Scene scene = load_builtin_scene("parachute");
  const auto farthest = [&] {
    const Positions lines = positions_of(scene, "lines"), canopy = positions_of(scene, "canopy");
    Real worst = 0;
    for (Index line = 0; line < 12; ++line) {
      worst = std::max(worst, (row(lines, 13 * line + 12) - row(canopy, 6 * line)).norm());
    }
    return worst;
  };
  std::array<Real, 3> heights{};  // after 0.5, 0.75 and 1.25 s
  for (int step = 1; step <= 75; ++step) {
    scene.step();
    CHECK(farthest() < 0.02);
    if (step == 30) heights[0] = middle_of(scene, "parcel").z();
    if (step == 45) heights[1] = middle_of(scene, "parcel").z();
  }
  heights[2] = middle_of(scene, "parcel").z();
  const Real speed = (heights[1] - heights[2]) / 0.5;
  CHECK(speed > 1.5);
  CHECK(speed < 3);  // 9.8 in free fall
  CHECK((heights[0] - heights[1]) / 0.25 == doctest::Approx(speed).epsilon(0.2));
  while (scene.simulation.state().step < scene.steps) scene.step();
  CHECK(middle_of(scene, "parcel").z() < 0.15);
  CHECK(positions_of(scene, "canopy").col(2).minCoeff() > 0);
  CHECK(positions_of(scene, "canopy").col(2).maxCoeff() < 1.2);
  CHECK(farthest() < 0.02);
  CHECK(scene.simulation.warnings().empty());
}

TEST_CASE("scene plank_bridge: it throws the crate up, and carries it in the end" * doctest::skip(!runs_whole_scenes)) {
  Scene scene = load_builtin_scene("plank_bridge");
  Real deepest = 1, thrown = 0;
  for (std::int64_t step = 1; step <= scene.steps; ++step) {
    scene.step();
    const Real height = middle_of(scene, "crate").z();
    deepest = std::min(deepest, height);
    thrown = std::max(thrown, height - deepest);
  }
  CHECK(deepest < 0);
  CHECK(thrown > 0.05);
  const Vec3 crate = middle_of(scene, "crate");
  CHECK(std::abs(crate.x() - 2.5) < 0.15);
  CHECK(std::abs(crate.y() - 0.4) < 0.15);
  // Nothing but the bridge is below it, and the boards hang on the ropes.
  const Vec3 boards = middle_of(scene, "boards"), ropes = middle_of(scene, "ropes");
  CHECK(crate.z() > ropes.z());
  CHECK(std::abs(boards.z() - ropes.z()) < 0.15);
  CHECK(scene.simulation.warnings().empty());
}

}  // namespace test_sewn_scenes
