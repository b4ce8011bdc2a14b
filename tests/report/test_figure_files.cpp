// Figures as files, bands about lines, and what the page says of its sources and of wide tables.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "report/curves.h"
#include "report/report.h"

namespace test_figure_files {

using namespace pliant_report;

namespace {

Plot banded_plot() {
  Plot plot{.title = "speed", .x = {.label = "h [s]"}, .y = {.label = "speed, [m/s]"}, .series = {}};
  plot.series.push_back(
      {.name = "a \"fast\" one", .x = {1, 2, 3}, .y = {4, 5, std::nan("")}, .low = {3, 4, 1}, .high = {6, 9, 2}});
  return plot;
}

const FigureFile& file_of(const std::vector<FigureFile>& files, std::string_view name) {
  const auto found = std::ranges::find(files, name, &FigureFile::name);
  REQUIRE(found != files.end());
  return *found;
}

}  // namespace

TEST_CASE("plots are files as SVG and CSV, pictures as PNG, tables as CSV, numbered as in the page") {
  Report report{.title = "r"};
  Chapter chapter{"sheet metal", "Sheet metal"};
  chapter.blocks = {Paragraph{"text"}, Picture{"sheet", "\x89PNG", 8, 4},
                    Table{"t", {"k [N/m]", "a, b"}, {{"1e4", "2"}}}, banded_plot()};
  report.chapters = {chapter};
  const std::vector<FigureFile> files = figure_files(report);
  CHECK(files.size() == 4);
  CHECK(file_of(files, "sheet-metal-1.png").content == "\x89PNG");
  CHECK(file_of(files, "sheet-metal-table-1.csv").content == "k [N/m],\"a, b\"\n1e4,2\n");
  CHECK(file_of(files, "sheet-metal-2.svg").content.starts_with("<svg xmlns="));
  CHECK(file_of(files, "sheet-metal-2.csv").content ==
        "series,h [s],\"speed, [m/s]\",low,high\n\"a \"\"fast\"\" one\",1,4,3,6\n\"a \"\"fast\"\" one\",2,5,4,9\n"
        "\"a \"\"fast\"\" one\",3,,1,2\n");
}

TEST_CASE("a band goes from low to high, has room on the axis and ends at the plotting area") {
  Plot plot = banded_plot();
  PlotLayout layout = plot_layout(plot);
  Curve curve = curve_of(plot, 0, layout);
  REQUIRE(curve.bands.size() == 1);
  double top = 1e9;
  double bottom = -1e9;
  for (const Point& p : curve.bands[0]) {
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
    CHECK(layout.area.has(p));
  }
  CHECK(top == doctest::Approx(layout.place(2, 9).y));
  CHECK(bottom == doctest::Approx(layout.place(3, 1).y));
  CHECK(to_svg(plot, true).find("plot-band") != std::string::npos);

  plot.y.max = 7;
  layout = plot_layout(plot);
  curve = curve_of(plot, 0, layout);
  REQUIRE(curve.bands.size() == 1);
  for (const Point& p : curve.bands[0]) {
    CHECK(p.y >= layout.area.top - 1e-9);
  }

  plot.series[0].low.clear();
  CHECK(curve_of(plot, 0, layout).bands.empty());
  CHECK(to_svg(plot, true).find("class=\"plot-band") == std::string::npos);
}

TEST_CASE("the page names its sources, and tells of tables that are wider than it") {
  Report report{.title = "r"};
  report.sources = {{"thesis", "A thesis & its title"}};
  Table narrow{"narrow", {"a", "b"}, {{"1", "2"}}};
  Table wide{"wide", {}, {{}}};
  for (int i = 0; i < 14; ++i) {
    wide.columns.emplace_back("milliseconds");
    wide.rows[0].emplace_back("1234567");
  }
  report.chapters = {Chapter{"a", "A"}};
  report.chapters[0].blocks = {narrow};
  CHECK(to_html(report).find("it scrolls sideways") == std::string::npos);
  report.chapters[0].blocks = {wide};
  const std::string page = to_html(report);
  CHECK(page.find("it scrolls sideways") != std::string::npos);
  CHECK(page.find("<dt>thesis</dt><dd>A thesis &amp; its title</dd>") != std::string::npos);
  CHECK(to_json(report).find("A thesis & its title") != std::string::npos);
}

}  // namespace test_figure_files
