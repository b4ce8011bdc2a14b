// A stiffness painted with the brush in the real window.
#define DOCTEST_CONFIG_IMPLEMENT
#include <atomic>

#include <doctest/doctest.h>

#include "desk.h"

using namespace pliant_tests;

namespace {

struct BrushDesk : Desk {
  Vec2f button(const std::string& label) {
    const std::array<float, 4>& rect = viewer.button_place(label);
    return {(rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2};
  }
  /// From the menu of what can be painted.
  void take_brush(const std::string& group) {
    click(button("paint"));
    turns(4);
    click(button("paint " + group));
    turns(4);
    turn_until([&] { return !shown().render_mesh->looks.vertices.empty(); });
  }
  /// As the simulation has them; empty: none.
  std::vector<pliant::Real> factors(const std::string& group) {
    std::vector<pliant::Real> found;
    std::atomic<bool> is_done = false;
    source.live()->post([&](CommandContext& context) {
      const auto& simulation = context.session.simulation();
      found = simulation.groups().at(simulation.find_group(group).value()).factors;
      is_done = true;
    });
    turn_until([&] { return is_done.load(); });
    return found;
  }
  /// How much more red than blue a saved picture has at a vertex.
  int tint_at(std::uint32_t vertex) {
    const Picture seen = picture();
    const Vec2f place_of = place(vertex);
    const auto pixel = 3 * (static_cast<std::size_t>(place_of.y()) * static_cast<std::size_t>(seen.width) +
                            static_cast<std::size_t>(place_of.x()));
    return seen.pixels[pixel] - seen.pixels[pixel + 2];
  }
  bool is_painted(const std::string& group, std::uint32_t vertex) {
    const std::vector<pliant::Real> now = factors(group);
    return !now.empty() && now[vertex] != 1;
  }
};

constexpr std::uint32_t at(std::uint32_t column, std::uint32_t row) {
  return row * static_cast<std::uint32_t>(side) + column;
}

}  // namespace

TEST_CASE("a drag paints where it goes, Shift takes it off, and each stroke is one change") {
  BrushDesk desk;
  desk.settle();
  desk.take_brush("bend");
  CHECK(desk.viewer.brush().is_on());
  CHECK(desk.shown().render_mesh->looks.vertices[0] == desk.shown().render_mesh->looks.vertices[40]);
  const std::uint64_t edits = desk.shown().edits;
  desk.drag(desk.place(at(2, 6)), desk.place(at(9, 6)));
  CHECK_FALSE(desk.shown().pull.has_value());
  desk.release();
  desk.turn_until([&] { return desk.shown().edits == edits + 1; });
  CHECK(desk.shown().undone_next == "paint bend");
  CHECK(desk.is_painted("bend", at(2, 6)));
  CHECK(desk.is_painted("bend", at(9, 6)));
  CHECK_FALSE(desk.is_painted("bend", at(2, 2)));
  CHECK_FALSE(desk.is_painted("stretch", at(2, 6)));
  const auto& looks = desk.shown().render_mesh->looks.vertices;
  CHECK(looks[at(2, 2)].place.x() == 0);
  CHECK(looks[at(9, 6)].place.x() > 0.3F);
  CHECK(desk.tint_at(at(9, 6)) > 60);  // orange
  CHECK(std::abs(desk.tint_at(at(2, 2))) < 12);
  CHECK(desk.shown().pins.size() == 2);  // nothing was pinned by the press
  xdotool("keydown shift");
  desk.drag(desk.place(at(9, 6)), desk.place(at(9, 6)) + Vec2f(3, 0));
  desk.release();
  xdotool("keyup shift");
  desk.turn_until([&] { return desk.shown().edits == edits + 2; });
  CHECK_FALSE(desk.is_painted("bend", at(9, 6)));
  CHECK(desk.is_painted("bend", at(2, 6)));
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.is_painted("bend", at(9, 6)); });
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.factors("bend").empty(); });
  desk.key("ctrl+shift+z");
  desk.turn_until([&] { return desk.is_painted("bend", at(2, 6)); });
  desk.key("r");
  desk.turn_until([&] { return desk.shown().restarts == 1; });
  CHECK(desk.is_painted("bend", at(2, 6)));
}

TEST_CASE("the rows of the brush: factor, size, Fill and Clean; Esc puts it away, and a drag pulls again") {
  BrushDesk desk;
  desk.settle();
  desk.take_brush("stretch");
  desk.move(desk.button("factor"));
  xdotool("keydown ctrl click 1 keyup ctrl");
  desk.turns(4);
  xdotool("key ctrl+a type 0.1");
  desk.key("Return");
  desk.turn_until([&] { return desk.viewer.brush().factor == 0.1; });
  const float radius = desk.viewer.brush().radius;
  desk.move(desk.button("size"));
  desk.press();
  desk.move(desk.button("size") + Vec2f(60, 0));
  desk.release();
  CHECK(desk.viewer.brush().radius != radius);
  desk.click(desk.button("Fill"));
  desk.turn_until([&] { return desk.is_painted("stretch", 0); });
  CHECK(desk.factors("stretch") == std::vector<pliant::Real>(static_cast<std::size_t>(side * side), 0.1));
  CHECK(desk.tint_at(at(5, 5)) < -40);  // blue
  desk.click(desk.button("Clean"));
  desk.turn_until([&] { return desk.factors("stretch").empty(); });
  desk.key("Escape");
  CHECK_FALSE(desk.viewer.brush().is_on());
  desk.turn_until([&] { return desk.shown().render_mesh->looks.vertices.empty(); });
  desk.drag(desk.place(at(5, 6)), desk.place(at(5, 6)) + Vec2f(40, 30));
  desk.turn_until([&] { return desk.shown().pull.has_value(); });
  desk.release();
}

int main(int argc, char** argv) {
  return run_on_display(argc, argv);
}
