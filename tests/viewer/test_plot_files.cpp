// Which part of the time plots show, and what is saved of them.
#include <doctest/doctest.h>

#include "tests/report/markup.h"
#include "tests/support/temporary_folder.h"
#include "viewer/plot_files.h"
#include "viewer/time_view.h"

namespace test_plot_files {

using namespace pliant_viewer;
using pliant_tests::TemporaryFolder;

namespace {

constexpr TimeRange known = {2, 12};

void check_range(const TimeRange& range, double from, double to) {
  CHECK(range.from == doctest::Approx(from));
  CHECK(range.to == doctest::Approx(to));
}

pliant_plot::MeasuredRun run() {
  return {"some/sheet", pliant_sweep::parse_measurements("step,time,kinetic,elastic_<a&b>,total\n0,0,1,2,3\n"
                                                         "1,0.5,1.25,nan,nan\n2,1,1.5,2.5,4\n")};
}

}  // namespace

TEST_CASE("what is under the mouse stays there while time is zoomed") {
  TimeView view;
  check_range(view.range(known), 2, 12);
  view.zoom(0.25, 0.5, known);
  check_range(view.range(known), 3.25, 8.25);
  check_range(view.range({2, 20}), 3.25, 8.25);  // stays while time goes on
  view.zoom(0.8, 0.1, known);
  check_range(view.range(known), 6.85, 7.35);
  view.zoom(0.5, 1e-12, known);
  CHECK(view.range(known).length() > 0);
  for (int i = 0; i < 100; ++i) view.zoom(0.5, 1.5, known);
  check_range(view.range(known), 2, 12);
  CHECK_FALSE(view.length());
}

TEST_CASE("what ends with the newest goes on with it, until it is moved away") {
  TimeView view;
  view.show_last(4);
  check_range(view.range(known), 8, 12);
  check_range(view.range({2, 15}), 11, 15);
  check_range(view.range({2, 3}), 2, 3);  // as long as there is less
  view.zoom(0.99, 0.5, known);            // next to the end
  check_range(view.range({2, 15}), 13, 15);
  view.pan(-0.5, known);
  check_range(view.range(known), 9, 11);
  CHECK_FALSE(view.follows());
  check_range(view.range({2, 15}), 9, 11);
  view.pan(7, known);
  CHECK(view.follows());
  view.pan(-100, known);
  check_range(view.range(known), 2, 4);
  view.show_all();
  view.pan(-1, known);  // there is nothing else
  check_range(view.range(known), 2, 12);
}

TEST_CASE("files of plots take free names, and replace nothing") {
  const TemporaryFolder folder;
  folder.write("sheet-measurements-1.csv", "mine");
  std::filesystem::create_symlink("nowhere", folder.path() / "sheet-measurements-2.csv");
  const auto file = save_measured(run(), folder.path());
  CHECK(file == folder.path() / "sheet-measurements-3.csv");
  CHECK(TemporaryFolder::read(folder.path() / "sheet-measurements-1.csv") == "mine");
  CHECK(TemporaryFolder::read(file) ==
        "step,time,kinetic,elastic_<a&b>,total\n0,0,1,2,3\n1,0.5,1.25,nan,nan\n2,1,1.5,2.5,4\n");
  const std::vector<pliant_report::Plot> plots =
      figure_plots(run(), {"Energy", {"kinetic", "elastic_<a&b>", "total", "gravitational"}}, {});
  REQUIRE(plots.size() == 1);
  REQUIRE(plots[0].series.size() == 3);
  CHECK(plots[0].series[1].x == std::vector<double>{0, 1});  // where it was measured
  const auto first = save_plots(plots, "sheet", folder.path()), second = save_plots(plots, "sheet", folder.path());
  CHECK(first.at(0).filename() == "sheet-plot-1.svg");
  CHECK(second.at(0).filename() == "sheet-plot-2.svg");
  const std::string text = TemporaryFolder::read(first.at(0));
  const pliant_tests::Markup svg(text);  // throws where it is not well formed
  REQUIRE_FALSE(svg.elements().empty());
  CHECK(svg.elements().front().name == "svg");
  CHECK(text.find("elastic energy of &lt;a&amp;b&gt;") != text.npos);
  CHECK(saved_names({"out/a.svg", "out/b.svg", "out/c.svg"}) == "out/a.svg, b.svg and c.svg");
}

TEST_CASE("figures have the columns that a run has, and what is zero throughout is left out") {
  const auto figures = pliant_plot::usual_figures({"step", "time", "kinetic", "elastic_a", "total", "contacts"});
  REQUIRE(figures.size() == 2);
  CHECK(figures[0].title == "Energy");
  CHECK(figures[0].columns == std::vector<std::string>{"kinetic", "elastic", "total"});
  CHECK(figures[1].columns == std::vector<std::string>{"contacts"});
  const pliant_plot::MeasuredRun still = {
      "still", pliant_sweep::parse_measurements("step,time,contacts,active\n0,0,0,0\n1,1,0,0\n2,2,0,0\n")};
  const auto none = figure_plots(still, {"Contacts", {"contacts", "active"}}, {});
  REQUIRE(none.size() == 1);
  CHECK(none[0].series.size() == 2);
  CHECK(figure_plots(still, {"Contacts", {"contacts"}}, {.from = 5}).empty());
}

}  // namespace test_plot_files
