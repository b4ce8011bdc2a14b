// The mouse on colliders: what it hits, and where they go.
#include <thread>

#include <doctest/doctest.h>

#include "pliant/collision/colliders/builtin.h"
#include "viewer/mouse_interaction.h"

namespace test_collider_drag {

using namespace pliant_viewer;
using pliant::ColliderId;
using pliant::Vec3;

namespace {

const ColliderId floor_id{0}, ball{1}, wheel{2};

/// A hanging sheet of 1 m, a ball before it, and what turns behind it, over a floor.
pliant::Scene make_scene() {
  pliant::Scene scene = pliant::parse_scene(R"({ "pliant": 1, "settings": { "time_step": 0.02 }, "bodies": [ {
    "name": "sheet", "mesh": { "shape": "grid", "columns": 10, "rows": 10, "size": [1, 1], "plane": "xz" },
    "mass": { "total": 1 },
    "constraints": [ { "type": "position", "on": [90, 99] }, { "type": "edge_spring", "stiffness": 500 } ] } ] })",
                                            {}, "sheet");
  scene.simulation.add(pliant::PlaneCollider{.position = {0, 0, -2}});
  scene.simulation.add(pliant::SphereCollider{.center = {0.5, -1, 0.5}, .radius = 0.2});
  scene.simulation.add(pliant::BoxCollider{
      .center = {3, 0, 0.5}, .size = {1, 1, 1}, .velocity = {0, 0, 0.1}, .angular_velocity = {0, 0, 2}});
  return scene;
}

/// From 4 m before the sheet, the mouse in units of the picture's height of 1.
Screen screen_before(const Vec2f& size = {400, 300}) {
  const pliant::Camera camera{.position = Vec3(0.5, -4, 0.5), .target = Vec3(0.5, 0, 0.5)};
  pliant_render::Bounds bounds;
  bounds.add({-1, -1, -1});
  bounds.add({4, 1, 2});
  return {place_camera(camera, bounds, size.x() / size.y()), size};
}

std::vector<pliant_render::DrawnCollider> drawn(const pliant::Simulation& simulation) {
  pliant_render::ColliderSurfaces surfaces;
  return surfaces.find(simulation);
}

}  // namespace

TEST_CASE("the mouse hits the frontmost collider where its surface is, and never a plane") {
  const pliant::Scene scene = make_scene();
  const Screen screen = screen_before();
  const auto colliders = drawn(scene.simulation);
  REQUIRE(colliders.size() == 3);
  const auto middle = pick_collider(colliders, screen, {200, 150});
  REQUIRE(middle.has_value());
  CHECK(middle->number == 1);
  CHECK((middle->position - Vec3f(0.5F, -1.2F, 0.5F)).norm() < 1e-4F);
  for (const Vec2f& place : {Vec2f(200, 290), Vec2f(10, 150), Vec2f(200, 20)}) {
    CHECK_FALSE(pick_collider(colliders, screen, place).has_value());
  }
  // All over the picture: a hit is on the surface, and seen at the place.
  int hits = 0;
  for (float x = 0; x < 400; x += 7) {
    for (float y = 0; y < 300; y += 7) {
      const auto hit = pick_collider(colliders, screen, {x, y});
      if (!hit) continue;
      ++hits;
      const auto& collider = colliders[static_cast<std::size_t>(hit->number)];
      CHECK(std::abs(collider.surface->shape->distance(collider.pose.to_frame(hit->position.cast<double>())).distance) <
            1e-4);
      CHECK((*screen.place_of(hit->position) - Vec2f(x, y)).norm() < 0.05F);
    }
  }
  CHECK(hits > 30);
}

TEST_CASE("a collider goes where it is moved, with a limited speed, and rests there; a plane goes along its normal") {
  Session session(make_scene);
  const Vec3f goal(0.5F, 0.4F, 0.3F);
  const Vec3 begin = session.simulation().pose(ball).position;
  session.move_collider(ball, goal);
  session.move_collider(floor_id, {1, 2, -2.5F});
  session.move_collider(ColliderId{7}, goal);
  session.move_collider(ball, Vec3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  const double fastest = 3 * std::sqrt(2.0) * 0.02;  // three diagonals of the sheet in a second
  Vec3 last = begin;
  int steps = 0;
  while (session.simulation().pose(ball).position != goal.cast<double>() && ++steps < 1000) {
    session.step();
    const Vec3 now = session.simulation().pose(ball).position;
    CHECK((now - last).norm() <= fastest * (1 + 1e-12));
    CHECK((now - begin).cross(goal.cast<double>() - begin).norm() < 1e-9);
    last = now;
  }
  CHECK(steps == static_cast<int>(std::ceil((goal.cast<double>() - begin).norm() / fastest)));
  for (int i = 0; i < 5; ++i) session.step();
  CHECK(session.simulation().pose(ball).position == goal.cast<double>());
  CHECK((session.simulation().pose(floor_id).position - Vec3(0, 0, -2.5)).norm() < 1e-12);
  CHECK_FALSE(session.simulation().state().contact.colliders[1].target.has_value());
}

TEST_CASE("what moved by itself stops where the mouse leaves it, and starts over with the scene") {
  Session session(make_scene);
  for (int i = 0; i < 10; ++i) session.step();
  const pliant::Pose before = session.simulation().pose(wheel);
  CHECK(before.rotation.angularDistance(pliant::Pose{}.rotation) == doctest::Approx(0.4));
  CHECK(before.position.z() == doctest::Approx(0.52));
  session.move_collider(wheel, {3, 0.01F, 0.5F});
  for (int i = 0; i < 10; ++i) session.step();
  const pliant::Pose after = session.simulation().pose(wheel);
  CHECK((after.position - Vec3(3, 0.01, 0.5)).norm() < 1e-6);
  CHECK(after.rotation.angularDistance(before.rotation) < 1e-7);
  session.restart(true);
  for (int i = 0; i < 10; ++i) session.step();
  CHECK(session.simulation().pose(wheel).position.z() == doctest::Approx(0.52));
  CHECK(session.simulation().pose(ball).position.y() == -1);
}

TEST_CASE("a collider that the user took is not moved by the scene any longer, until that starts over") {
  const auto make = [] {
    return pliant::parse_scene(R"({"pliant": 1, "settings": {"time_step": 0.02},
      "bodies": [{"mesh": {"shape": "grid", "columns": 4, "rows": 4}, "mass": {"total": 1},
        "constraints": [{"type": "edge_spring", "stiffness": 100}, {"type": "position", "on": "all"}]}],
      "colliders": [{"type": "sphere", "name": "ball", "center": [0, 0, 3], "radius": 0.2},
                    {"type": "sphere", "name": "other", "center": [0, 0, -3], "radius": 0.2}],
      "events": [{"step": 0, "move": "ball", "offset": [0, 0, 4], "over": 1},
                 {"step": 0, "move": "other", "offset": [0, 0, -4], "over": 1},
                 {"step": 20, "move": "ball", "target": [5, 5, 5], "over": 0.2},
                 {"step": 25, "stop": "ball"},
                 {"step": 27, "move": "ball", "target": [6, 6, 6]},
                 {"step": 30, "change": "ball", "radius": 0.3}]})",
                               {}, "moves.json");
  };
  const ColliderId taken{0}, other{1};
  Session session(make);
  for (int i = 0; i < 10; ++i) session.step();
  REQUIRE(session.simulation().pose(taken).position.z() == doctest::Approx(3.8));
  const Vec3f goal(0.25F, 0, 3.5F);
  session.move_collider(taken, goal);
  for (int i = 0; i < 40; ++i) {
    const double before = (session.simulation().pose(taken).position - goal.cast<double>()).norm();
    session.step();
    const double now = (session.simulation().pose(taken).position - goal.cast<double>()).norm();
    CHECK((now < before || now == 0));
  }
  CHECK(session.simulation().pose(taken).position == goal.cast<double>());
  CHECK(session.note().empty());
  CHECK(session.simulation().pose(other).position.z() == doctest::Approx(-7));  // as the scene says
  CHECK(session.simulation().options<pliant::SphereCollider>(taken)->radius == 0.3);
  session.restart(true);
  for (int i = 0; i < 28; ++i) session.step();
  CHECK(session.simulation().pose(taken).position == Vec3(6, 6, 6));
}

TEST_CASE("what is hidden cannot be grabbed") {
  LiveScene live(make_scene, 1, false, [] {});
  while (!live.has_news()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Screen screen = screen_before();
  OrbitCamera camera(screen.viewpoint, Vec3f::UnitZ());
  MouseInteraction::View view{screen, camera, &live, &live.newest()};
  const Vec2f at(205, 145);
  CHECK(MouseInteraction::pick(at, view).collider.has_value());
  view.shows_colliders = false;
  const auto aimed = MouseInteraction::pick(at, view);
  CHECK_FALSE(aimed.collider.has_value());
  CHECK(aimed.point.has_value());  // the sheet behind the ball
}

TEST_CASE("a drag moves the collider in the plane of the picture, as far as the mouse goes") {
  LiveScene live(make_scene, 1, true, [] {});
  live.post([](CommandContext& context) { context.pacer.set_speed(Pacer::unlimited); });
  const auto wait_until = [](const std::function<bool()>& is_so) {
    while (!is_so()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  wait_until([&] { return live.newest().step > 0; });
  const Screen screen = screen_before();
  OrbitCamera camera(screen.viewpoint, Vec3f::UnitZ());
  MouseInteraction mouse(1);
  const Snapshot& shown = live.newest();
  const MouseInteraction::View view{screen, camera, &live, &shown};
  const Vec2f from(205, 145), to(160, 120);
  const auto aimed = MouseInteraction::pick(from, view);
  REQUIRE(aimed.collider.has_value());
  CHECK_FALSE(aimed.point.has_value());  // the sheet is behind the ball
  CHECK(aimed.collider->number == 1);
  const float depth = screen.depth_of(aimed.collider->position);
  mouse.handle({.kind = MouseEvent::Kind::press, .place = from}, view);
  CHECK_FALSE(mouse.collider_goal().has_value());
  mouse.handle({.kind = MouseEvent::Kind::move, .place = to}, view);
  mouse.flush(view);
  const Vec3f goal = Vec3f(0.5F, -1, 0.5F) + screen.point_at(to, depth) - screen.point_at(from, depth);
  REQUIRE(mouse.collider_goal().has_value());
  CHECK((*mouse.collider_goal() - goal).norm() < 1e-5F);
  CHECK(goal.y() == doctest::Approx(-1));
  mouse.handle({.kind = MouseEvent::Kind::release, .place = to}, view);
  CHECK_FALSE(mouse.is_busy());
  wait_until([&] {
    for (const auto& each : live.newest().frame.content.colliders) {
      if (each.number == 1) return (each.pose.position.cast<float>() - goal).norm() < 1e-5F;
    }
    return false;
  });
  CHECK(live.shown().frame.content.colliders.size() == 3);
  CHECK(live.shown().wrenches.size() == 3);
}

TEST_CASE("colliders and contact have sliders, and the force that is shown is what bodies press with") {
  Session session(make_scene);
  const auto value_of = [&](std::string_view key) {
    for (const Slider& slider : session.sliders()) {
      if (slider.key == key) return slider.parameter.value[0];
    }
    FAIL("no slider ", std::string(key));
    return 0.0;
  };
  CHECK(value_of("collider:sphere.radius") == 0.2);
  CHECK(value_of("contact.friction") == 0.3);
  session.set("collider:sphere.radius", {0.25, 0, 0});
  session.set("contact.friction", {0.7, 0, 0});
  CHECK(value_of("collider:sphere.radius") == 0.25);
  CHECK(session.simulation().contact().friction == 0.7);
  session.restart(true);
  CHECK(value_of("collider:sphere.radius") == 0.25);
  session.move_collider(ball, {0.5F, 0.1F, 0.5F});
  bool has_pressed = false;
  for (int i = 0; i < 60; ++i) {
    session.step();
    has_pressed = has_pressed || session.simulation().wrench(ball).force.y() < -0.1;
  }
  CHECK(has_pressed);
  CHECK(session.simulation().wrench(floor_id).force.isZero(0));
}

}  // namespace test_collider_drag
