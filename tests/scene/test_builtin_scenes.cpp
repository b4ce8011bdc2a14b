// The built-in scenes run, say what they are, and show what they promise.
#include <algorithm>
#include <array>
#include <string>

#include <doctest/doctest.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/topology.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/scene.h"
#include "whole_scenes.h"

namespace test_builtin_scenes {

namespace {

using namespace pliant;
using pliant_tests::runs_whole_scenes;

Scene load(const BuiltinScene& builtin) {
  return parse_scene(builtin.text, "", builtin.name);
}

Scene load(std::string_view name) {
  const auto found = std::ranges::find(builtin_scenes(), name, &BuiltinScene::name);
  REQUIRE(found != builtin_scenes().end());
  return load(*found);
}

/// Calls f(scene, number of the step) after each step.
void run(Scene& scene, std::int64_t steps, auto&& f) {
  for (std::int64_t i = 1; i <= steps; ++i) {
    scene.step();
    f(scene, i);
  }
}
void run(Scene& scene, std::int64_t steps) {
  run(scene, steps, [](const Scene&, std::int64_t) {});
}

const Positions& positions(const Scene& scene) {
  return scene.simulation.state().positions;
}

Real enclosed_volume(const std::vector<Triangle>& triangles, const Positions& x) {
  Real volume = 0;
  for (const auto& [a, b, c] : triangles) {
    volume += tetrahedron_volume(Vec3::Zero(), row(x, a), row(x, b), row(x, c));
  }
  return volume;
}

/// Shortest and longest of the edges, relative to the rest positions.
std::array<Real, 2> stretch(const Mesh& mesh, const Positions& x) {
  const std::vector<Edge> edges = unique_edges(mesh);
  const std::vector<Real> rest = edge_lengths(mesh.vertices, edges);
  const std::vector<Real> now = edge_lengths(x, edges);
  std::array<Real, 2> range{now[0] / rest[0], now[0] / rest[0]};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    range = {std::min(range[0], now[e] / rest[e]), std::max(range[1], now[e] / rest[e])};
  }
  return range;
}

const std::vector<Index>& vertex_group(const Mesh& mesh, std::string_view name) {
  const auto found = std::ranges::find(mesh.vertex_groups, name, &VertexGroup::name);
  REQUIRE(found != mesh.vertex_groups.end());
  return found->vertices;
}

Vec3 middle(const std::vector<Index>& vertices, const Positions& x) {
  Vec3 sum = Vec3::Zero();
  for (const Index vertex : vertices) sum += row(x, vertex);
  return sum / static_cast<Real>(vertices.size());
}

/// What must hold of every scene, whatever it shows.
void check_sound(const Scene& scene) {
  CHECK(positions(scene).allFinite());
  CHECK(scene.simulation.state().velocities.allFinite());
  CHECK(scene.simulation.warnings().empty());
}

/// These run to their end in test cases of their own, below, in test_contact_scenes.cpp, test_surface_scenes.cpp,
/// test_sewn_scenes.cpp and test_gallery_scenes.cpp.
constexpr std::array own_cases = {"block",         "chain_mail",
                                  "funnel",        "reef_knot",
                                  "tablecloth",    "turning_ball",
                                  "fold",          "layers",
                                  "pile",          "rope_coil",
                                  "twist",         "ball",
                                  "conveyor",      "dancer",
                                  "drapes",        "flagpole",
                                  "hand",          "materials",
                                  "net",           "pillow",
                                  "rope_bridge",   "slope",
                                  "torus",         "towel",
                                  "trampoline",    "dress_from_panels",
                                  "parachute",     "plank_bridge",
                                  "walkers",       "trampoline_crowd",
                                  "silk_on_figure"};

TEST_CASE("every built-in scene runs") {
  CHECK(builtin_scenes().size() >= 20);
  for (const BuiltinScene& builtin : builtin_scenes()) {
    CAPTURE(builtin.name);
    Scene scene = load(builtin);
    CHECK(scene.name == builtin.name);
    CHECK(scene.description.size() > 20);
    CHECK(scene.description.find('\n') == std::string::npos);
    CHECK(scene.description.find("watch") != std::string::npos);
    CHECK(scene.description == scene_description(builtin.text, builtin.name));
    const Positions start = positions(scene);
    const Real size = bounding_box(start).diagonal();
    Real farthest = 0;
    const bool is_whole = runs_whole_scenes && std::ranges::find(own_cases, builtin.name) == own_cases.end();
    run(scene, is_whole ? scene.steps : 30, [&](const Scene& now, std::int64_t) {
      farthest = std::max(farthest, (positions(now) - start).cwiseAbs().maxCoeff());
    });
    check_sound(scene);
    CHECK(farthest > 1e-3);
    CHECK(farthest < 3 * size);  // nothing flies away
  }
}

// With contact friction begins a new objective within the step; tests/solver/test_contact_impact.cpp has colliders.
TEST_CASE("the objective rises in no iteration of any built-in scene without contact") {
  for (const BuiltinScene& builtin : builtin_scenes()) {
    CAPTURE(builtin.name);
    Scene scene = load(builtin);
    if (!scene.simulation.colliders().empty() || scene.simulation.contact().surfaces) continue;
    run(scene, 30, [](Scene& now, std::int64_t) {
      Real before = now.simulation.objective_history().front();
      for (const Real objective : now.simulation.objective_history()) {
        CHECK(objective <= before * (1 + 1e-12));
        before = objective;
      }
      CHECK(now.simulation.evaluate().objective() <= before * (1 + 1e-12));
    });
  }
}

TEST_CASE("torus: jerked about and let come home, it has its shape again" * doctest::skip(!runs_whole_scenes)) {
  Scene scene = load("torus");
  const Mesh& mesh = scene.simulation.body(BodyId{0}).mesh;
  const Real rest = enclosed_volume(mesh.triangles, mesh.vertices);
  Real worst = 0;
  run(scene, 300, [&](const Scene& now, std::int64_t) {
    worst = std::max(worst, std::abs(enclosed_volume(mesh.triangles, positions(now)) / rest - 1));
  });
  CHECK(worst > 0.1);
  run(scene, 300);
  CHECK(enclosed_volume(mesh.triangles, positions(scene)) == doctest::Approx(rest).epsilon(0.02));
  const auto [shortest, longest] = stretch(mesh, positions(scene));
  CHECK(shortest > 0.91);
  CHECK(longest < 1.07);
  check_sound(scene);
}

TEST_CASE("net: it hangs between its posts, deepest under the load" * doctest::skip(!runs_whole_scenes)) {
  Scene scene = load("net");
  const Index center = 312;
  run(scene, 150);
  const Real idle = positions(scene)(center, 2);
  CHECK(idle < -0.5);
  CHECK(positions(scene).col(2).maxCoeff() == 0);
  run(scene, 110);
  const Real loaded = positions(scene)(center, 2);
  CHECK(loaded < idle - 0.1);
  CHECK(stretch(scene.simulation.body(BodyId{0}).mesh, positions(scene))[1] < 1.2);
  run(scene, 40);
  CHECK(positions(scene)(center, 2) > loaded + 0.1);
  run(scene, scene.steps - 300);
  check_sound(scene);
}

TEST_CASE("trampoline: the crate comes down through the mat's plane, bounces lower and lower, and dents it") {
  Scene scene = load("trampoline");
  if (!runs_whole_scenes) return;
  const std::vector<Index> crate = vertex_group(scene.simulation.body(BodyId{0}).mesh, "crate");
  std::vector<Real> heights;
  run(scene, scene.steps, [&](const Scene& now, std::int64_t) { heights.push_back(middle(crate, positions(now))[2]); });
  std::vector<Real> tops;
  for (std::size_t i = 100; i + 1 < heights.size(); ++i) {
    if (heights[i] > heights[i - 1] && heights[i] >= heights[i + 1]) tops.push_back(heights[i]);
  }
  CHECK(heights[85] > 0.5);
  CHECK(*std::ranges::min_element(heights) < 0);
  REQUIRE(tops.size() >= 4);
  for (std::size_t i = 1; i < 4; ++i) CHECK(tops[i] < tops[i - 1]);
  CHECK(heights.back() > 0);
  CHECK(heights.back() < 0.25);  // at rest on a flat mat its middle would be at 0.25 m
  check_sound(scene);
}

TEST_CASE("rope bridge: it sags, dips under the walker from end to end, and no plank comes off") {
  Scene scene = load("rope_bridge");
  const Mesh& mesh = scene.simulation.body(BodyId{0}).mesh;
  CHECK(mesh.vertex_count() == 2 * 27 * 5 + 12 * 24 - 12 * 4);
  CHECK(std::ranges::max(components(mesh)) == 0);
  CHECK(vertex_group(mesh, "planks").size() == 12 * 24);
  CHECK(vertex_group(mesh, "near side").size() == 27 * 5);
  if (!runs_whole_scenes) return;
  run(scene, 120);
  const auto deck_at = [&](Real x) {
    std::vector<Index> there;
    for (const Index vertex : vertex_group(mesh, "planks")) {
      if (std::abs(mesh.vertices(vertex, 0) - x) < 0.2) there.push_back(vertex);
    }
    return middle(there, positions(scene))[2];
  };
  const std::array idle{deck_at(1.4), deck_at(3.4), deck_at(5.4)};
  CHECK(idle[1] < -0.1);
  CHECK(idle[1] < idle[0]);
  CHECK(idle[1] < idle[2]);
  Real dip_near = 0;
  Real dip_far = 0;
  run(scene, 380, [&](const Scene&, std::int64_t step) {
    if (step < 120) dip_near = std::min(dip_near, deck_at(1.4) - idle[0]);
    if (step > 260) dip_far = std::min(dip_far, deck_at(5.4) - idle[2]);
  });
  CHECK(dip_near < -0.05);
  CHECK(dip_far < -0.05);
  run(scene, 100);
  CHECK(std::abs(deck_at(3.4) - idle[1]) < 0.2);
  check_sound(scene);
}

TEST_CASE("pillow: blown up it keeps its volume, and takes it again after each punch") {
  Scene scene = load("pillow");
  if (!runs_whole_scenes) return;
  const std::vector<Triangle>& triangles = scene.simulation.body(BodyId{0}).mesh.triangles;
  const auto volume = [&] { return enclosed_volume(triangles, positions(scene)); };
  const Real flat = volume();
  run(scene, 359);
  const Real blown_up = volume();
  CHECK(blown_up > 10 * flat);
  const Real middle_before = positions(scene)(11 * 29 + 14, 1);
  run(scene, 12);
  CHECK(positions(scene)(11 * 29 + 14, 1) > middle_before + 0.02);
  run(scene, 229);
  CHECK(volume() == doctest::Approx(blown_up).epsilon(0.01));
  run(scene, 360);
  CHECK(volume() == doctest::Approx(blown_up).epsilon(0.01));
  check_sound(scene);
}

TEST_CASE("materials: tin stays nearly level, cotton and rubber hang, rubber is the longest") {
  Scene scene = load("materials");
  if (!runs_whole_scenes) return;
  run(scene, scene.steps);
  const auto lowest = [&](std::string_view name) {
    for (const Body& body : scene.simulation.bodies()) {
      if (body.name != name) continue;
      return positions(scene).middleRows(body.first_vertex, body.mesh.vertex_count()).col(2).minCoeff();
    }
    return Real(0);
  };
  CHECK(lowest("tin") > -0.1);
  CHECK(lowest("cotton") < -0.2);
  CHECK(lowest("netting") < -0.3);
  CHECK(lowest("rubber") < lowest("netting"));
  CHECK(lowest("foam") > -0.3);
  CHECK(lowest("cushion") > -0.3);
  check_sound(scene);
}

TEST_CASE("hand: swung and jolted, it keeps its volume within a tenth and hangs as before" *
          doctest::skip(!runs_whole_scenes)) {
  Scene scene = load("hand");
  const std::vector<Triangle>& triangles = scene.simulation.body(BodyId{0}).mesh.triangles;
  const Real rest = enclosed_volume(triangles, positions(scene));
  const Positions start = positions(scene);
  Real farthest = 0;
  run(scene, scene.steps, [&](const Scene& now, std::int64_t) {
    farthest = std::max(farthest, (positions(now) - start).cwiseAbs().maxCoeff());
  });
  CHECK(farthest > 0.06);  // the wrist alone moves so far
  CHECK(enclosed_volume(triangles, positions(scene)) == doctest::Approx(rest).epsilon(0.1));
  CHECK((positions(scene) - start).cwiseAbs().maxCoeff() < 0.01);  // of 0.2 m
  check_sound(scene);
}

TEST_CASE("a scene's steps are the same from run to run") {
  Scene a = load(builtin_scenes().front());
  Scene b = load(builtin_scenes().front());
  run(a, 3);
  run(b, 3);
  CHECK(positions(a) == positions(b));
}

}  // namespace

}  // namespace test_builtin_scenes
