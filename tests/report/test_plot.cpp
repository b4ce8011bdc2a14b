#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <sstream>

#include <doctest/doctest.h>

#include "report/curves.h"
#include "report/guides.h"
#include "report/plot_layout.h"
#include "report/text.h"
#include "tests/core/random.h"
#include "tests/report/markup.h"

namespace test_plot {

using namespace pliant_report;
using namespace pliant_tests;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Plot plot_of(std::vector<Series> series, bool is_logarithmic = false) {
  return {"title", "", {"x [m]", is_logarithmic}, {"y [m]", is_logarithmic}, std::move(series)};
}

Series noise(std::uint64_t seed, std::size_t count, double size = 1) {
  Random random(seed);
  Series series{"noise " + std::to_string(seed)};
  for (std::size_t i = 0; i < count; ++i) {
    series.x.push_back(static_cast<double>(i));
    series.y.push_back(random.uniform(-size, size));
  }
  return series;
}

/// The points that path data moves and draws to in absolute coordinates: "M1 2L3 4", or centers of marks.
std::vector<Point> points_of(const std::string& data) {
  std::vector<Point> points;
  for (std::size_t at = data.find_first_of("ML"); at != std::string::npos; at = data.find_first_of("ML", at + 1)) {
    std::istringstream text(data.substr(at + 1));
    Point p;
    REQUIRE(static_cast<bool>(text >> p.x >> p.y));
    points.push_back(p);
  }
  return points;
}

/// Without a legend, whose samples look like curves.
Plot unnamed(Plot plot) {
  for (Series& series : plot.series) series.name.clear();
  return plot;
}

std::vector<Point> drawn_points(const Plot& plot) {
  std::vector<Point> points;
  const Markup svg(to_svg(unnamed(plot), false));
  for (const char* style : {"plot-line", "plot-marks"}) {
    for (const MarkupElement& path : svg.of_class(style)) {
      for (const Point& p : points_of(path.attribute("d"))) points.push_back(p);
    }
  }
  return points;
}

std::size_t command_count(const Plot& plot, char command) {
  std::size_t count = 0;
  for (const MarkupElement& path : Markup(to_svg(plot, false)).of_class("plot-line")) {
    const std::string data = path.attribute("d");
    count += static_cast<std::size_t>(std::count(data.begin(), data.end(), command));
  }
  return count;
}

Plot with_limits(Plot plot, double min, double max) {
  plot.x.min = plot.y.min = min;
  plot.x.max = plot.y.max = max;
  return plot;
}

/// What is hard to plot, on linear and on logarithmic axes.
std::vector<Plot> hard_plots() {
  const std::vector<std::vector<double>> values = {{},
                                                   {3},
                                                   {0},
                                                   {-7, -7, -7},
                                                   {0, 0, 0},
                                                   {not_a_number, not_a_number},
                                                   {infinity, 1, -infinity, 2},
                                                   {1e300, -1e300, 1.7e308},
                                                   {-DBL_MAX, DBL_MAX},
                                                   {DBL_MAX, DBL_MAX},
                                                   {5e-324, 1e-320},
                                                   {DBL_MIN, 2 * DBL_MIN},
                                                   {DBL_MIN, DBL_MAX},
                                                   {1, 1 + DBL_EPSILON},
                                                   {-3, -2, -1},
                                                   {-1, 0, 1e-9, 1e9},
                                                   {123456.7891, 123456.7892, 123456.7895}};
  std::vector<Plot> plots = {{}, plot_of({}), plot_of({}, true)};
  for (const std::vector<double>& some : values) {
    for (const bool is_logarithmic : {false, true}) {
      for (const Mark mark : {Mark::line, Mark::points, Mark::line_and_points}) {
        Plot plot = plot_of({{"a", some, some, mark}, {"b", some, {}, mark}}, is_logarithmic);
        plots.push_back(plot);
        plots.push_back(with_limits(plot, -1, 2));
        plots.push_back(with_limits(plot, 5, 5));
        plots.push_back(with_limits(plot, 1e300, -1e300));
        plots.push_back(with_limits(plot, not_a_number, infinity));
        plot.guides = {{1e5, "far"}, {-1, "negative"}, {not_a_number, "none"}, {2, "upright", true}};
        plots.push_back(std::move(plot));
      }
    }
  }
  return plots;
}

double brightness(const std::string& hex, std::size_t channel) {
  const double value = std::stoi(hex.substr(1 + 2 * channel, 2), nullptr, 16) / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// WCAG 2.1, "contrast ratio".
double contrast(const std::string& a, const std::string& b) {
  const auto luminance = [](const std::string& hex) {
    return 0.2126 * brightness(hex, 0) + 0.7152 * brightness(hex, 1) + 0.0722 * brightness(hex, 2);
  };
  const double high = std::max(luminance(a), luminance(b));
  const double low = std::min(luminance(a), luminance(b));
  return (high + 0.05) / (low + 0.05);
}

std::string color_after(const std::string& style, const std::string& rule) {
  const std::size_t at = style.find(rule);
  REQUIRE_MESSAGE(at != std::string::npos, rule);
  return style.substr(style.find('#', at), 7);
}

}  // namespace

TEST_CASE("a plot of whatever values is well formed, and all that is drawn lies in the plotting area") {
  for (const Plot& plot : hard_plots()) {
    const std::string svg = to_svg(plot, true);
    REQUIRE_NOTHROW(Markup{svg});
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(svg.find("\"inf") == std::string::npos);
    const PlotLayout layout = plot_layout(unnamed(plot));
    CHECK(layout.area.width() > 300);
    CHECK(layout.height < 600);
    constexpr double digit = 0.06;  // coordinates have one decimal
    const Box room{layout.area.left - digit, layout.area.top - digit, layout.area.right + digit,
                   layout.area.bottom + digit};
    for (const Point& p : drawn_points(plot)) CHECK(room.has(p));
  }
}

TEST_CASE("values stand where their ticks say") {
  const Plot plot = plot_of({{"", {0, 1, 2}, {10, 20, 30}}});
  const PlotLayout layout = plot_layout(plot);
  const auto tick_at = [](const std::vector<PlacedTick>& ticks, const std::string& label) {
    for (const PlacedTick& tick : ticks) {
      if (tick.label == label) return tick.at;
    }
    FAIL(label);
    return 0.0;
  };
  const std::vector<Point> points = drawn_points(plot);
  REQUIRE(points.size() == 3);
  CHECK(points[1].x == doctest::Approx(tick_at(layout.x_ticks, "1.0")).epsilon(0.001));
  CHECK(points[1].y == doctest::Approx(tick_at(layout.y_ticks, "20")).epsilon(0.001));
  CHECK(points[0].y == doctest::Approx(tick_at(layout.y_ticks, "10")).epsilon(0.001));
  const Plot powers = plot_of({{"", {1, 1000}, {1e-5, 1e-3}}}, true);
  CHECK(drawn_points(powers)[0].x == doctest::Approx(tick_at(plot_layout(powers).x_ticks, "1")).epsilon(0.001));
  CHECK(drawn_points(powers)[0].y == doctest::Approx(tick_at(plot_layout(powers).y_ticks, "10⁻⁵")).epsilon(0.001));
}

TEST_CASE("what is not finite, not on the axis or without a partner leaves a gap") {
  Series series{"", {0, 1, 2, 3, 4, 5, 6, 7}, {1, 2, not_a_number, 2, 3, infinity, 4, 5}};
  CHECK(command_count(plot_of({series}), 'M') == 3);
  CHECK(command_count(plot_of({series}), 'L') == 3);
  series.y = {1, 2, 0, 2, 3, -4, 4, 5};
  series.x = {1, 2, 3, 4, 5, 6, 7};
  CHECK(command_count(plot_of({series}, true), 'M') == 2);  // the last value is alone: a mark
  CHECK(drawn_points(plot_of({series}, true)).size() == 5);
  CHECK(drawn_points(plot_of({{"", {1, 2, 3}, {not_a_number, 5, not_a_number}}})).size() == 1);
}

TEST_CASE("a line that leaves the given limits ends at them, and comes back") {
  Plot plot = plot_of({{"", {0, 1, 2, 3, 4}, {0, 10, 0, -10, 0}}});
  plot.y.min = -5;
  plot.y.max = 5;
  const PlotLayout layout = plot_layout(plot);
  CHECK(command_count(plot, 'M') == 3);
  std::size_t at_edges = 0;
  for (const Point& p : drawn_points(plot)) {
    CHECK(p.y >= layout.area.top - 0.06);
    if (std::abs(p.y - layout.area.bottom) < 0.06) ++at_edges;
  }
  CHECK(at_edges == 2);
  CHECK(drawn_points(with_limits(plot, 20, 30)).empty());
  Plot steep = plot_of({{"", {0, 1}, {-1e300, 1e300}}});
  steep.y.min = -1;
  steep.y.max = 1;
  const std::vector<Point> points = drawn_points(steep);
  REQUIRE(points.size() == 2);
  CHECK(points[0].y - points[1].y == doctest::Approx(layout.area.height()).epsilon(0.001));
  CHECK(std::abs(points[0].x - points[1].x) < 0.2);
}

TEST_CASE("a long series is thinned out, and its peaks stay") {
  Series series = noise(1, 50000);
  series.y[20001] = 7;
  series.y[33333] = -9;
  const Plot plot = plot_of({series});
  const std::vector<Point> points = drawn_points(plot);
  CHECK(points.size() < 6 * plot_width);
  CHECK(points.size() > plot_width);
  const auto [high, low] =
      std::minmax_element(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
  const PlotLayout layout = plot_layout(unnamed(plot));
  CHECK(std::abs(high->y - layout.place(20001, 7).y) < 0.06);
  CHECK(std::abs(low->y - layout.place(33333, -9).y) < 0.06);
  CHECK(std::abs(low->x - layout.place(33333, -9).x) < 0.06);
  Series marks = noise(2, 20000);
  marks.mark = Mark::points;
  marks.y.assign(20000, 3);
  CHECK(drawn_points(plot_of({marks})).size() <= plot_width);
}

TEST_CASE("the legend stands above the plotting area in rows, without overlaps, however many series there are") {
  for (const std::size_t count : {1U, 3U, 9U, 30U}) {
    Plot plot = plot_of({});
    for (std::size_t i = 0; i < count; ++i) {
      plot.series.push_back(noise(i + 1, 10));
      if (i % 4 == 0) plot.series.back().name = "a name that is rather long, of series " + std::to_string(i);
    }
    plot.series[0].name = std::string(300, 'w');
    const PlotLayout layout = plot_layout(plot);
    REQUIRE(layout.legend.size() == count);
    for (std::size_t i = 0; i < count; ++i) {
      const Box& box = layout.legend[i].box;
      CHECK(box.left >= 0);
      CHECK(box.right <= plot_width);
      CHECK(box.bottom <= layout.area.top);
      for (std::size_t j = 0; j < i; ++j) CHECK(!box.meets(layout.legend[j].box));
    }
    CHECK(layout.area.height() == doctest::Approx(280));
    CHECK(layout.height > layout.area.bottom + 30);
  }
}

TEST_CASE("labels of ticks do not touch each other, and stay within the figure") {
  Random random(5);
  for (int i = 0; i < 600; ++i) {
    const bool is_logarithmic = i % 2 == 0;
    const double size = std::pow(10.0, random.uniform(-30, 30));
    const double width = std::pow(10.0, random.uniform(-9, is_logarithmic ? 12 : 1));
    const double start = is_logarithmic ? size : random.uniform(-size, size);
    const Plot plot = plot_of({{"", {start, start + size * width}, {start, start + size * width}}}, is_logarithmic);
    const PlotLayout layout = plot_layout(plot);
    CAPTURE(start);
    CAPTURE(width);
    std::vector<Box> boxes;
    for (const auto* ticks : {&layout.x_ticks, &layout.y_ticks}) {
      std::size_t told = 0;
      for (const PlacedTick& tick : *ticks) {
        if (tick.label.empty()) continue;
        ++told;
        CHECK(tick.box.left >= 0);
        CHECK(tick.box.right <= plot_width);
        CHECK(tick.box.width() == doctest::Approx(text_width(tick.label)));
        for (const Box& other : boxes) CHECK(!tick.box.meets(other));
        boxes.push_back(tick.box);
      }
      CHECK(told >= 2);
    }
  }
}

TEST_CASE("guides cross the plotting area; their labels lie in it, beside each other") {
  Plot plot = plot_of({noise(1, 200), noise(2, 200)});
  plot.guides = {{0.5, "half"}, {0.52, "a little more than half"}, {100, "middle", true}, {101, "next", true}};
  const PlotLayout layout = plot_layout(plot);
  const std::vector<Curve> curves = {curve_of(plot, 0, layout), curve_of(plot, 1, layout)};
  const std::vector<PlacedGuide> guides = place_guides(plot, layout, curves);
  REQUIRE(guides.size() == 4);
  for (std::size_t i = 0; i < guides.size(); ++i) {
    const Box& box = guides[i].box;
    CHECK(box.width() > 10);
    CHECK(box.left >= layout.area.left);
    CHECK(box.right <= layout.area.right);
    CHECK(box.top >= layout.area.top);
    CHECK(box.bottom <= layout.area.bottom);
    for (std::size_t j = 0; j < i; ++j) CHECK(!box.meets(guides[j].box));
  }
  CHECK(guides[0].start.y == guides[0].end.y);
  CHECK(guides[2].start.x == guides[2].end.x);
  plot.y.max = 0.2;
  CHECK(place_guides(plot, plot_layout(plot), curves).size() == 2);
}

TEST_CASE("series differ in color and in shape, beyond eight in their lines too") {
  Plot plot = plot_of({});
  for (std::uint64_t i = 0; i < 16; ++i) plot.series.push_back(noise(i + 1, 50));
  for (std::size_t i = 0; i < 16; ++i) {
    const Look look = look_of(plot, i);
    for (std::size_t j = 0; j < i; ++j) {
      const Look other = look_of(plot, j);
      const bool is_other_kind = look.color != other.color && look.shape != other.shape;
      CHECK((is_other_kind || look.is_dashed != other.is_dashed));
    }
    CHECK(!curve_of(plot, i, plot_layout(plot)).marks.empty());
  }
  plot.series[3].color = 6;
  CHECK(look_of(plot, 3).color == 6);
  plot.series[3].color = -1;
  CHECK(look_of(plot, 3).color == 7);
  CHECK(marks_data({{1, 2}}, 0) != marks_data({{1, 2}}, 1));
}

TEST_CASE("colors stand out from the ground in both schemes, and paper has the light ones") {
  const std::string style = plot_style();
  const std::size_t dark = style.find("@media screen and (prefers-color-scheme: dark)");
  REQUIRE(dark != std::string::npos);
  REQUIRE(style.find("@media print") != std::string::npos);
  for (const std::string& scheme : {style.substr(0, dark), style.substr(dark)}) {
    const std::string ground = color_after(scheme, ".plot-ground");
    CHECK(contrast(color_after(scheme, ".plot text {"), ground) > 7);
    CHECK(contrast(color_after(scheme, ".plot .plot-number"), ground) > 4.5);
    CHECK(contrast(color_after(scheme, ".plot-axis, .plot-guide { stroke"), ground) > 3);
    for (int i = 0; i < color_count; ++i) {
      CHECK(contrast(color_after(scheme, ".plot-color-" + std::to_string(i)), ground) >= 3);
    }
  }
}

TEST_CASE("a plot has a name for those who do not see it, and every text is escaped") {
  const std::string nasty = "<script>&\"'\x01\xff]]>";
  const std::string clean = "<script>&\"' ?]]>";
  Plot plot{nasty, "", {nasty}, {nasty}, {{nasty, {1, 2}, {1, 2}}}, {{1.5, nasty}}};
  for (const bool is_alone : {false, true}) {
    const std::string text = to_svg(plot, is_alone);
    CHECK(text.find("<script") == std::string::npos);
    const Markup svg(text);
    const MarkupElement& root = svg.elements().front();
    CHECK(root.attribute("role") == "img");
    CHECK(root.attribute("aria-label") == clean + ": " + clean + " over " + clean + "; of " + clean);
    CHECK(svg.named("title").front().text == clean);
    CHECK(svg.of_class("plot-title").front().text == clean);
    CHECK(svg.of_class("plot-name").front().text == clean);
    CHECK(svg.of_class("plot-guide-label").front().text == clean);
    CHECK(svg.named("style").size() == (is_alone ? 1 : 0));
    CHECK(svg.of_class("plot-ground").size() == (is_alone ? 1 : 0));
    CHECK((text.find("xmlns=\"http://www.w3.org/2000/svg\"") != std::string::npos) == is_alone);
  }
}

}  // namespace test_plot
