// Selecting, pinning and moving many vertices in the real window, driven by mouse and keys.
#define DOCTEST_CONFIG_IMPLEMENT
#include <algorithm>

#include "desk.h"

using namespace pliant_tests;

namespace {

using Part = PinGizmo::Part;

/// Draws a box with Ctrl around vertices.
void select_box(Desk& desk, std::initializer_list<std::uint32_t> around) {
  Vec2f low = desk.place(*around.begin()), high = low;
  for (const std::uint32_t vertex : around) {
    low = low.cwiseMin(desk.place(vertex));
    high = high.cwiseMax(desk.place(vertex));
  }
  xdotool("keydown ctrl");
  desk.drag(low - Vec2f(5, 5), high + Vec2f(5, 5));
  desk.release();
  xdotool("keyup ctrl");
  desk.turns(3);
}

/// Pixels with the color of what is selected.
int amber_pixels(const Desk::Picture& picture) {
  int count = 0;
  for (std::size_t i = 0; i + 2 < picture.pixels.size(); i += 3) {
    const auto* p = &picture.pixels[i];
    if (p[0] > 235 && p[1] > 150 && p[1] < 205 && p[2] < 80) ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("a box is selected, pinned by a key as one change, moved by the handle, let go, and taken back") {
  Desk desk;
  desk.settle();
  select_box(desk, {50, 52, 74, 76});
  const std::vector<std::uint32_t> selected = desk.viewer.selection().selected();
  REQUIRE(selected.size() >= 9);
  for (const std::uint32_t vertex : {50U, 51U, 52U, 62U, 63U, 64U, 74U, 75U, 76U}) {
    CHECK(std::ranges::binary_search(selected, vertex));
  }
  CHECK_FALSE(desk.shown().pull.has_value());
  CHECK_FALSE(desk.viewer.gizmo().is_shown());
  desk.key("n");
  desk.turn_until([&] { return desk.is_pinned(63); });
  for (const std::uint32_t vertex : selected) CHECK(desk.is_pinned(vertex));
  CHECK(desk.shown().undone_next == fmt::format("pin {} vertices", selected.size()));
  desk.turn_until([&] { return desk.viewer.gizmo().is_shown(); });
  CHECK(amber_pixels(desk.picture()) == 0);  // a saved picture has no marks of what is selected

  std::vector<Vec3f> before;
  for (const std::uint32_t vertex : selected) before.push_back(desk.position(vertex));
  const Vec2f arrow = desk.viewer.gizmo().place_of(Part::move_z, desk.viewer.mouse_view()).value();
  desk.drag(arrow, arrow - Vec2f(0, 60));
  CHECK(desk.viewer.gizmo().is_busy());
  CHECK_FALSE(desk.viewer.interaction().is_busy());
  desk.release();
  desk.turns(10);
  const Vec3f way = desk.position(selected.front()) - before.front();
  CHECK(way.z() > 0.05F);
  CHECK(way.head<2>().norm() < 1e-4F);
  for (std::size_t i = 0; i < selected.size(); ++i) {
    CHECK((desk.position(selected[i]) - before[i] - way).norm() < 1e-4F);
  }
  // A press and a move that come at once, as from a quick hand, take hold of what was pressed.
  const Vec2f middle = desk.viewer.gizmo().place_of(Part::plane, desk.viewer.mouse_view()).value();
  desk.move(middle);
  xdotool("mousedown 1 mousemove_relative -- 30 20");
  desk.turns(3);
  CHECK(desk.viewer.gizmo().is_busy());
  desk.release();
  desk.turns(5);
  for (const std::uint32_t vertex : selected) CHECK(desk.is_pinned(vertex));

  desk.key("n");
  desk.turn_until([&] { return !desk.is_pinned(63); });
  for (const std::uint32_t vertex : selected) CHECK_FALSE(desk.is_pinned(vertex));
  CHECK(desk.shown().undone_next == fmt::format("unpin {} vertices", selected.size()));
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.is_pinned(63); });
  desk.key("ctrl+z");
  desk.turn_until([&] { return !desk.is_pinned(63); });
  CHECK(desk.shown().undone_next.empty());
}

TEST_CASE("keys and clicks select vertices, a border and everything, and nothing again") {
  Desk desk;
  desk.settle();
  desk.key("n");
  CHECK(desk.viewer.message().starts_with("nothing is selected"));
  desk.move(desk.place(65));
  xdotool("keydown ctrl click 1 keyup ctrl");
  desk.turns(3);
  CHECK(desk.viewer.selection().selected() == std::vector<std::uint32_t>{65});
  CHECK(desk.shown().pins.size() == 2);  // no pin was set
  desk.move(desk.place(6));
  xdotool("keydown ctrl click --repeat 2 --delay 30 1 keyup ctrl");
  desk.turns(3);
  CHECK(desk.viewer.selection().selected().size() == 4 * (side - 1) + 1);
  desk.key("Escape");
  CHECK(desk.viewer.selection().selected().empty());
  desk.key("ctrl+a");
  CHECK(desk.viewer.selection().selected().size() == side * side);
  desk.key("b");
  CHECK(desk.viewer.message() == "Ctrl + drag draws a lasso");
  CHECK(desk.viewer.selection().draws_lasso);
  xdotool("keydown ctrl keydown shift");
  const Vec2f at = desk.place(65);
  desk.move(at + Vec2f(-14, -14));
  desk.press();
  for (const Vec2f& corner : {Vec2f(14, -14), Vec2f(14, 14), Vec2f(-14, 14)}) desk.move(at + corner);
  desk.release();
  xdotool("keyup ctrl keyup shift");
  desk.turns(3);
  const auto left = desk.viewer.selection().selected();
  CHECK_FALSE(std::ranges::binary_search(left, 65U));
  CHECK(left.size() > side * side - 10);
  desk.key("r");  // the same scene again: what was selected stays
  desk.turns(10);
  CHECK(desk.viewer.selection().selected() == left);
}

TEST_CASE("the tour is walked through from the list of scenes, by doing what it asks for") {
  Desk desk(make_sheet, 1, [](const std::string&) { return std::string(); });
  desk.settle();
  desk.key("ctrl+o");
  desk.turn_until([&] { return desk.viewer.scene_panel().place_of("flag").has_value(); });
  const auto first = desk.viewer.scene_panel().place_of("flag").value();
  desk.click({first[2] - 90, first[1] - 22});  // the button beside Close
  desk.turns(4);
  CHECK_FALSE(desk.viewer.scene_panel().is_open);
  REQUIRE(desk.viewer.tour().step() == 0);
  desk.drag(desk.place(65), desk.place(65) + Vec2f(40, 30));
  desk.turns(4);
  CHECK(desk.viewer.tour().step() == 0);
  desk.release();
  desk.turn_until([&] { return desk.viewer.tour().step() == 1; });
  desk.drag({30, 320}, {70, 330});
  desk.release();
  desk.turn_until([&] { return desk.viewer.tour().step() == 2; });
  desk.click(desk.place(65));
  desk.turn_until([&] { return desk.viewer.tour().step() == 3; });
  select_box(desk, {50, 52, 74, 76});
  desk.key("n");
  desk.turn_until([&] { return desk.viewer.gizmo().is_shown(); });
  const Vec2f arrow = desk.viewer.gizmo().place_of(Part::move_z, desk.viewer.mouse_view()).value();
  desk.drag(arrow, arrow - Vec2f(0, 30));
  desk.release();
  desk.turn_until([&] { return desk.viewer.tour().step() == 4; });
  const auto place = [&] { return desk.source.parameter_panel().place_of("settings.iterations").value(); };
  desk.move({950, 320});  // down in the panel, as far as that goes
  for (float before = -1; place()[3] > 560 && place()[1] != before; desk.turns(8)) {
    before = place()[1];
    xdotool("click 5");
  }
  const auto rect = place();
  const float y = (rect[1] + rect[3]) / 2, width = rect[2] - rect[0];
  desk.drag({rect[0] + 0.55F * width, y}, {rect[0] + 0.9F * width, y});
  desk.release();
  desk.turn_until([&] { return desk.shown().undone_next == "iterations"; });
  desk.turns(4);
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.viewer.tour().step() == Tour::step_count; });
}

int main(int argc, char** argv) {
  return run_on_display(argc, argv);
}
