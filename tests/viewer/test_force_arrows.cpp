// The arrows of forces in the picture, without a window.
#include <chrono>
#include <functional>
#include <thread>

#include <doctest/doctest.h>

#include "viewer/force_arrows.h"

namespace test_force_arrows {

using namespace pliant_viewer;
using pliant::Vec3;

namespace {

constexpr std::string_view text = R"({ "pliant": 1, "settings": { "threads": 1 }, "bodies": [ {
  "name": "sheet", "mesh": { "shape": "grid", "columns": 8, "rows": 8, "size": [1, 1], "plane": "xz" },
  "mass": { "total": 1 }, "constraints": [ { "type": "edge_spring", "stiffness": 500 } ] } ],
  "forces": [ { "type": "wind", "velocity": [0, 3, 0] },
              { "type": "test_force", "name": "push", "body": "sheet", "vertices": [3], "force": [0, 0, 2] },
              { "type": "test_force", "name": "still", "body": "sheet", "vertices": [4], "force": [0, 0, 0] } ] })";

struct Desk {
  LiveScene live{[] { return pliant::parse_scene(text, {}, "sheet"); }, 1, false, [] {}};
  Screen screen = screen_before();
  OrbitCamera camera{screen.viewpoint, Vec3f::UnitZ()};
  ForceArrows arrows;
  bool is_open = true;

  Desk() {
    wait_until([&] { return live.has_news(); });
    live.newest();
  }
  static Screen screen_before() {
    pliant_render::Bounds bounds;
    bounds.add({0, -0.1F, 0});
    bounds.add({1, 0.1F, 1});
    return {place_camera({.position = Vec3(0.5, -3, 0.5), .target = Vec3(0.5, 0, 0.5)}, bounds, 4.0F / 3), {800, 600}};
  }
  static void wait_until(const std::function<bool()>& is_so) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!is_so()) {
      REQUIRE(std::chrono::steady_clock::now() < deadline);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  MouseInteraction::View view() {
    MouseInteraction::View seen{screen, camera, &live, &live.shown()};
    seen.shows_forces = is_open;
    return seen;
  }
  ForceArrows::Arrow arrow(const std::string& key) {
    for (const ForceArrows::Arrow& each : ForceArrows::list(view())) {
      if (each.key == key) return each;
    }
    FAIL("there is no arrow of ", key);
    return {};
  }
  bool send(MouseEvent::Kind kind, const Vec2f& at, float wheel = 0) {
    return arrows.handle({.kind = kind, .place = at, .wheel = wheel}, view());
  }
  void settle() {
    const std::uint64_t command = live.post([](CommandContext&) {});
    wait_until([&] { return live.newest().commands >= command; });
  }
};

}  // namespace

TEST_CASE("wind, gravity and test forces have arrows, one above the other, with what they are") {
  Desk desk;
  const std::vector<ForceArrows::Arrow> arrows = ForceArrows::list(desk.view());
  REQUIRE(arrows.size() == 3);  // a force of zero has no direction
  CHECK(arrows[0].is_of_wind);
  CHECK(desk.arrow("force:gravity.acceleration").text == "gravity 9.81 m/s²");
  CHECK(desk.arrow("force:push.force").text == "push 2 N");
  for (std::size_t i = 0; i < arrows.size(); ++i) {
    CHECK(ForceArrows::at(arrows[i].middle, desk.view())->key == arrows[i].key);
    CHECK(arrows[i].middle.x() > arrows[i].radius);
    for (std::size_t k = 0; k < i; ++k) {
      CHECK((arrows[i].middle - arrows[k].middle).norm() > arrows[i].radius + arrows[k].radius);
    }
  }
  CHECK_FALSE(ForceArrows::at({400, 300}, desk.view()).has_value());
  desk.is_open = false;
  CHECK(ForceArrows::list(desk.view()).size() == 1);
  // Under the mouse it is there, since nothing else is.
  CHECK(ForceArrows::at(arrows[1].middle, desk.view())->key == arrows[1].key);
}

TEST_CASE("the arrow of gravity is turned by the mouse with its length kept, as one change for undo") {
  Desk desk;
  const ForceArrows::Arrow gravity = desk.arrow("force:gravity.acceleration");
  const Vec2f tip = gravity.middle + Vec2f(0, 0.9F * gravity.radius);
  CHECK(desk.send(MouseEvent::Kind::press, tip));
  CHECK(desk.arrows.is_busy());
  for (int i = 1; i <= 10; ++i) {
    CHECK(desk.send(MouseEvent::Kind::move, tip + 0.1F * static_cast<float>(i) * Vec2f(120, -0.9F * gravity.radius)));
  }
  CHECK(desk.send(MouseEvent::Kind::release, tip));
  CHECK_FALSE(desk.arrows.is_busy());
  desk.settle();
  const Vec3f turned = desk.arrow("force:gravity.acceleration").vector;
  CHECK(turned.norm() == doctest::Approx(9.81));
  CHECK(turned.x() > 9);  // to the right of the picture
  CHECK(desk.live.shown().undone_next == "gravity: acceleration");
  desk.live.post([](CommandContext& context) { context.session.undo(); });
  desk.settle();
  CHECK((desk.arrow("force:gravity.acceleration").vector - Vec3f(0, 0, -9.81F)).norm() < 1e-5F);
  CHECK(desk.live.shown().undone_next.empty());
}

TEST_CASE("the wheel over an arrow makes its force stronger or weaker, and that alone") {
  Desk desk;
  const Vec2f at = desk.arrow("force:push.force").middle;
  CHECK(desk.send(MouseEvent::Kind::wheel, at, 2));
  desk.settle();
  CHECK((desk.arrow("force:push.force").vector - Vec3f(0, 0, 2.42F)).norm() < 1e-5F);
  CHECK(desk.send(MouseEvent::Kind::wheel, at, -3));
  desk.settle();
  CHECK((desk.arrow("force:push.force").vector - Vec3f(0, 0, 2 / 1.1F)).norm() < 1e-4F);
  CHECK(desk.arrow("force:gravity.acceleration").vector.z() == -9.81F);
  CHECK(desk.live.shown().undone_next == "push: force");
  CHECK_FALSE(desk.send(MouseEvent::Kind::wheel, {400, 300}, 1));
}

}  // namespace test_force_arrows
