// The built-in scenes with colliders, to their ends: no vertex is ever in a collider, cloth never passes through
// itself, and each shows what it promises.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "load_builtin_scene.h"
#include "pliant/collision/crossings.h"
#include "pliant/pliant.h"
#include "whole_scenes.h"

namespace test_contact_scenes {

namespace {

using namespace pliant;
using pliant_tests::load_builtin_scene;
using pliant_tests::runs_whole_scenes;

constexpr Real degree = std::numbers::pi / 180;

/// Of the vertex that is deepest in any collider [m]; below zero inside.
Real least_distance(const Simulation& simulation) {
  Real least = 1;
  const Positions& x = simulation.state().positions;
  for (const auto& [id, record] : simulation.colliders()) {
    const Pose pose = simulation.pose(id);
    for (Index v = 0; v < x.rows(); ++v) {
      least = std::min(least, record.shape->distance(pose.to_frame(x.row(v).transpose())).distance);
    }
  }
  return least;
}

/// Of each body with itself, which is all that may cross here.
std::int64_t crossings(const Simulation& simulation) {
  std::int64_t count = 0;
  for (const Body& body : simulation.bodies()) {
    const Positions x = simulation.state().positions.middleRows(body.first_vertex, body.mesh.vertex_count());
    const std::vector<Triangle> triangles = surface_triangles(body.mesh);
    visit_crossings({.positions = x, .triangles = triangles}, [&](const Crossing&) { ++count; });
  }
  return count;
}

/// Steps to the end of the scene, or only a few; f(simulation, step) after each.
void run_clear_of_colliders(Scene& scene, const std::function<void(const Simulation&, std::int64_t)>& f) {
  const std::int64_t steps = runs_whole_scenes ? scene.steps : 20;
  Real least = least_distance(scene.simulation);
  for (std::int64_t i = 1; i <= steps; ++i) {
    scene.step();
    least = std::min(least, least_distance(scene.simulation));
    REQUIRE(crossings(scene.simulation) == 0);
    f(scene.simulation, i);
  }
  CHECK(least > 0);
  CHECK(scene.simulation.contact().surfaces == (scene.name != "slope" && scene.name != "conveyor"));
  CHECK(scene.simulation.warnings().empty());
}

Real fastest(const Simulation& simulation) {
  return simulation.state().velocities.rowwise().norm().maxCoeff();
}

/// How many vertices touch a collider.
std::ptrdiff_t contacts_with(const Simulation& simulation, std::string_view name) {
  const auto id = simulation.find_collider(name);
  REQUIRE(id);
  return std::ranges::count(simulation.contacts(), static_cast<Index>(*id), &ContactPoint::collider);
}

auto rows_of(const Simulation& simulation, const Body& body) {
  return simulation.state().positions.middleRows(body.first_vertex, body.mesh.vertex_count());
}

Vec3 middle_of(const Simulation& simulation, const Body& body) {
  return rows_of(simulation, body).colwise().mean().transpose();
}

}  // namespace

TEST_CASE("towel: it comes to rest on the ball, the box and the floor") {
  Scene scene = load_builtin_scene("towel");
  run_clear_of_colliders(scene, [](const Simulation&, std::int64_t) {});
  if (!runs_whole_scenes) return;
  for (const char* name : {"ball", "box", "floor"}) CHECK(contacts_with(scene.simulation, name) > 20);
  // In some runs, whatever the last digits make of it, a corner swings for another second.
  for (int i = 0; i < 60 && fastest(scene.simulation) >= 0.03; ++i) scene.step();
  CHECK(fastest(scene.simulation) < 0.03);
}

TEST_CASE("slope: blocks slip when the slope is that of their friction, or stay") {
  Scene scene = load_builtin_scene("slope");
  const Simulation& simulation = scene.simulation;
  const std::array<std::string_view, 3> names{"ice", "wood", "rubber"};
  const std::array<Real, 3> frictions{0.15, 0.3, 0.6};
  const auto place_on_board = [&](std::size_t i) {
    return simulation.pose(*simulation.find_collider(names[i]))
        .to_frame(middle_of(simulation, simulation.bodies()[i]))
        .x();
  };
  std::array<Real, 3> start{}, slipped_at{90, 90, 90}, way{};
  run_clear_of_colliders(scene, [&](const Simulation&, std::int64_t step) {
    const Quaternion turn = simulation.pose(*simulation.find_collider("ice")).rotation;
    const Real slope = turn.angularDistance(Quaternion::Identity()) / degree;
    for (std::size_t i = 0; i < 3; ++i) {
      if (step == 10) start[i] = place_on_board(i);
      way[i] = step < 10 ? 0 : place_on_board(i) - start[i];
      if (slipped_at[i] == 90 && way[i] > 1e-3) slipped_at[i] = slope;
    }
  });
  if (!runs_whole_scenes) return;
  for (std::size_t i = 0; i < 2; ++i) {
    CAPTURE(slipped_at[i]);
    const Real angle = std::atan(frictions[i]) / degree;
    CHECK(slipped_at[i] > angle);
    CHECK(slipped_at[i] < angle + 1.5);  // a millimeter takes it some time
    CHECK(way[i] > 1);
  }
  CHECK(std::abs(way[2]) < 1e-3);
  CHECK(fastest(simulation) < 1e-3);
}

TEST_CASE("conveyor: a block moves as fast as the belt that it lies on, and stops on the floor") {
  Scene scene = load_builtin_scene("conveyor");
  std::vector<Vec3> places;
  run_clear_of_colliders(scene, [&](const Simulation& simulation, std::int64_t) {
    places.push_back(middle_of(simulation, simulation.bodies()[0]));
  });
  if (!runs_whole_scenes) return;
  const auto velocity = [&](std::size_t from, std::size_t to) -> Vec3 {
    return (places[to] - places[from]) / (static_cast<Real>(to - from) / 60);
  };
  CHECK((velocity(30, 70) - Vec3(0.6, 0, 0)).norm() < 0.005);
  CHECK((velocity(190, 220) - Vec3(0, -0.6, 0)).norm() < 0.01);
  CHECK(places.back().z() < 0.1);
  CHECK(fastest(scene.simulation) < 1e-3);
}

TEST_CASE("dancer: the skirt turns with the hips, rises, and stays on them") {
  Scene scene = load_builtin_scene("dancer");
  const Index first_of_waist = 28 * 96;
  const auto waist = [&](const Simulation& now) {
    return now.state().positions.bottomRows(96).colwise().mean().eval();
  };
  const auto hem = [](const Simulation& now) { return now.state().positions.topRows(96).col(2).mean(); };
  Real hanging = 0, highest = 0, angle = 0, largest = 0;
  Eigen::Vector2d last(1, 0);
  run_clear_of_colliders(scene, [&](const Simulation& now, std::int64_t step) {
    const Eigen::Vector2d here = now.state().positions.row(first_of_waist).head<2>().transpose();
    angle += std::atan2(last.x() * here.y() - last.y() * here.x(), last.dot(here)) / degree;
    last = here;
    largest = std::max(largest, angle);
    if (step == 60) hanging = hem(now);
    if (step > 60) highest = std::max(highest, hem(now));
  });
  if (!runs_whole_scenes) return;
  CHECK(largest == doctest::Approx(1080).epsilon(0.05));
  CHECK(std::abs(angle) < 40);
  CHECK(highest > hanging + 0.1);
  CHECK(hem(scene.simulation) == doctest::Approx(hanging).epsilon(0.1));
  CHECK(waist(scene.simulation).z() > 0.98);
}

TEST_CASE("flagpole: the flag goes round the pole and lies against it") {
  Scene scene = load_builtin_scene("flagpole");
  Index widest = 0;
  run_clear_of_colliders(scene, [&](const Simulation& now, std::int64_t) {
    std::array<bool, 12> is_touched{};
    for (const ContactPoint& each : now.contacts()) {
      const Real angle = std::atan2(each.normal.y(), each.normal.x()) / degree + 180;
      is_touched[static_cast<std::size_t>(angle / 30) % 12] = true;
    }
    widest = std::max(widest, static_cast<Index>(std::ranges::count(is_touched, true)));
  });
  if (!runs_whole_scenes) return;
  CHECK(widest >= 6);  // half of the way round
}

TEST_CASE("drapes: the hem lies on the floor and drags behind the hooks") {
  Scene scene = load_builtin_scene("drapes");
  Real lag = 0;
  run_clear_of_colliders(scene, [&](const Simulation& now, std::int64_t) {
    const Positions& x = now.state().positions;
    lag = std::max(lag, x(72, 0) - x(x.rows() - 1, 0));  // from the last hook to the corner below it
  });
  if (!runs_whole_scenes) return;
  CHECK(lag > 0.2);
  CHECK(contacts_with(scene.simulation, "floor") > 10);
  CHECK(fastest(scene.simulation) < 0.1);
}

TEST_CASE("ball: it pushes the cloth before it, and the cloth hangs straight again when it is gone") {
  Scene scene = load_builtin_scene("ball");
  Real farthest = 0;
  run_clear_of_colliders(scene, [&](const Simulation& now, std::int64_t) {
    farthest = std::max(farthest, now.state().positions.col(1).maxCoeff());
  });
  if (!runs_whole_scenes) return;
  CHECK(farthest > 0.4);
  CHECK(contacts_with(scene.simulation, "ball") == 0);
  CHECK(scene.simulation.state().positions.col(1).cwiseAbs().maxCoeff() < 0.5 * farthest);
}

}  // namespace test_contact_scenes
