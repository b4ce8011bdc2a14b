// The panel in the real window: headings, numbers that are typed, rows of colliders, light and dark, larger letters.
#define DOCTEST_CONFIG_IMPLEMENT
#include <array>

#include <doctest/doctest.h>

#include "desk.h"
#include "viewer/panels/panel_style.h"

using namespace pliant_tests;

namespace {

using Rect = std::array<float, 4>;

Vec2f middle(const Rect& rect) {
  return {(rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2};
}

/// Of one of the three fields of a vector.
Vec2f field(const Rect& rect, int number) {
  const float third = (rect[2] - rect[0]) / 3;
  return {rect[0] + (static_cast<float>(number) + 0.5F) * third, (rect[1] + rect[3]) / 2};
}

/// A cloth above a table, and a ball that holds air.
Scene read_table() {
  return pliant::parse_scene(R"({ "pliant": 1, "bodies": [
    { "name": "cloth", "mesh": { "shape": "grid", "columns": 7, "rows": 7, "size": [0.5, 0.5], "plane": "xy" },
      "transform": { "translate": [-0.25, -0.25, 0.3] }, "mass": { "total": 0.2 },
      "constraints": [ { "type": "triangle_strain", "name": "stretch", "stiffness": 100 },
                       { "type": "hinge", "name": "bend", "stiffness": 4e-6 } ] },
    { "name": "ball", "mesh": { "shape": "sphere", "radius": 0.1, "subdivisions": 1 },
      "transform": { "translate": [0.3, 0, 0.5] }, "mass": { "total": 0.1 },
      "constraints": [ { "type": "edge_strain", "name": "skin", "stiffness": 500 } ] } ],
    "contact": { "surfaces": false },
    "colliders": [ { "type": "box", "name": "table", "size": [1, 1, 0.2] },
                   { "type": "sphere", "name": "knob", "center": [0.7, 0, 0], "radius": 0.1 } ],
    "view": { "camera": { "position": [0.6, -2.4, 1.4], "target": [0, 0, 0.1] } } })",
                             {}, "table");
}

Scene make_sheet_with_text() {
  return pliant::parse_scene(R"({ "pliant": 1, "bodies": [ { "name": "sheet", "mass": { "total": 1 },
    "mesh": { "shape": "grid", "columns": 5, "rows": 5 },
    "constraints": [ { "type": "edge_spring", "stiffness": 500 } ] } ] })",
                             {}, "sheet");
}

struct PanelDesk : Desk {
  explicit PanelDesk(MakeScene make = read_table) : Desk(std::move(make)) {
    key("space");  // paused
    turn_until([&] { return !shown().is_playing; });
  }
  /// Turns the wheel over the panel until all of that is seen.
  Rect scrolled_to(const std::function<Rect()>& place) {
    turns(2);
    move({800, 320});  // beside widgets that take the wheel
    for (int i = 0; i < 80 && place()[3] > 625; ++i) scroll(5);
    for (int i = 0; i < 80 && place()[1] < 15; ++i) scroll(4);
    turns(4);
    return place();
  }
  void scroll(int button) {
    xdotool(fmt::format("click {}", button));
    turns(4);
  }
  Rect row(const std::string& key) {
    const auto place = [&] { return source.parameter_panel().place_of(key); };
    turn_until([&] { return place().has_value(); });
    return scrolled_to([&] { return *place(); });
  }
  Rect heading(const std::string& title) {
    return scrolled_to([&] { return section_place(title).value(); });
  }
  void type(const std::string& text) {
    xdotool(fmt::format("type --delay 30 -- '{}'", text));
    turns(4);
    key("Return");
    turns(4);
  }
  pliant::Vec3 vector(std::string_view key) {
    for (const Slider& slider : *shown().sliders) {
      if (slider.key == key) return slider.parameter.value;
    }
    throw std::logic_error("no such parameter");
  }
  pliant::Pose pose_of(const std::string& name) {
    for (const auto& [id, collider] : shown().movable) {
      if (collider.name == name) return collider.pose;
    }
    throw std::logic_error("no such collider");
  }
};

}  // namespace

TEST_CASE("each section folds by a click on its heading, and unfolds by another") {
  PanelDesk desk;
  const std::vector<std::string> titles = {"Bodies",    "Solver",  "Forces", "Contact",
                                           "Colliders", "Picture", "Film",   "Window"};
  for (std::size_t i = 0; i < titles.size(); ++i) {
    CAPTURE(titles[i]);
    const auto height = [&] {
      const Rect here = section_place(titles[i]).value();
      const Rect next = i + 1 < titles.size() ? section_place(titles[i + 1]).value() : desk.viewer.button_place("Help");
      return next[1] - here[1];
    };
    const auto click = [&] {
      const Rect rect = desk.heading(titles[i]);
      desk.click({rect[0] + 60, (rect[1] + rect[3]) / 2});
      desk.turns(5);
    };
    const bool was_open = height() > 36;
    CHECK(was_open == (titles[i] != "Film"));
    click();
    CHECK((height() > 36) == !was_open);
    click();
    CHECK((height() > 36) == was_open);
  }
}

TEST_CASE("a number beside its slider is typed after a click on it, and changed by a drag sideways") {
  PanelDesk desk;
  desk.click(middle(desk.row("number:settings.iterations")));
  desk.turns(3);
  desk.type("37");
  desk.turn_until([&] { return desk.parameter("settings.iterations") == 37; });
  CHECK(desk.shown().undone_next.find("iterations") != std::string::npos);

  desk.click(middle(desk.row("number:group:stretch.stiffness")));
  desk.turns(3);
  desk.type("2500");
  desk.turn_until([&] { return desk.parameter("group:stretch.stiffness") == 2500; });
  const Rect number = desk.row("number:group:stretch.stiffness"), slider = desk.row("group:stretch.stiffness");
  CHECK(slider[2] < number[0]);  // it stands beside its slider
  CHECK(slider[1] == number[1]);
  const std::size_t edits = desk.shown().edits;
  desk.drag(middle(number), middle(number) + Vec2f(30, 0));
  desk.release();
  desk.turn_until([&] { return desk.parameter("group:stretch.stiffness") > 2600; });
  desk.turn_until([&] { return desk.shown().edits == edits + 1; });  // the drag is one change
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.parameter("group:stretch.stiffness") == 2500; });
  CHECK(desk.shown().note.empty());
}

TEST_CASE("a slider goes by powers of ten, also where numbers are tiny") {
  PanelDesk desk;
  const Rect slider = desk.row("group:bend.stiffness");
  desk.click({slider[0] + 0.75F * (slider[2] - slider[0]), (slider[1] + slider[3]) / 2});
  desk.turn_until([&] { return desk.parameter("group:bend.stiffness") > 4e-6; });
  CHECK(desk.parameter("group:bend.stiffness") > 4e-5);
  CHECK(desk.parameter("group:bend.stiffness") < 4e-4);
}

TEST_CASE("the numbers of a vector are typed one by one") {
  PanelDesk desk;
  const std::string key = "force:gravity.acceleration";
  desk.click(field(desk.row(key), 0));
  desk.turns(3);
  desk.type("1.5");
  desk.turn_until([&] { return desk.vector(key).x() == 1.5; });
  CHECK(desk.vector(key).z() == doctest::Approx(-9.81));
  desk.click(field(desk.row(key), 2));
  desk.turns(3);
  desk.type("-1.6");
  desk.turn_until([&] { return desk.vector(key).z() == -1.6; });
  CHECK(desk.vector(key).x() == 1.5);
}

TEST_CASE("a click on a collider scrolls the panel to its rows, and a click on a name there selects") {
  PanelDesk desk;
  desk.turns(5);
  desk.click(desk.viewer.screen().place_of({0.4F, -0.5F, 0}).value());
  desk.turns(5);
  REQUIRE(desk.viewer.collider_gizmo().selected() == "table");
  const Rect seen = desk.source.parameter_panel().place_of("collider:table").value();
  CHECK(seen[1] >= 0);
  CHECK(seen[3] <= 640);
  const Rect knob = desk.row("collider:knob");
  desk.click({knob[0] + 60, (knob[1] + knob[3]) / 2});
  desk.turns(5);
  CHECK(desk.viewer.collider_gizmo().selected() == "knob");
  const Rect again = desk.row("collider:knob");
  desk.click({again[0] + 60, (again[1] + again[3]) / 2});
  desk.turns(5);
  CHECK(desk.viewer.collider_gizmo().selected().empty());  // as a second click in the picture
}

TEST_CASE("a collider is moved and turned by its rows, and switched off by its box") {
  PanelDesk desk;
  const Rect name = desk.row("collider:table");
  desk.click({name[0] + 60, (name[1] + name[3]) / 2});
  desk.turns(5);
  REQUIRE(desk.viewer.collider_gizmo().selected() == "table");
  desk.key("space");  // it goes where it is sent
  const Vec2f x = field(desk.row("table##place"), 0);
  desk.drag(x, x + Vec2f(40, 0));
  desk.turns(5);
  desk.release();
  desk.turn_until([&] { return desk.pose_of("table").position.x() > 0.2; });
  CHECK(std::abs(desk.pose_of("table").position.y()) < 1e-6);
  desk.click(field(desk.row("table##turned"), 2));
  desk.turns(3);
  desk.type("90");
  const auto angle = [&] { return Eigen::AngleAxis<pliant::Real>(desk.pose_of("table").rotation).angle(); };
  desk.turn_until([&] { return std::abs(angle() - 1.5707963) < 1e-4; });
  desk.click(middle(desk.row("switch:table")));
  desk.turn_until([&] { return desk.shown().undone_next == "table off"; });
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.shown().switches->at("table"); });
  CHECK(desk.shown().note.empty());
}

TEST_CASE("a pressure is offered in closed bodies alone") {
  PanelDesk desk;
  desk.click(middle(desk.row("add forces")));
  desk.turns(4);
  const auto offer = [&](const char* what) {
    return desk.source.parameter_panel().place_of(std::string("add ") + what);
  };
  CHECK_FALSE(offer("pressure in cloth").has_value());
  CHECK_FALSE(offer("pressure: no body is closed").has_value());
  REQUIRE(offer("pressure in ball").has_value());
  desk.click(middle(*offer("pressure in ball")));
  desk.turn_until([&] { return desk.shown().undone_next == "add pressure"; });
  CHECK(desk.shown().note.empty());
}

TEST_CASE("where no body is closed the menu says that a pressure needs one") {
  PanelDesk desk(make_sheet_with_text);
  desk.click(middle(desk.row("add forces")));
  desk.turns(4);
  const auto offer = desk.source.parameter_panel().place_of("add pressure: no body is closed");
  REQUIRE(offer.has_value());
  const std::size_t edits = desk.shown().edits;
  desk.click(middle(*offer));
  desk.turns(8);
  CHECK(desk.shown().edits == edits);
  CHECK(desk.shown().note.empty());
}

TEST_CASE("panels are light or dark as is chosen, larger and smaller by keys, and so at the next start") {
  PanelDesk desk;
  const std::filesystem::path file = desk.state.path() / "window.json";
  CHECK(read_window_settings(file) == WindowSettings{});
  const auto theme = [&] { return desk.viewer.button_place("theme"); };
  desk.heading("Window");
  desk.click(middle(desk.scrolled_to(theme)));
  desk.turns(4);
  desk.click(middle(desk.viewer.button_place("theme dark")));
  desk.turns(4);
  CHECK(desk.viewer.settings().theme == Theme::dark);
  CHECK(desk.viewer.panel_color().maxCoeff() < 0.3F);
  CHECK(read_window_settings(file).theme == Theme::dark);
  desk.key("ctrl+t");
  CHECK(desk.viewer.settings().theme == Theme::light);
  CHECK(desk.viewer.panel_color().minCoeff() > 0.7F);
  desk.key("ctrl+t");
  CHECK(desk.viewer.panel_color().maxCoeff() < 0.3F);
  desk.click(middle(theme()));
  desk.turns(4);
  desk.click(middle(desk.viewer.button_place("theme automatic")));
  desk.turns(4);
  CHECK(desk.viewer.panel_color().minCoeff() > 0.7F);  // as the background

  CHECK(desk.viewer.panel_scale() == 1);
  const float width = desk.viewer.screen().size.x();
  desk.key("ctrl+plus");
  CHECK(desk.viewer.panel_scale() == 1.25F);
  desk.turns(3);
  CHECK(desk.viewer.screen().size.x() < width - 50);  // the panel is wider
  CHECK(read_window_settings(file).scale == 1.25F);
  desk.key("ctrl+minus");
  desk.key("ctrl+minus");
  CHECK(desk.viewer.panel_scale() == 0.75F);
  desk.key("ctrl+0");
  CHECK(desk.viewer.panel_scale() == 1);
  CHECK(read_window_settings(file) == WindowSettings{});
}

int main(int argc, char** argv) {
  return run_on_display(argc, argv);
}
