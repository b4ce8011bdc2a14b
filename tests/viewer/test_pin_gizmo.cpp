// The handle of pins and the tool that selects, without a window.
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <thread>

#include <doctest/doctest.h>

#include "pliant/constraints/position.h"
#include "pliant/mesh/shapes.h"
#include "viewer/pin_gizmo.h"
#include "viewer/select_tool.h"

namespace test_pin_gizmo {

using namespace pliant_viewer;
using Part = PinGizmo::Part;

namespace {

constexpr std::array parts = {Part::plane,  Part::move_x, Part::move_y, Part::move_z,
                              Part::turn_x, Part::turn_y, Part::turn_z};

pliant::Scene make_scene() {
  pliant::Scene scene;
  scene.simulation.set_settings({.threads = 1});
  scene.simulation.add_body(pliant::grid({.columns = 9, .rows = 9}), pliant::Mass::total(1));
  scene.simulation.add_body(pliant::chain({.links = 8, .direction = {1, 0, 0}}), pliant::Mass::total(1));
  return scene;
}

/// A paused scene as a camera sees it, with the tool and the handle.
struct Desk {
  LiveScene live{make_scene, 1, false, [] {}};
  Screen screen;
  OrbitCamera camera;
  SelectTool select;
  PinGizmo gizmo;

  explicit Desk(const pliant::Vec3& eye = {1.7, -2.2, 1.4})
      : screen(screen_from(eye)), camera(screen.viewpoint, Vec3f::UnitZ()) {
    wait_until([&] { return live.has_news(); });
    live.newest();
  }
  static Screen screen_from(const pliant::Vec3& eye) {
    pliant_render::Bounds bounds;
    bounds.add({0, -0.1F, 0});
    bounds.add({1, 0.1F, 1});
    const pliant::Camera camera{.position = eye, .target = pliant::Vec3(0.5, 0, 0.5)};
    return {place_camera(camera, bounds, 4.0F / 3), {800, 600}};
  }
  static void wait_until(const std::function<bool()>& is_so) {
    while (!is_so()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  MouseInteraction::View view() { return {screen, camera, &live, &live.shown()}; }
  Vec2f place(std::uint32_t vertex) { return screen.place_of(live.shown().frame.content.positions.at(vertex)).value(); }
  void pin(const std::vector<std::uint32_t>& vertices) {
    select.select(vertices);
    live.post([vertices](CommandContext& context) {
      context.session.pin(std::vector<Index>(vertices.begin(), vertices.end()));
    });
    wait_until([&] { return live.newest().pinned.size() == vertices.size(); });
    gizmo.follow(select.selected(), live.shown());
  }
  void press(const Vec2f& at) { CHECK(gizmo.handle({.kind = MouseEvent::Kind::press, .place = at}, view())); }
  void move(const Vec2f& to, bool control = false) {
    CHECK(gizmo.handle({.kind = MouseEvent::Kind::move, .place = to, .control = control}, view()));
    gizmo.flush(view());
  }
  void release(const Vec2f& at) { CHECK(gizmo.handle({.kind = MouseEvent::Kind::release, .place = at}, view())); }
  /// Of a press and a release with Ctrl, with moves between.
  void select_along(const std::vector<Vec2f>& path, bool shift = false) {
    const auto event = [&](MouseEvent::Kind kind, const Vec2f& at) {
      CHECK(select.handle({.kind = kind, .place = at, .shift = shift, .control = true}, view()));
    };
    event(MouseEvent::Kind::press, path.front());
    for (const Vec2f& place : path) event(MouseEvent::Kind::move, place);
    event(MouseEvent::Kind::release, path.back());
  }
};

const std::vector<std::uint32_t> middle = {30, 31, 32, 39, 40, 41, 48, 49, 50};

}  // namespace

TEST_CASE("each part of the handle is found where it is drawn, from wherever it is seen") {
  for (const pliant::Vec3& eye : {pliant::Vec3(1.7, -2.2, 1.4), {-1.5, 1, 2.5}, {2, 2, -0.5}, {0.4, -2.5, 0.6}}) {
    CAPTURE(eye.transpose());
    Desk desk(eye);
    CHECK_FALSE(desk.gizmo.is_shown());
    desk.pin(middle);
    REQUIRE(desk.gizmo.is_shown());
    int found = 0;
    for (const Part part : parts) {
      CAPTURE(static_cast<int>(part));
      const auto place = desk.gizmo.place_of(part, desk.view());
      REQUIRE(place.has_value());
      found += desk.gizmo.part_at(*place, desk.view()) == part ? 1 : 0;
    }
    CHECK(found >= 6);  // one arrow may stand toward the eye
    CHECK(desk.gizmo.part_at({790, 10}, desk.view()) == Part::none);
  }
}

TEST_CASE("a single pin has no rings, and what is not pinned no handle") {
  Desk desk;
  desk.pin({40});
  CHECK(desk.gizmo.part_at(desk.place(40), desk.view()) == Part::none);  // the pin itself is dragged, or let go
  CHECK(desk.gizmo.part_at(desk.gizmo.place_of(Part::move_z, desk.view()).value(), desk.view()) == Part::move_z);
  const auto on_ring = desk.gizmo.place_of(Part::turn_y, desk.view());
  CHECK(desk.gizmo.part_at(on_ring.value(), desk.view()) == Part::none);
  desk.gizmo.follow({1, 2, 3}, desk.live.shown());
  CHECK_FALSE(desk.gizmo.is_shown());
  CHECK(desk.gizmo.part_at(desk.place(40), desk.view()) == Part::none);
}

TEST_CASE("an arrow moves along its axis alone, and stays under the mouse") {
  for (const Part part : {Part::move_x, Part::move_y, Part::move_z}) {
    Desk desk;
    desk.pin(middle);
    const Vec2f from = desk.gizmo.place_of(part, desk.view()).value();
    desk.press(from);
    const Vec3f along = Vec3f::Unit(static_cast<int>(part) - static_cast<int>(Part::move_x));
    const Vec3f grabbed = desk.gizmo.motion().center;
    const Vec2f to =
        desk.screen.place_of(grabbed + 0.3F * along).value() + from - desk.screen.place_of(grabbed).value();
    desk.move(to);
    const Vec3f moved = desk.gizmo.motion().translation;
    CHECK((moved - moved.dot(along) * along).norm() < 1e-6F);
    CHECK(moved.dot(along) > 0.2F);
    CHECK(moved.dot(along) < 0.45F);
    CHECK(desk.gizmo.motion().rotation.norm() == 0);
    desk.move(from);
    CHECK(desk.gizmo.motion().translation.norm() < 1e-4F);
    desk.release(from);
  }
}

TEST_CASE("the middle moves in the plane of the picture, as far as the mouse goes, and is one change for undo") {
  Desk desk;
  desk.pin(middle);
  const std::vector<Vec3f> before = desk.live.shown().frame.content.positions;
  const Vec3f start = desk.gizmo.motion().center;
  const Vec2f from = desk.gizmo.place_of(Part::plane, desk.view()).value() + Vec2f(2, -1), to = from + Vec2f(80, -55);
  desk.press(from);
  desk.move(from + Vec2f(30, 30));
  desk.move(to);
  const float depth = desk.screen.depth_of(start);
  const Vec3f way = desk.screen.point_at(to, depth) - desk.screen.point_at(from, depth);
  CHECK((desk.gizmo.motion().translation - way).norm() < 1e-5F);
  desk.release(to);
  CHECK_FALSE(desk.gizmo.is_busy());
  Desk::wait_until([&] { return desk.live.newest().undone_next == "move 9 vertices"; });
  for (const PinnedVertex& pin : desk.live.shown().pinned) {
    CHECK((pin.target - before.at(pin.vertex) - way).norm() < 1e-5F);
  }
  desk.gizmo.follow(desk.select.selected(), desk.live.shown());
  CHECK((desk.gizmo.motion().center - start - way).norm() < 1e-5F);
  desk.live.post([](CommandContext& context) { context.session.undo(); });
  Desk::wait_until([&] { return desk.live.newest().undone_next == "pin 9 vertices"; });
  for (const PinnedVertex& pin : desk.live.shown().pinned) {
    CHECK((pin.target - before.at(pin.vertex)).norm() < 1e-5F);
  }
}

TEST_CASE("a click on the handle changes nothing, and one with Ctrl or Shift is not for it") {
  Desk desk;
  desk.pin(middle);
  const std::uint64_t commands = desk.live.shown().commands;
  for (const Part part : parts) {
    const Vec2f at = desk.gizmo.place_of(part, desk.view()).value();
    if (desk.gizmo.part_at(at, desk.view()) == Part::none) continue;
    desk.press(at);
    desk.move(at + Vec2f(1, 1));
    desk.release(at + Vec2f(1, 1));
    CHECK(desk.gizmo.motion().translation.norm() == 0);
    CHECK_FALSE(desk.gizmo.handle({.kind = MouseEvent::Kind::press, .place = at, .control = true}, desk.view()));
    CHECK_FALSE(desk.gizmo.handle({.kind = MouseEvent::Kind::press, .place = at, .shift = true}, desk.view()));
  }
  const std::uint64_t sent = desk.live.post([](CommandContext&) {});
  CHECK(sent == commands + 1);
  CHECK(desk.live.newest().undone_next == "pin 9 vertices");
}

TEST_CASE("a handle that is taken again at once goes on from where it is") {
  Desk desk;
  desk.pin(middle);
  const Snapshot stale = desk.live.shown();  // the scene may not have answered yet
  const MouseInteraction::View view{desk.screen, desk.camera, &desk.live, &stale};
  const std::vector<Vec3f> before = stale.frame.content.positions;
  const Vec3f center = desk.gizmo.motion().center;
  const auto drag = [&](Part part, const Vec2f& by) {
    const Vec2f from = desk.gizmo.place_of(part, view).value();
    CHECK(desk.gizmo.handle({.kind = MouseEvent::Kind::press, .place = from}, view));
    CHECK(desk.gizmo.handle({.kind = MouseEvent::Kind::move, .place = from + by}, view));
    CHECK(desk.gizmo.handle({.kind = MouseEvent::Kind::release, .place = from + by}, view));
    desk.gizmo.follow(desk.select.selected(), stale);
    return desk.gizmo.motion();
  };
  std::vector<RigidMotion> motions;
  motions.push_back(drag(Part::move_z, {0, -40}));
  motions.push_back(drag(Part::turn_z, {60, 0}));
  motions.push_back(drag(Part::plane, {-30, -20}));
  CHECK(motions[1].translation.norm() == 0);
  CHECK(motions[1].rotation.norm() > 0.3F);
  CHECK(motions[2].rotation.norm() == 0);
  CHECK((motions[1].center - center - motions[0].translation).norm() < 1e-5F);
  Desk::wait_until([&] { return desk.live.newest().commands >= 1 + 3 * 3; });
  for (const PinnedVertex& pin : desk.live.shown().pinned) {
    Eigen::Vector3d point = before.at(pin.vertex).cast<double>();
    for (const RigidMotion& motion : motions) point = motion(point);
    CHECK((pin.target.cast<double>() - point).norm() < 1e-5);
  }
}

TEST_CASE("an arrow does not fling the pins away where its axis vanishes, nor does a ring at its tip") {
  for (const pliant::Vec3& eye : {pliant::Vec3(0.9, -2.2, 0.7), {1.7, -2.2, 1.4}, {0.6, 0.2, 3}}) {
    Desk desk(eye);
    desk.pin(middle);
    for (const Part part : {Part::move_x, Part::move_y, Part::move_z}) {
      const Vec2f from = desk.gizmo.place_of(part, desk.view()).value();
      if (desk.gizmo.part_at(from, desk.view()) != part) continue;
      desk.press(from);
      for (int x = 0; x <= 800; x += 10) {
        for (int y = 0; y <= 600; y += 50) {
          desk.gizmo.handle({.kind = MouseEvent::Kind::move, .place = Vec2f(x, y)}, desk.view());
          CHECK(desk.gizmo.motion().translation.norm() < 15);
        }
      }
      desk.release(from);
    }
  }
  Desk level({0.5, -2.5, 0.5});
  level.pin(middle);
  const Vec2f center = level.screen.place_of(level.gizmo.motion().center).value();
  for (float x = center.x() + 40; x < center.x() + 90; x += 0.5F) {  // over the end of the ring
    const Vec2f from(x, center.y());
    if (level.gizmo.part_at(from, level.view()) != Part::turn_z) continue;
    level.press(from);
    level.move(from + Vec2f(8, 0));
    CHECK(level.gizmo.motion().rotation.norm() < 0.5F);
    level.release(from + Vec2f(8, 0));
    level.gizmo.follow(level.select.selected(), level.live.newest());
  }
}

TEST_CASE("a ring turns by the angle that the mouse goes around, in steps of 15° with Ctrl, also seen from its edge") {
  Desk desk;
  desk.pin(middle);
  const Vec3f center = desk.gizmo.motion().center;
  for (const Part part : {Part::turn_x, Part::turn_y, Part::turn_z}) {
    CAPTURE(static_cast<int>(part));
    const Vec3f axis = Vec3f::Unit(static_cast<int>(part) - static_cast<int>(Part::turn_x));
    const Vec2f from = desk.gizmo.place_of(part, desk.view()).value();
    REQUIRE(desk.gizmo.part_at(from, desk.view()) == part);
    // The point of the ring under the mouse, and where it is after a turn.
    const Screen::Ray ray = desk.screen.ray(from);
    const Vec3f taken = ray.origin + (center - ray.origin).dot(axis) / ray.direction.dot(axis) * ray.direction;
    const auto place_after = [&](float angle) {
      return desk.screen.place_of(center + Eigen::AngleAxisf(angle, axis) * (taken - center)).value();
    };
    desk.press(from);
    for (int i = 1; i <= 20; ++i) desk.move(place_after(0.2F * static_cast<float>(i)));  // more than half a turn
    CHECK((desk.gizmo.motion().rotation - 4 * axis).norm() < 2e-2F);
    CHECK(desk.gizmo.motion().translation.norm() == 0);
    for (int i = 19; i >= 3; --i) desk.move(place_after(0.2F * static_cast<float>(i)), true);
    CHECK((desk.gizmo.motion().rotation - std::numbers::pi_v<float> / 6 * axis).norm() < 1e-5F);
    desk.move(from);
    desk.release(from);
    Desk::wait_until([&] { return desk.live.newest().undone_next == "move 9 vertices"; });
    desk.live.post([](CommandContext& context) { context.session.undo(); });
    Desk::wait_until([&] { return desk.live.newest().undone_next == "pin 9 vertices"; });
    desk.gizmo.follow(desk.select.selected(), desk.live.shown());
  }

  Desk level({0.5, -2.5, 0.5});
  level.pin(middle);
  const Vec2f from = level.gizmo.place_of(Part::turn_z, level.view()).value();
  REQUIRE(level.gizmo.part_at(from, level.view()) == Part::turn_z);
  level.press(from);
  level.move(from + Vec2f(20, 0));
  const Vec3f turned = level.gizmo.motion().rotation;
  CHECK(turned.z() > 0.1F);  // the front of the ring goes to the right
  CHECK(turned.z() < 1.0F);
  CHECK(turned.head<2>().norm() == 0);
}

TEST_CASE("boxes, lassos, clicks and double clicks with Ctrl select, with Shift they take out") {
  Desk desk;
  Vec2f low = desk.place(40), high = low;
  for (const std::uint32_t vertex : middle) {
    low = low.cwiseMin(desk.place(vertex) - Vec2f(4, 4));
    high = high.cwiseMax(desk.place(vertex) + Vec2f(4, 4));
  }
  desk.select_along({low, high});
  const auto boxed = desk.select.selected();
  CHECK(std::ranges::includes(boxed, middle));
  desk.select.draws_lasso = true;
  desk.select_along({desk.place(30), desk.place(40) + Vec2f(0, -3), desk.place(32)}, true);  // no area to speak of
  CHECK(std::ranges::includes(boxed, desk.select.selected()));
  CHECK(desk.select.selected().size() + 3 >= boxed.size());
  desk.select.clear();
  const auto around = [&](std::uint32_t vertex) {
    std::vector<Vec2f> path;
    for (int i = 0; i < 12; ++i) {
      const float angle = std::numbers::pi_v<float> * static_cast<float>(i) / 6;
      path.emplace_back(desk.place(vertex) + 12 * Vec2f(std::cos(angle), std::sin(angle)));
    }
    return path;
  };
  desk.select_along(around(20));
  desk.select_along(around(42));
  CHECK(desk.select.selected() == std::vector<std::uint32_t>{20, 42});
  desk.select_along(around(20), true);
  CHECK(desk.select.selected() == std::vector<std::uint32_t>{42});

  desk.select_along({desk.place(24)});
  CHECK(desk.select.selected() == std::vector<std::uint32_t>{24, 42});
  desk.select_along({desk.place(24)});  // soon enough: a double click on the border
  CHECK(desk.select.selected().size() == 33);
  CHECK(std::ranges::binary_search(desk.select.selected(), 42U));
  desk.select_along({{790, 10}});
  CHECK(desk.select.selected().empty());
  CHECK_FALSE(desk.select.handle({.kind = MouseEvent::Kind::press, .place = desk.place(24)}, desk.view()));  // no Ctrl

  desk.select.select({40});
  desk.select.grow(*desk.live.shown().render_mesh);
  CHECK(desk.select.selected().size() == 7);  // with the diagonals of the cells
  desk.select.select_all(*desk.live.shown().render_mesh);
  CHECK(desk.select.selected().size() == 81 + 9);
  desk.select.restart(50);
  CHECK(desk.select.selected().size() == 50);
}

}  // namespace test_pin_gizmo
