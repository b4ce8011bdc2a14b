// Plots over time in the real window, by mouse and keys.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "desk.h"
#include "sweep/measurement_table.h"
#include "viewer/plot_files.h"

using namespace pliant_tests;

namespace {

struct PlotsDesk : Desk {
  const PlotsPanel& panel() { return viewer.plots_panel(); }
  const pliant_plot::MeasuredRun& run() { return *source.measured(); }
  double last_step() { return run().table.find("step")->back(); }
  TimeRange range() { return panel().shown(run()); }

  Rect rect(const std::string& what) {
    turn_until([&] { return panel().place_of(what).has_value(); });
    return *panel().place_of(what);
  }
  /// A point of a plot or a button, by shares of its width and height.
  Vec2f point(const std::string& what, float across = 0.5F, float down = 0.5F) {
    const Rect place = rect(what);
    return {place[0] + across * (place[2] - place[0]), place[1] + down * (place[3] - place[1])};
  }
  void pause_at(double step) {
    turn_until([&] { return last_step() >= step; });
    key("space");
    turn_until([&] { return !shown().is_playing; });
    turns(3);
  }
};

}  // namespace

TEST_CASE("plots are opened by a key, zoomed, moved and saved") {
  PlotsDesk desk;
  desk.key("g");
  desk.turn_until([&] { return desk.panel().is_open; });
  desk.pause_at(60);
  const TimeRange all = desk.range();
  CHECK(all.from == 0);
  CHECK(all.length() > 0.9);

  // Four notches over the middle of a plot: what is there stays there.
  desk.move(desk.point("Total speed"));
  const Vec3f eye = desk.viewer.screen().viewpoint.eye;
  for (int i = 0; i < 4; ++i) {
    xdotool("click 4");
    desk.turns(3);
  }
  desk.turn_until([&] { return desk.range().length() < 0.42 * all.length(); });
  CHECK(desk.range().length() == doctest::Approx(0.4096 * all.length()));
  CHECK(desk.range().at(0.5) == doctest::Approx(all.at(0.5)).epsilon(0.01));
  CHECK(desk.viewer.screen().viewpoint.eye == eye);  // the camera has no part in it
  // A quarter of the width to the right: earlier.
  const TimeRange before = desk.range();
  desk.drag(desk.point("Energy", 0.4F), desk.point("Energy", 0.65F));
  desk.release();
  desk.turn_until([&] { return desk.range().from < before.from - 0.2 * before.length(); });
  CHECK(desk.range().from == doctest::Approx(before.from - 0.25 * before.length()).epsilon(0.02));
  CHECK(desk.viewer.screen().viewpoint.eye == eye);

  // All that was measured, whatever is shown.
  desk.click(desk.point("Save CSV"));
  const auto csv = desk.folder.path() / "sheet-measurements-1.csv";
  desk.turn_until([&] { return std::filesystem::exists(csv); });
  CHECK(desk.viewer.message() == "saved " + csv.lexically_normal().string());
  const pliant_sweep::MeasurementTable read = pliant_sweep::read_measurements(csv);
  CHECK(read.is_whole);
  CHECK(read.names == desk.run().table.names);
  CHECK(*read.find("step") == *desk.run().table.find("step"));
  CHECK(*read.find("speed_sum") == *desk.run().table.find("speed_sum"));
  CHECK(std::isfinite(read.find("total")->back()));  // energies are shown
  desk.click(desk.point("Save SVG"));
  desk.turn_until([&] { return std::filesystem::exists(desk.folder.path() / "sheet-plot-2.svg"); });
  CHECK(TemporaryFolder::read(desk.folder.path() / "sheet-plot-2.svg").find("Total speed") != std::string::npos);

  desk.click(desk.point("times"));
  desk.click(desk.point("all of the time"));
  desk.turn_until([&] { return desk.range().length() == all.length(); });
  desk.key("g");
  desk.turn_until([&] { return !desk.panel().is_open; });
}

TEST_CASE("plots are chosen from a list, and a restart begins them anew") {
  PlotsDesk desk;
  desk.key("g");
  desk.turn_until([&] { return desk.last_step() > 10; });
  desk.click(desk.point("Curves"));
  desk.click(desk.point("choose Time of a step", 0.9F));
  desk.turn_until([&] { return desk.panel().place_of("Time of a step").has_value(); });
  desk.click(desk.point("choose Total speed", 0.9F));
  desk.turn_until([&] { return !desk.panel().place_of("Total speed").has_value(); });
  desk.key("Escape");  // closes the list
  CHECK(desk.panel().is_open);
  desk.key("space");
  desk.turn_until([&] { return !desk.shown().is_playing; });
  desk.key("r");
  desk.turn_until([&] { return desk.last_step() == 0; });
  desk.key("s");
  desk.turn_until([&] { return desk.last_step() == 1; });
  CHECK(desk.run().table.row_count() == 2);
  // Undo makes the scene anew; curves go on.
  const auto pin = static_cast<std::uint32_t>(side * 9 + 6);
  desk.click(desk.place(pin));
  desk.turn_until([&] { return desk.is_pinned(pin); });
  desk.key("ctrl+z");
  desk.turn_until([&] { return !desk.is_pinned(pin); });
  desk.key("s");
  desk.turn_until([&] { return desk.last_step() == 2; });
  CHECK(desk.run().table.row_count() == 3);
}

int main(int argc, char** argv) {
  return run_on_display(argc, argv);
}
