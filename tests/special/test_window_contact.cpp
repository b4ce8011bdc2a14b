// What touches what, in the real window: a crate is thrown onto a cloth, and the panel says how bodies touch.
#define DOCTEST_CONFIG_IMPLEMENT
#include <algorithm>
#include <atomic>
#include <numeric>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "../support/sanitizers.h"
#include "desk.h"
#include "pliant/collision/crossings.h"
#include "pliant_io/scene/builtin_scenes.h"

using namespace pliant_tests;

namespace {

/// Looks for crossings between steps of the simulation, in its thread, and for touches of the crate, the last body.
struct CrossingWatch {
  std::atomic<int> looks = 0, crossings = 0;
  std::atomic<bool> lies_on_cloth = false;  // the crate is touched, far above the floor

  void look(const pliant::Simulation& simulation) {
    std::vector<pliant::Triangle> triangles;
    for (const pliant::Body& body : simulation.bodies()) {
      for (pliant::Triangle triangle : surface_triangles(body.mesh)) {
        for (pliant::Index& corner : triangle) corner += body.first_vertex;
        triangles.push_back(triangle);
      }
    }
    pliant::visit_crossings({.positions = simulation.state().positions, .triangles = triangles},
                            [this](const pliant::Crossing&) { ++crossings; });
    const pliant::Body& crate = simulation.bodies().back();
    const auto rows = simulation.state().positions.bottomRows(crate.mesh.vertex_count());
    const std::vector<pliant::VertexTouch> touches = simulation.touches();
    const bool is_touched = std::any_of(touches.begin() + crate.first_vertex, touches.end(),
                                        [](const pliant::VertexTouch& touch) { return touch.force.norm() > 0; });
    lies_on_cloth = is_touched && rows.col(2).minCoeff() > 0.3;
    ++looks;
  }
};

/// The built-in scene crate_on_cloth, whose bodies the mouse takes along paths in simulated time.
struct ThrowingDesk : Desk {
#if PLIANT_IS_SANITIZED
  static constexpr std::size_t side_of_cloth = 16;  // steps take twenty times as long
#else
  static constexpr std::size_t side_of_cloth = 40;  // as in the scene
#endif
  static constexpr std::size_t vertices_of_cloth = side_of_cloth * side_of_cloth;

  explicit ThrowingDesk(CrossingWatch& the_watch)
      : Desk([] {
          const auto found = std::ranges::find(pliant::builtin_scenes(), "crate_on_cloth", &pliant::BuiltinScene::name);
          std::string text(found->text);
          const std::string size = R"("columns": 40, "rows": 40)";
          const std::size_t at = text.find(size);
          REQUIRE(at != std::string::npos);
          text.replace(at, size.size(), fmt::format(R"("columns": {0}, "rows": {0})", side_of_cloth));
          return pliant::parse_scene(text, {}, found->name);
        }),
        watch(the_watch) {}

  void turn_and_look() {
    source.live()->post([this](CommandContext& context) { watch.look(context.session.simulation()); },
                        LiveScene::Kind::steers);
    ++asked;
    do viewer.turn(0.02);
    while (watch.looks < asked);  // so one look each time, however slow the machine
    slowest = std::max(slowest, shown().statistics.total);
  }
  void run_for(double seconds) {
    const std::int64_t end = shown().step + std::lround(60 * seconds);
    while (shown().step < end) turn_and_look();
  }
  /// With the button held; of the point that is there in the picture when it begins. Where few pictures are drawn in
  /// that time it takes longer, lest the mouse should jump.
  void drag_along(const Vec3f& from, const Vec3f& by, double seconds) {
    const std::int64_t begin = shown().step;
    float share = 0;
    while (share < 1) {
      const float due = static_cast<float>(shown().step - begin) / static_cast<float>(60 * seconds);
      share = std::min({1.0F, due, share + 0.08F});
      const Vec2f at = viewer.screen().place_of(from + share * by).value();
      xdotool(fmt::format("mousemove {} {}", std::lround(at.x()), std::lround(at.y())));
      turn_and_look();
    }
  }
  Vec3f mean(bool of_crate) {
    const std::span<const Vec3f> all = shown().frame.content.positions;
    const auto body = of_crate ? all.subspan(vertices_of_cloth) : all.first(vertices_of_cloth);
    return std::accumulate(body.begin(), body.end(), Vec3f(0, 0, 0)) / static_cast<float>(body.size());
  }
  /// The vertex of the cloth that is farthest to the right in the picture and lies no crate's width from the crate.
  std::uint32_t rightmost_beside_crate() {
    const Vec3f crate = mean(true);
    std::optional<std::uint32_t> found;
    for (std::uint32_t v = 0; v < vertices_of_cloth; ++v) {
      if ((position(v) - crate).norm() < 0.2F) continue;
      if (!found || place(v).x() > place(*found).x()) found = v;
    }
    return found.value();
  }
  void tell(const char* what) {
    const auto& statistics = shown().statistics;
    fmt::print("{}: {:.1f} steps a second, {:.2f} ms each, {:.2f} in the slowest second so far; {:.2f} x real time\n",
               what, statistics.rate, 1e3 * statistics.total, 1e3 * slowest, statistics.speed);
    slowest = 0;
  }

  CrossingWatch& watch;
  int asked = 0;       // looks
  double slowest = 0;  // mean of a second [s]
};

}  // namespace

TEST_CASE("a crate is thrown onto a cloth over a ball, which is pulled away under it, and nothing crosses") {
  CrossingWatch watch;
  ThrowingDesk desk(watch);
  desk.run_for(2);
  desk.tell("the cloth has come to lie on the ball");
  const Vec3f top = desk.mean(true) + Vec3f(0, 0, 0.075F);
  desk.move(desk.viewer.screen().place_of(top).value());
  desk.press();
  const Vec3f lift(0, 0.2F, 0.66F), fling(0.85F, 0, 0);
  desk.drag_along(top, lift, 0.9);
  REQUIRE(desk.viewer.interaction().pull().has_value());
  CHECK(desk.viewer.interaction().pull()->point.vertices[0] >= ThrowingDesk::vertices_of_cloth);
  desk.drag_along(top + lift, fling, 0.5);
  desk.release();
  const std::int64_t latest = desk.shown().step + 180;
  while (!watch.lies_on_cloth && desk.shown().step < latest) desk.turn_and_look();
  CHECK(watch.lies_on_cloth);
  desk.tell("the crate has come down on the cloth");

  // The hem, where it is farthest to the right; it swings, so the mouse may miss it, or take the crate in front of it.
  const auto& pull = desk.viewer.interaction().pull();
  const auto holds_cloth = [&] { return pull && pull->point.vertices[0] < ThrowingDesk::vertices_of_cloth; };
  Vec3f held;
  for (int i = 0; i < 20 && !holds_cloth(); ++i) {
    desk.release();
    const std::uint32_t hem = desk.rightmost_beside_crate();
    held = desk.position(hem);
    const Vec2f inside = desk.place(hem) - Vec2f(6, 0);
    desk.move(inside);
    desk.press();
    desk.move(inside + Vec2f(8, 0));
  }
  REQUIRE(holds_cloth());
  desk.drag_along(held, {1.3F, 0.1F, 0.4F}, 0.7);
  desk.run_for(0.7);
  desk.release();
  desk.tell("the cloth was pulled away");
  desk.run_for(1.5);
  desk.tell("all lies on the floor");
  CHECK(desk.mean(false).x() > 0.4F);
  CHECK(desk.mean(true).z() < 0.3F);
  CHECK(watch.looks >= 3 * 13);  // a drag turns thirteen times at least
  CHECK(watch.crossings == 0);
  CHECK(desk.shown().note.empty());
}

TEST_CASE("colors show gaps and forces of surfaces, and what lies on another body is taken hold of") {
  Desk desk([] {
    return pliant::parse_scene(R"({ "pliant": 1, "bodies": [
      { "name": "table", "mesh": { "shape": "grid", "columns": 7, "rows": 7, "plane": "xy" }, "mass": { "total": 1 },
        "constraints": [ { "type": "position" } ] },
      { "name": "cloth", "mesh": { "shape": "grid", "columns": 9, "rows": 9, "size": [0.6, 0.6], "plane": "xy" },
        "transform": { "translate": [0.2, 0.2, 0.03] }, "mass": { "total": 0.2 },
        "constraints": [ { "type": "triangle_strain", "stiffness": 100 } ] } ],
      "contact": {}, "view": { "camera": { "position": [0.5, -2, 2], "target": [0.5, 0.5, 0] } } })",
                               {}, "table");
  });
  constexpr std::uint32_t first = 49, of_cloth = first + 40;
  const auto values = [&](pliant::ColorBy color) {
    while (desk.viewer.appearance().color != color) desk.key("c");
    desk.turn_until([&] { return desk.shown().color == color && desk.shown().step > 120; });
    return std::vector<float>(desk.shown().frame.content.values.begin() + first,
                              desk.shown().frame.content.values.end());
  };
  const std::vector<float> forces = values(pliant::ColorBy::contact_force), gaps = values(pliant::ColorBy::gap);
  REQUIRE(forces.size() == 81);
  CHECK(std::accumulate(forces.begin(), forces.end(), 0.0F) == doctest::Approx(0.2 * 9.81).epsilon(0.05));
  const auto [nearest, farthest] = std::ranges::minmax(gaps);
  CHECK(nearest > 0.02F);
  CHECK(nearest < 0.0303F);                           // the mean of both distances is 3.02 cm
  CHECK((farthest < 0.0303F || farthest > 0.0416F));  // the table's, where nothing pushes
  desk.move(desk.place(of_cloth));
  desk.press();
  desk.move(desk.place(of_cloth) + Vec2f(0, -60));
  REQUIRE(desk.viewer.interaction().pull().has_value());
  CHECK(desk.viewer.interaction().pull()->point.vertices[0] >= first);
  desk.turn_until([&] { return desk.position(of_cloth).z() > 0.06F; });
  desk.release();
}

TEST_CASE("the panel lets surfaces touch, and has how a body does") {
  Desk desk([] {
    return pliant::parse_scene(R"({ "pliant": 1, "bodies": [ { "name": "sheet", "mass": { "total": 1 },
      "mesh": { "shape": "grid", "columns": 9, "rows": 9, "size": [1, 1], "plane": "xz" },
      "constraints": [ { "type": "position", "on": [72, 80] }, { "type": "edge_spring", "stiffness": 500 } ] } ] })",
                               {}, "sheet");
  });
  const auto place = [&](const char* key) {
    const auto rect = desk.source.parameter_panel().place_of(key);
    REQUIRE(rect.has_value());
    return *rect;
  };
  const auto middle_of = [](const std::array<float, 4>& rect, float x) { return Vec2f(x, (rect[1] + rect[3]) / 2); };
  CHECK(desk.parameter("contact.surfaces") == 0);
  // Bodies and solver are folded, lest the rows below be out of sight.
  const auto fold = [&](const std::array<float, 4>& first_row, float above = 14) {
    desk.click({first_row[0] - 40, first_row[1] - above});
    desk.turns(5);
  };
  fold(desk.source.material_panel().place_of("sheet").value(), 36);
  CHECK_FALSE(desk.source.material_panel().place_of("sheet").has_value());
  fold(place("settings.time_step"));
  const auto surfaces = place("contact.surfaces");
  desk.click(middle_of(surfaces, surfaces[0] + 5));
  desk.turn_until([&] { return desk.parameter("contact.surfaces") == 1; });
  CHECK(desk.parameter("contact:sheet.self") == 1);
  CHECK_FALSE(desk.source.parameter_panel().place_of("contact:sheet.self").has_value());  // folded
  desk.turns(5);
  const float row = place("contact.surfaces")[1] - place("contact.friction")[1];
  desk.click({surfaces[0] - 60, (surfaces[1] + surfaces[3]) / 2 + 0.9F * row});  // its name, below
  desk.turn_until([&] { return desk.source.parameter_panel().place_of("contact:sheet.self").has_value(); });
  desk.turns(5);  // until the rows stand still
  const auto self = place("contact:sheet.self");
  desk.click(middle_of(self, self[0] + 5));
  desk.turn_until([&] { return desk.parameter("contact:sheet.self") == 0; });
  const auto friction = place("contact:sheet.friction");
  desk.click(middle_of(friction, friction[2] - 3));
  desk.turn_until([&] { return desk.parameter("contact:sheet.friction") > 1.5; });
  desk.key("r");
  desk.turn_until([&] { return desk.shown().restarts == 1; });
  desk.turns(5);
  CHECK(desk.parameter("contact.surfaces") == 1);
  CHECK(desk.parameter("contact:sheet.self") == 0);
  CHECK(desk.parameter("contact.friction") == 0.3);
  desk.click(middle_of(place("contact.surfaces"), surfaces[0] + 5));
  desk.turn_until([&] { return desk.parameter("contact.surfaces") == 0; });
}

TEST_CASE("a collider is clicked, then moved by the arrow of its handle and turned by a ring, while cloth lies on it") {
  Desk desk([] {
    return pliant::parse_scene(R"({ "pliant": 1, "bodies": [ { "name": "cloth", "mass": { "total": 0.2 },
      "mesh": { "shape": "grid", "columns": 9, "rows": 9, "size": [0.5, 0.5], "plane": "xy" },
      "transform": { "translate": [-0.25, -0.25, 0.12] },
      "constraints": [ { "type": "triangle_strain", "stiffness": 100 } ] } ],
      "contact": { "surfaces": false },
      "colliders": [ { "type": "box", "name": "table", "size": [1, 1, 0.2], "velocity": [0, 0, 0.01] } ],
      "view": { "camera": { "position": [0.6, -2.4, 1.4], "target": [0, 0, 0.1] } } })",
                               {}, "table");
  });
  using Part = TransformGizmo::Part;
  const auto pose = [&] { return desk.shown().movable.begin()->second.pose; };
  const auto place = [&](Part part) {
    desk.turns(2);
    return desk.viewer.collider_gizmo().place_of(part, desk.viewer.mouse_view()).value();
  };
  const auto drag = [&](Part part, const Vec2f& by) {
    const Vec2f from = place(part);
    desk.drag(from, from + by);
    desk.turns(10);
    desk.release();
  };
  CHECK_FALSE(desk.viewer.collider_gizmo().is_shown());
  const Vec2f corner = desk.viewer.screen().place_of({0.4F, -0.5F, 0}).value();
  desk.click(corner);
  desk.turns(3);
  REQUIRE(desk.viewer.collider_gizmo().selected() == "table");
  CHECK(desk.viewer.collider_gizmo().is_shown());
  CHECK_FALSE(desk.viewer.interaction().is_busy());
  const std::int64_t start = desk.shown().step;
  desk.turn_until([&] { return desk.shown().step > start + 60; });
  const pliant::Pose before = pose();
  const float cloth = desk.position(40).z();
  drag(Part::move_z, {0, -40});
  desk.turn_until([&] { return desk.shown().movable.begin()->second.pose.position.z() > before.position.z() + 0.05; });
  desk.turn_until([&] { return desk.position(40).z() > cloth + 0.04F; });
  CHECK((pose().position - before.position).head<2>().norm() < 1e-5);
  const pliant::Pose moved = pose();
  drag(Part::turn_z, {50, 0});
  desk.turn_until([&] { return pose().rotation.angularDistance(moved.rotation) > 0.1; });
  CHECK((pose().position - moved.position).norm() < 1e-5);
  const Vec3f edge = desk.position(41) - desk.position(40);
  desk.turn_until([&] {
    const auto& drawn = desk.source.frame().content.colliders.at(0);
    return drawn.pose.rotation.angularDistance(pose().rotation) < 1e-6;
  });
  CHECK(std::abs(desk.position(41).y() - desk.position(40).y()) > 0.05F * edge.norm());  // the cloth has gone with it
  const auto row = desk.source.parameter_panel().place_of("table##turned");
  CHECK(row.has_value());
  desk.key("Escape");
  CHECK(desk.viewer.collider_gizmo().selected().empty());
  const Vec3f front = pose().to_space({0.4, -0.5, 0}).cast<float>();
  desk.click(desk.viewer.screen().place_of(front).value());
  CHECK(desk.viewer.collider_gizmo().selected() == "table");
  desk.click({20, 20});
  CHECK(desk.viewer.collider_gizmo().selected().empty());
  CHECK(desk.shown().note.empty());
}

int main(int argc, char** argv) {
  return run_on_display(argc, argv);
}
