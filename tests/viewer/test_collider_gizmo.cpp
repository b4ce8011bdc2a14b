// The handle of a collider, without a window, and what becomes of a collider that was turned.
#include <chrono>
#include <functional>
#include <numbers>
#include <thread>

#include <doctest/doctest.h>

#include "../support/temporary_folder.h"
#include "pliant/collision/colliders/builtin.h"
#include "viewer/handles.h"

namespace test_collider_gizmo {

using namespace pliant_viewer;
using Part = TransformGizmo::Part;
using pliant::Vec3;
using pliant_tests::TemporaryFolder;

namespace {

pliant::Scene make_scene() {
  return pliant::parse_scene(R"({ "pliant": 1, "settings": { "time_step": 0.02, "threads": 1 }, "bodies": [ {
    "name": "sheet", "mesh": { "shape": "grid", "columns": 8, "rows": 8, "size": [1, 1], "plane": "xy" },
    "mass": { "total": 1 }, "constraints": [ { "type": "edge_spring", "stiffness": 500 } ] } ],
    "colliders": [
      { "type": "plane", "name": "floor", "position": [0.5, 0.5, -1] },
      { "type": "box", "name": "box", "center": [0.5, 0.5, -0.4], "size": [0.6, 0.4, 0.3], "rotation": [0, 0, 20] },
      { "type": "capsule", "name": "bar", "from": [1.2, 0.5, -0.5], "to": [1.8, 0.5, -0.5] },
      { "type": "sphere", "name": "ball", "center": [-0.6, 0.5, -0.5], "radius": 0.2 } ],
    "events": [ { "step": 0, "move": "box", "offset": [0, 0, -4], "over": 4 } ] })",
                             {}, "table.json");
}

/// A scene as a camera sees it, with the handles.
struct Desk {
  LiveScene live;
  Screen screen = screen_before();
  OrbitCamera camera{screen.viewpoint, Vec3f::UnitZ()};
  Handles handles;
  MouseInteraction mouse{1};

  explicit Desk(bool is_playing = false) : live(make_scene, 1, is_playing, [] {}) {
    wait_until([&] { return live.has_news(); });
    live.newest();
  }
  static Screen screen_before() {
    pliant_render::Bounds bounds;
    bounds.add({-1, -1, -1});
    bounds.add({2, 2, 1});
    return {place_camera({.position = Vec3(1.7, -3.2, 1.4), .target = Vec3(0.5, 0.5, -0.4)}, bounds, 4.0F / 3),
            {800, 600}};
  }
  static void wait_until(const std::function<bool()>& is_so) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!is_so()) {
      REQUIRE(std::chrono::steady_clock::now() < deadline);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  MouseInteraction::View view() { return {screen, camera, &live, &live.shown()}; }
  ColliderGizmo& gizmo() { return handles.collider; }
  void select(const char* name) {
    gizmo().select(name);
    gizmo().follow(live.newest(), true);
    REQUIRE(gizmo().is_shown());
  }
  pliant::Pose pose(const std::string& name) {
    for (const auto& [id, each] : live.shown().movable) {
      if (each.name == name) return each.pose;
    }
    FAIL("there is no collider ", name);
    return {};
  }
  bool send(MouseEvent::Kind kind, const Vec2f& at, bool control = false) {
    const bool is_taken = handles.handle({.kind = kind, .place = at, .control = control}, view());
    handles.flush(view());
    return is_taken;
  }
  void drag(Part part, const Vec2f& by, bool control = false) {
    const Vec2f from = gizmo().place_of(part, view()).value();
    REQUIRE(gizmo().part_at(from, view()) == part);
    CHECK(send(MouseEvent::Kind::press, from));
    for (int i = 1; i <= 10; ++i) {
      CHECK(send(MouseEvent::Kind::move, from + 0.1F * static_cast<float>(i) * by, control));
    }
    CHECK(send(MouseEvent::Kind::release, from + by));
  }
  /// Of the mouse in the picture; returns what it selects.
  std::string click(const Vec2f& at) {
    mouse.handle({.kind = MouseEvent::Kind::press, .place = at}, view());
    mouse.handle({.kind = MouseEvent::Kind::release, .place = at}, view());
    if (const auto click = mouse.take_click()) handles.take_click(*click, live.shown());
    return gizmo().selected();
  }
};

pliant::ColliderId find(const Session& session, const char* name) {
  return session.simulation().find_collider(name).value();
}
pliant::Pose pose(const Session& session, const char* name) {
  return session.simulation().pose(find(session, name));
}
bool is_near(const pliant::Pose& a, const pliant::Pose& b) {
  return (a.position - b.position).norm() < 1e-9 && a.rotation.angularDistance(b.rotation) < 1e-7;
}
/// Of what is the same about its own axis z.
bool has_axis(const pliant::Pose& a, const pliant::Pose& b) {
  return (a.position - b.position).norm() < 1e-9 &&
         (a.rotation * Vec3::UnitZ() - b.rotation * Vec3::UnitZ()).norm() < 1e-7;
}

}  // namespace

TEST_CASE("a click selects a collider or a plane, and once more, or beside everything, selects none; a drag does not") {
  Desk desk;
  const auto place = [&](const Vec3f& point) { return desk.screen.place_of(point).value(); };
  CHECK(desk.click(place({-0.6F, 0.5F, -0.5F})) == "ball");
  CHECK(desk.click(place({1.5F, 0.5F, -0.5F})) == "bar");
  CHECK(desk.click(place({1.5F, 0.5F, -0.5F})).empty());
  CHECK(desk.click(place({-1, -1, -1})) == "floor");
  CHECK(desk.click({400, 3}).empty());  // the sky
  const Vec2f at = place({-0.6F, 0.5F, -0.5F});
  desk.mouse.handle({.kind = MouseEvent::Kind::press, .place = at}, desk.view());
  desk.mouse.handle({.kind = MouseEvent::Kind::move, .place = at + Vec2f(20, 0)}, desk.view());
  desk.mouse.handle({.kind = MouseEvent::Kind::release, .place = at + Vec2f(20, 0)}, desk.view());
  CHECK_FALSE(desk.mouse.take_click().has_value());
}

TEST_CASE("arrows and the dot move a collider, and a ring turns it, each as one change for undo") {
  Desk desk;
  desk.select("box");
  const pliant::Pose start = desk.pose("box");
  CHECK((desk.gizmo().motion().center - start.position.cast<float>()).norm() == 0);
  desk.drag(Part::move_z, {0, -50});
  Desk::wait_until([&] { return desk.live.newest().undone_next == "move a collider"; });
  const pliant::Pose moved = desk.pose("box");
  CHECK(moved.position.z() > start.position.z() + 0.1);
  CHECK((moved.position - start.position).head<2>().norm() < 1e-6);
  CHECK(moved.rotation.angularDistance(start.rotation) < 1e-7);
  desk.gizmo().follow(desk.live.shown(), true);
  desk.drag(Part::turn_z, {90, 0}, true);
  Desk::wait_until([&] { return desk.live.newest().undone_next == "turn a collider"; });
  const pliant::Pose turned = desk.pose("box");
  CHECK((turned.position - moved.position).norm() < 1e-6);
  const Real steps_of_15 = turned.rotation.angularDistance(moved.rotation) * 12 / std::numbers::pi;
  CHECK(steps_of_15 > 0.99);
  CHECK(std::abs(steps_of_15 - std::round(steps_of_15)) < 1e-5);
  CHECK((turned.rotation * Vec3::UnitZ() - Vec3::UnitZ()).norm() < 1e-6);
  desk.gizmo().follow(desk.live.shown(), true);
  desk.drag(Part::plane, {30, 10});
  Desk::wait_until([&] { return desk.live.newest().undone_next == "move a collider"; });
  const std::vector<pliant::Pose> before = {turned, moved, start};
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::uint64_t command = desk.live.post([](CommandContext& context) { context.session.undo(); });
    Desk::wait_until([&] { return desk.live.newest().commands >= command; });
    CHECK((desk.pose("box").position - before[i].position).norm() < 1e-6);
    CHECK(desk.pose("box").rotation.angularDistance(before[i].rotation) < 1e-6);
  }
  CHECK(desk.live.shown().undone_next.empty());
}

TEST_CASE("what is turned and turned back is where it was") {
  Desk desk;
  desk.select("box");
  const pliant::Pose start = desk.pose("box");
  const Vec2f from = desk.gizmo().place_of(Part::turn_z, desk.view()).value();
  CHECK(desk.send(MouseEvent::Kind::press, from));
  const auto turn_to = [&](float by) {
    CHECK(desk.send(MouseEvent::Kind::move, from + Vec2f(by, 0), true));
    const std::uint64_t command = desk.live.post([](CommandContext&) {});
    Desk::wait_until([&] { return desk.live.newest().commands >= command; });
  };
  for (int i = 1; i <= 9; ++i) turn_to(10 * static_cast<float>(i));
  const pliant::Pose turned = desk.pose("box");
  CHECK(turned.rotation.angularDistance(start.rotation) > 0.2);
  for (int i = 8; i >= 0; --i) turn_to(10 * static_cast<float>(i));
  CHECK(desk.gizmo().motion().rotation.isZero(0));
  CHECK(desk.send(MouseEvent::Kind::release, from));
  const std::uint64_t command = desk.live.post([](CommandContext&) {});
  Desk::wait_until([&] { return desk.live.newest().commands >= command; });
  CHECK(desk.pose("box").rotation.angularDistance(start.rotation) < 1e-6);
}

TEST_CASE("the handle of a plane has an arrow along its normal and two rings in it") {
  Desk desk;
  desk.select("floor");
  for (const Part part : {Part::plane, Part::move_x, Part::move_y, Part::turn_z}) {
    const auto place = desk.gizmo().place_of(part, desk.view());
    if (place) CHECK(desk.gizmo().part_at(*place, desk.view()) != part);
  }
  desk.drag(Part::turn_x, {0, -30});
  Desk::wait_until([&] { return desk.live.newest().undone_next == "turn a collider"; });
  const pliant::Pose turned = desk.pose("floor");
  const Vec3 normal = turned.rotation * Vec3::UnitZ();
  CHECK(std::abs(normal.y()) > 0.05);
  CHECK(std::abs(normal.x()) < 1e-6);
  desk.gizmo().follow(desk.live.shown(), true);
  desk.drag(Part::move_z, {0, -40});
  Desk::wait_until([&] { return desk.live.newest().undone_next == "move a collider"; });
  const Vec3 way = desk.pose("floor").position - turned.position;
  CHECK(way.dot(normal) > 0.05);
  CHECK(way.cross(normal).norm() < 1e-6);
}

TEST_CASE("a handle is hidden with the colliders, and goes with its collider") {
  Desk desk;
  desk.select("bar");
  desk.gizmo().follow(desk.live.shown(), false);
  CHECK_FALSE(desk.gizmo().is_shown());
  desk.gizmo().follow(desk.live.shown(), true);
  CHECK(desk.gizmo().is_shown());
  const std::uint64_t command =
      desk.live.post([](CommandContext& context) { context.session.switch_on("bar", false); });
  Desk::wait_until([&] { return desk.live.newest().commands >= command; });
  desk.gizmo().follow(desk.live.shown(), true);
  CHECK_FALSE(desk.gizmo().is_shown());
  CHECK(desk.gizmo().selected().empty());
}

TEST_CASE("a collider turns by half a turn in a second at most, leaves the scene's path, and rests") {
  Session session(make_scene);
  for (int i = 0; i < 5; ++i) session.step();
  const pliant::Pose before = pose(session, "box");
  CHECK(before.position.z() < -0.45);
  const Vec3 goal(0, 0, 2);
  session.turn_collider(find(session, "box"), goal);
  session.turn_collider(find(session, "box"), Vec3::Constant(std::numeric_limits<Real>::infinity()));
  const Real most = std::numbers::pi * 0.02;
  for (int i = 0; i < 60; ++i) {
    const pliant::Pose last = pose(session, "box");
    session.step();
    CHECK(pose(session, "box").rotation.angularDistance(last.rotation) <= most * (1 + 1e-9));
  }
  CHECK((pose(session, "box").position - before.position).norm() < 1e-12);
  CHECK(pose(session, "box").rotation.angularDistance(pliant::moved_on({}, Vec3::Zero(), goal, 1).rotation) < 1e-7);
  for (const pliant::ColliderState& each : session.simulation().state().contact.colliders) {
    CHECK_FALSE(each.target.has_value());
  }
  CHECK(session.undone_next().empty());  // while time goes on it is part of the motion
}

TEST_CASE("cloth on a box that is turned goes round with it") {
  Session session(make_scene);
  session.move_collider(find(session, "box"), {0.5F, 0.5F, -0.16F});
  for (int i = 0; i < 100; ++i) session.step();
  const auto edge = [&] {  // from one vertex to another, over the box
    const auto& positions = session.simulation().state().positions;
    return Vec3(positions.row(28) - positions.row(27));
  };
  const Vec3 before = edge();
  for (int i = 0; i < 60; ++i) {
    session.turn_collider(find(session, "box"), {0, 0, std::numbers::pi / 9 + 0.01 * i});
    session.step();
  }
  CHECK(before.cross(edge()).z() > 0.2 * before.squaredNorm());
}

TEST_CASE("what was turned at the start begins like that: undone, saved, read again") {
  const TemporaryFolder folder;
  Session session(make_scene);
  const pliant::Pose start = pose(session, "box");
  for (const char* name : {"box", "bar", "floor"}) {
    CAPTURE(name);
    const pliant::Pose before = pose(session, name);
    session.turn_collider(find(session, name), {0.4, -0.3, 0.2});
    session.drop_collider(find(session, name));
    CHECK(session.undone_next() == "turn a collider");
    const pliant::Pose goal{before.position, pliant::moved_on({}, Vec3::Zero(), Vec3(0.4, -0.3, 0.2), 1).rotation};
    CHECK(has_axis(pose(session, name), goal));
    if (std::string_view(name) == "box") CHECK(is_near(pose(session, name), goal));
    session.undo();
    CHECK(is_near(pose(session, name), before));
    session.redo();
    CHECK(has_axis(pose(session, name), goal));
  }
  session.move_collider(find(session, "floor"), {3, 3, -1.5F});
  session.drop_collider(find(session, "floor"));
  const auto files = session.save(folder.path() / "turned.json", session.scene().view);
  const pliant::Scene saved = pliant::load_scene(files.at(0));
  for (const char* name : {"box", "bar", "floor", "ball"}) {
    CAPTURE(name);
    CHECK(has_axis(saved.simulation.pose(*saved.simulation.find_collider(name)), pose(session, name)));
  }
  CHECK(is_near(saved.simulation.pose(*saved.simulation.find_collider("box")), pose(session, "box")));
  CHECK(saved.simulation.options<pliant::CapsuleCollider>(*saved.simulation.find_collider("bar"))->radius == 0.1);
  for (int i = 0; i < 4; ++i) session.undo();
  CHECK(is_near(pose(session, "box"), start));
  CHECK(session.changes().is_empty());
}

TEST_CASE("what was added is turned, and saved like that") {
  const TemporaryFolder folder;
  Session session(make_scene);
  for (const char* type : {"box", "capsule", "plane"}) {
    CAPTURE(type);
    session.add(type);
    const std::string name = session.undone_next().substr(4);
    session.turn_collider(find(session, name.c_str()), {0.5, 0.1, -0.2});
    session.drop_collider(find(session, name.c_str()));
    const pliant::Pose now = pose(session, name.c_str());
    CHECK((now.rotation * Vec3::UnitZ() - Vec3::UnitZ()).norm() > 0.2);
    const auto files = session.save(folder.path() / "added.json", session.scene().view);
    const pliant::Scene saved = pliant::load_scene(files.at(0));
    CHECK(has_axis(saved.simulation.pose(*saved.simulation.find_collider(name)), now));
  }
}

TEST_CASE("turns of colliders are in the record of a session, and come again bit for bit") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.turn_collider(find(session, "floor"), {0.1, 0, 0});
  session.drop_collider(find(session, "floor"));
  for (int i = 0; i < 40; ++i) {
    session.move_collider(find(session, "box"), {0.5F, 0.5F, -0.2F + 0.002F * static_cast<float>(i)});
    session.turn_collider(find(session, "box"), {0.02 * i, 0, 0.4});
    session.turn_collider(find(session, "box"), {0.01 * i, 0, 0.4});  // the mouse may move more often
    session.step();
  }
  session.drop_collider(find(session, "box"));
  session.undo();
  for (int i = 0; i < 40; ++i) session.step();
  const auto file = folder.path() / "turned.session";
  write_session_record(file, session.record(file, session.scene().view));
  const SessionRecord record = read_session_record(file);
  Session again(scene_maker_of(record, file));
  again.replay(record);
  while (again.is_replaying()) again.step();
  CHECK(again.replayed().has_ended);
  CHECK_FALSE(again.replayed().differs_from.has_value());
  CHECK(again.simulation().state().positions == session.simulation().state().positions);
  CHECK(pose(again, "box") == pose(session, "box"));
}

}  // namespace test_collider_gizmo
