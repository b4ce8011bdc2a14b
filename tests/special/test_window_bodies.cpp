// The panel's part on bodies in the real window: colors, patterns, and switches of constraints and forces.
#include <fstream>

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "desk.h"
#include "render/image.h"

using namespace pliant_tests;

namespace {

Vec2f middle(const std::array<float, 4>& rect) {
  return {(rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2};
}

/// With a text, to which something can be added.
Scene read_sheet() {
  return pliant::parse_scene(R"({ "pliant": 1, "bodies": [ { "name": "sheet", "mass": { "total": 1 },
    "mesh": { "shape": "grid", "columns": 9, "rows": 9, "size": [1, 1], "plane": "xz" },
    "constraints": [ { "type": "position", "on": [72, 80] }, { "type": "edge_spring", "stiffness": 500 } ] } ] })",
                             {}, "sheet");
}

struct BodyDesk : Desk {
  Vec2f widget(const std::string& key) {
    turn_until([&] { return source.body_panel().place_of(key).has_value(); });
    return middle(*source.body_panel().place_of(key));
  }
  Vec2f switch_of(const std::string& name) {
    turn_until([&] { return source.parameter_panel().place_of("switch:" + name).has_value(); });
    return middle(*source.parameter_panel().place_of("switch:" + name));
  }
  const pliant::BodyAppearance& appearance() { return shown().appearances->at("body 0"); }
  bool has_appearance() { return shown().appearances->contains("body 0"); }
  bool is_on(const std::string& name) { return shown().switches->at(name); }
  /// The mean color of the picture around a vertex.
  std::array<double, 3> color_at(std::uint32_t vertex) {
    const Picture seen = picture();
    const Vec2f at = place(vertex);
    std::array<double, 3> sum{};
    for (int dy = -3; dy <= 3; ++dy) {
      for (int dx = -3; dx <= 3; ++dx) {
        const int x = static_cast<int>(at.x()) + dx, y = static_cast<int>(at.y()) + dy;
        for (std::size_t k = 0; k < 3; ++k) {
          sum[k] += seen.pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(seen.width) +
                                     static_cast<std::size_t>(x)) +
                                k] /
                    49.0;
        }
      }
    }
    return sum;
  }
};

}  // namespace

TEST_CASE("a color is picked by the mouse, is seen, and is one change for undo") {
  BodyDesk desk;
  desk.settle();
  constexpr std::uint32_t middle_vertex = side * 5 + 6;
  const std::array<double, 3> before = desk.color_at(middle_vertex);
  CHECK(before[0] > before[2] + 20);  // red, the first tone
  const std::size_t pins = desk.shown().pins.size();
  desk.click(desk.widget("body 0.front"));
  desk.turns(4);
  // The picker opens above, where there is room: a drag over its field of shades.
  const Vec2f swatch = desk.widget("body 0.front");
  desk.drag(swatch + Vec2f(-20, -220), swatch + Vec2f(40, -140));
  desk.turn_until([&] { return desk.has_appearance(); });
  desk.release();
  const pliant::Color first = *desk.appearance().front;
  CHECK(desk.appearance().back.has_value());  // as it was seen
  CHECK_FALSE(*desk.appearance().back == first);
  CHECK(desk.shown().undone_next == "body 0: appearance");
  // Beside the picker a press closes it, and does no more.
  desk.click(desk.place(middle_vertex));
  desk.turns(5);
  CHECK(desk.shown().pins.size() == pins);
  desk.click(desk.place(middle_vertex));
  desk.turn_until([&] { return desk.shown().pins.size() == pins + 1; });
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.shown().pins.size() == pins; });
  desk.key("ctrl+z");
  desk.turn_until([&] { return !desk.has_appearance(); });
  CHECK(desk.shown().undone_next.empty());  // the whole drag was one
  desk.key("ctrl+y");
  desk.turn_until([&] { return desk.has_appearance(); });
  CHECK(*desk.appearance().front == first);
}

TEST_CASE("what is set shows in the picture, and a pattern is chosen from its menu") {
  BodyDesk desk;
  desk.settle();
  desk.source.live()->post([](CommandContext& context) {
    context.session.set_appearance("body 0",
                                   {.front = pliant::Color{0.1, 0.2, 0.8}, .back = pliant::Color{0.1, 0.2, 0.8}});
  });
  desk.turn_until([&] { return desk.has_appearance(); });
  desk.turns(3);
  constexpr std::uint32_t middle_vertex = side * 5 + 6;
  const std::array<double, 3> blue = desk.color_at(middle_vertex);
  CHECK(blue[2] > blue[0] + 40);
  const Vec2f menu = desk.widget("body 0.pattern");
  desk.click(menu);
  desk.turns(4);
  desk.key("Escape");  // closes it
  CHECK(desk.appearance().pattern == pliant::Pattern::none);
  desk.click(menu);
  desk.turns(4);
  desk.click(menu + Vec2f(0, 42));
  desk.turn_until([&] { return desk.appearance().pattern == pliant::Pattern::checker; });
  desk.turn_until([&] { return desk.source.body_panel().place_of("body 0.pattern_size").has_value(); });
  const double size = desk.appearance().pattern_size;
  desk.drag(desk.widget("body 0.pattern_size"), desk.widget("body 0.pattern_size") + Vec2f(30, 0));
  desk.release();
  desk.turn_until([&] { return desk.appearance().pattern_size > size; });
  CHECK(*desk.appearance().front == pliant::Color{0.1, 0.2, 0.8});
}

TEST_CASE("a picture that is dropped onto a body is laid on it, and taken off by its button") {
  BodyDesk desk;
  desk.settle();
  constexpr std::uint32_t middle_vertex = side * 5 + 6;
  const std::array<double, 3> before = desk.color_at(middle_vertex);
  const TemporaryFolder folder;  // not that of the window, where pictures are counted
  const std::filesystem::path file = folder.path() / "print.PNG";
  pliant_render::write_png(file, {2, 1, {20, 200, 40, 20, 200, 40}});
  desk.move(desk.place(middle_vertex));
  drop(desk, {file.string()});
  desk.turn_until([&] { return desk.has_appearance() && !desk.appearance().texture.empty(); });
  CHECK(desk.shown().undone_next == "body 0: appearance");
  desk.turn_until([&] { return desk.viewer.message() == "body 0: print.PNG"; });
  desk.turns(5);
  const std::array<double, 3> green = desk.color_at(middle_vertex);
  CHECK(green[1] > green[0] + 40);
  CHECK(std::abs(green[1] - before[1]) + std::abs(green[0] - before[0]) > 40);
  CHECK_FALSE(desk.appearance().back.has_value());
  // Another change leaves it on both sides.
  desk.click(desk.widget("body 0.finish"));
  desk.turns(4);
  desk.key("Down");
  desk.key("Return");
  desk.turns(4);
  desk.key("Escape");
  CHECK_FALSE(desk.appearance().back.has_value());
  desk.click(desk.widget("body 0.no_texture"));
  desk.turn_until([&] { return desk.appearance().texture.empty(); });
  desk.key("ctrl+z");
  desk.turn_until([&] { return !desk.appearance().texture.empty(); });

  std::ofstream(folder.path() / "broken.jpg") << "no picture";
  drop(desk, {(folder.path() / "broken.jpg").string()});
  desk.turn_until([&] { return desk.shown().note.find("PNG or JPEG") != std::string::npos; });
  CHECK(desk.appearance().texture == file.string());
}

TEST_CASE("constraints and forces are switched off and on by their boxes") {
  BodyDesk desk;
  desk.turn_until([&] { return desk.shown().step > 10; });
  const auto low = [&] { return desk.position(0).z(); };
  desk.click(desk.switch_of("stretch"));
  desk.turn_until([&] { return !desk.is_on("stretch"); });
  CHECK(desk.shown().undone_next == "stretch off");
  const float before = low();
  desk.turn_until([&] { return low() < before - 1; });  // nothing holds it
  desk.turns(5);
  desk.click(desk.switch_of("stretch"));
  desk.turn_until([&] { return desk.is_on("stretch"); });
  desk.turn_until([&] { return low() > -2; });
  CHECK(desk.shown().note.empty());
  desk.key("r");
  desk.turn_until([&] { return desk.shown().restarts == 1; });
  desk.turns(5);
  desk.click(desk.switch_of("gravity"));
  desk.turn_until([&] { return !desk.is_on("gravity"); });
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.is_on("gravity"); });
}

TEST_CASE("what a scene has switched off has its row, and is switched on by its box") {
  const auto read = [] {
    return pliant::parse_scene(R"({ "pliant": 1, "gravity": { "enabled": false },
      "bodies": [ { "name": "sheet", "material": "silk", "disabled_groups": ["sheet.bend"],
        "mesh": { "shape": "grid", "columns": 9, "rows": 9, "size": [1, 1], "plane": "xz" },
        "constraints": [ { "type": "position", "name": "hooks", "on": [72, 80], "enabled": false } ] } ] })",
                               {}, "sheet");
  };
  struct SheetDesk : Desk {
    using Desk::Desk;
    Vec2f switch_of(const std::string& name) {
      const auto place = [&] { return source.parameter_panel().place_of("switch:" + name); };
      turn_until([&] { return place().has_value(); });
      move({950, 100});
      for (int notch = 0; (*place())[3] > 600 && notch < 40; ++notch) {  // down in the panel
        xdotool("click 5");
        turns(8);
      }
      return middle(*place());
    }
  };
  SheetDesk desk(read);
  desk.turn_until([&] { return desk.shown().step > 3; });
  for (const char* name : {"hooks", "sheet.bend", "gravity"}) {
    CAPTURE(name);
    CHECK_FALSE(desk.shown().switches->at(name));
    desk.click(desk.switch_of(name));
    desk.turn_until([&] { return desk.shown().switches->at(name); });
    CHECK(desk.shown().undone_next == std::string(name) + " on");
  }
  CHECK(desk.shown().pins.size() == 2);
  CHECK(desk.shown().note.empty());
}

TEST_CASE("the arrow of gravity is turned by the mouse, and a folded panel hides it") {
  Desk desk(read_sheet);
  desk.turns(5);
  const auto shown = [&] { return ForceArrows::list(desk.viewer.mouse_view()); };
  REQUIRE(shown().size() == 1);  // no wind blows
  const ForceArrows::Arrow gravity = shown()[0];
  CHECK(gravity.key == "force:gravity.acceleration");
  const Vec2f tip = gravity.middle + Vec2f(0, 0.9F * gravity.radius);
  desk.drag(tip, tip + Vec2f(100, -0.9F * gravity.radius));
  desk.release();
  desk.turn_until([&] { return desk.shown().undone_next == "gravity: acceleration"; });
  desk.turn_until([&] { return !shown().empty() && shown()[0].vector.z() > -5; });
  CHECK(shown()[0].vector.norm() == doctest::Approx(9.81));
  desk.key("ctrl+z");
  desk.turn_until([&] { return !shown().empty() && shown()[0].vector.z() < -9.8F; });
  desk.key("Tab");
  CHECK(shown().empty());
}

TEST_CASE("wind and a ball are added from the panel, and the arrow of the wind is turned by the mouse") {
  Desk desk(read_sheet);
  const auto menu = [&](const char* list) {
    const std::string key = std::string("add ") + list;
    const auto place = [&] { return desk.source.parameter_panel().place_of(key).value(); };
    // Down in the panel, as far as that goes.
    desk.move({950, 100});
    for (float before = -1; place()[3] > 480 && place()[1] != before; desk.turns(8)) {
      before = place()[1];
      xdotool("click 5");
    }
    return Vec2f(place()[0] + 20, (place()[1] + place()[3]) / 2);
  };
  const Vec2f arrow = pliant_render::wind_arrow_place(desk.viewer.screen().size.y());
  CHECK_FALSE(desk.source.frame().wind.has_value());
  const Vec2f forces = menu("forces");
  desk.click(forces);
  desk.turns(4);
  desk.click(forces + Vec2f(0, 30));  // the first
  desk.turn_until([&] { return desk.source.frame().wind.has_value(); });
  CHECK(desk.shown().undone_next == "add wind");
  desk.turns(3);
  const auto velocity = [&] {
    for (const Slider& slider : *desk.shown().sliders) {
      if (slider.key == "force:wind.velocity") return slider.parameter.value;
    }
    return pliant::Vec3(0, 0, 0);
  };
  desk.turn_until([&] { return velocity().norm() > 0; });
  const pliant::Vec3 before = velocity();
  const pliant::Vec3 eye = desk.viewer.screen().viewpoint.eye.cast<double>();
  const std::size_t edits = desk.shown().edits;
  // Far out to the right, and up: in the plane of the picture.
  desk.drag(arrow + Vec2f(3, 0), arrow + Vec2f(200, 0));
  desk.move(arrow + Vec2f(200, -200));
  desk.release();
  desk.turn_until([&] { return velocity().z() > 1; });
  const pliant_render::Viewpoint& view = desk.viewer.screen().viewpoint;
  CHECK(velocity().norm() == doctest::Approx(before.norm()).epsilon(1e-5));
  CHECK(std::abs(velocity().dot(view.forward().cast<double>())) < 0.2 * before.norm());
  CHECK(velocity().dot(view.right().cast<double>()) > 0.5 * before.norm());
  CHECK(velocity().dot(view.up.cast<double>()) > 0.5 * before.norm());
  CHECK(view.eye.cast<double>() == eye);  // the camera has no part in it
  CHECK(desk.shown().edits == edits + 1);
  desk.move(arrow);
  xdotool("click 4");
  desk.turn_until([&] { return velocity().norm() > 1.05 * before.norm(); });
  desk.key("ctrl+z");
  desk.turn_until([&] { return velocity().norm() < 1.05 * before.norm(); });
  desk.key("ctrl+z");
  desk.turn_until([&] { return velocity() == before; });
  const Vec2f colliders = menu("colliders");
  desk.click(colliders);
  desk.turns(4);
  desk.click(colliders + Vec2f(0, colliders.y() > 480 ? -30 : 30));  // the list opens where there is room
  desk.turn_until([&] { return desk.source.frame().content.colliders.size() == 1; });
  CHECK(desk.shown().note.empty());
  desk.key("r");
  desk.turn_until([&] { return desk.shown().restarts == 1; });
  CHECK(desk.source.frame().content.colliders.size() == 1);
}

TEST_CASE("what is selected is pushed by a button") {
  Desk desk(read_sheet);
  desk.key("ctrl+a");
  desk.turns(4);
  CHECK(desk.viewer.selection().selected().size() == 81);
  desk.click(middle(desk.viewer.button_place("Push")));
  desk.turn_until([&] { return desk.shown().undone_next == "push"; });
  desk.turn_until([&] { return desk.parameter("force:test_force.force") == 0; });  // along x
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.shown().undone_next.empty(); });
  CHECK(desk.shown().note.empty());
}

int main(int argc, char** argv) {
  return run_on_display(argc, argv);
}
