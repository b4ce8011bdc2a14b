#include "report/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace pliant_report {
namespace {

/// Relative paths about the center: disc, square, triangle, rhomb, triangle that hangs, slanted cross, upright cross,
/// hourglass. Of about the same area.
constexpr std::array<std::string_view, 8> shapes = {
    "m-3.4 0a3.4 3.4 0 1 0 6.8 0a3.4 3.4 0 1 0-6.8 0z",
    "m-3-3h6v6h-6z",
    "m0-4.3l4.2 7.1h-8.4z",
    "m0-4.6l3.8 4.6l-3.8 4.6l-3.8-4.6z",
    "m0 4.3l4.2-7.1h-8.4z",
    "m0-1.5l2.3-2.3l1.5 1.5l-2.3 2.3l2.3 2.3l-1.5 1.5l-2.3-2.3l-2.3 2.3l-1.5-1.5l2.3-2.3l-2.3-2.3l1.5-1.5z",
    "m-1.1-4.2h2.2v3.1h3.1v2.2h-3.1v3.1h-2.2v-3.1h-3.1v-2.2h3.1z",
    "m-3.6-3.8h7.2l-2.7 3.8l2.7 3.8h-7.2l2.7-3.8z",
};

std::vector<Run> runs_of(const Series& series, const PlotLayout& layout) {
  std::vector<Run> runs;
  bool continues = false;
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    const Point p = layout.place(series.x[i], series.y[i]);
    const bool is_shown = std::isfinite(p.x) && std::isfinite(p.y);
    if (is_shown && !continues) runs.emplace_back();
    if (is_shown) runs.back().push_back(p);
    continues = is_shown;
  }
  return runs;
}

/// What is left of a polygon on one side of a line across the figure: where `depth` is not negative.
template <class Depth>
Run cut(const Run& polygon, Depth&& depth) {
  Run kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    const double at_a = depth(a);
    const double at_b = depth(b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a >= 0) == (at_b >= 0)) continue;
    const double share = at_a / (at_a - at_b);
    kept.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
  }
  return kept;
}

/// The area between low and high, within the plotting area.
std::vector<Run> bands_of(const Series& series, const PlotLayout& layout) {
  if (series.low.size() != series.y.size() || series.high.size() != series.y.size()) return {};
  std::vector<Run> bands;
  Run upper, lower;
  const auto close = [&] {
    if (upper.size() > 1) {
      Run outline = thinned(upper);
      const Run back = thinned(lower);
      outline.insert(outline.end(), back.rbegin(), back.rend());
      const Box& area = layout.area;
      outline = cut(outline, [&](const Point& p) { return p.x - area.left; });
      outline = cut(outline, [&](const Point& p) { return area.right - p.x; });
      outline = cut(outline, [&](const Point& p) { return p.y - area.top; });
      outline = cut(outline, [&](const Point& p) { return area.bottom - p.y; });
      if (outline.size() > 2) bands.push_back(std::move(outline));
    }
    upper.clear();
    lower.clear();
  };
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    const Point high = layout.place(series.x[i], series.high[i]);
    const Point low = layout.place(series.x[i], series.low[i]);
    if (std::isfinite(high.x) && std::isfinite(high.y) && std::isfinite(low.y)) {
      upper.push_back(high);
      lower.push_back(low);
    } else {
      close();
    }
  }
  close();
  return bands;
}

double travel(const Run& run, std::size_t i) {
  return i == 0 ? 0 : std::abs(run[i].x - run[i - 1].x);
}

/// Points of the lines about `space` apart in x, the first of them `start` after the line's own.
std::vector<Point> some_points(const std::vector<Run>& lines, double space, double start) {
  std::vector<Point> points;
  double next = start;
  double traveled = 0;
  for (const Run& run : lines) {
    for (std::size_t i = 0; i < run.size(); ++i) {
      traveled += travel(run, i);
      if (traveled < next) continue;
      points.push_back(run[i]);
      next = traveled + space;
    }
  }
  if (points.empty() && !lines.empty()) points.push_back(lines.front()[lines.front().size() / 2]);
  return points;
}

/// Few of them, on curves that go to and fro too.
void add_identifying_marks(const Plot& plot, std::size_t series, const PlotLayout& layout, Curve& curve) {
  constexpr double marks_per_line = 4;
  double traveled = 0;
  for (const Run& run : curve.lines) {
    for (std::size_t i = 0; i < run.size(); ++i) traveled += travel(run, i);
  }
  const double space = std::max(layout.area.width(), traveled) / marks_per_line;
  const double share = (static_cast<double>(series) + 0.5) / static_cast<double>(plot.series.size());
  const std::vector<Point> marks = some_points(curve.lines, space, space * share);
  curve.marks.insert(curve.marks.end(), marks.begin(), marks.end());
}

}  // namespace

Look look_of(const Plot& plot, std::size_t series) {
  const Series& each = plot.series[series];
  const int position = static_cast<int>(series % (2 * color_count));
  if (each.color) {
    const int color = (*each.color % color_count + color_count) % color_count;
    return {color, color, each.is_dashed, each.is_dashed};
  }
  const bool is_again = position >= color_count;
  return {position % color_count, position % color_count, each.is_dashed != is_again, each.is_dashed != is_again};
}

Curve curve_of(const Plot& plot, std::size_t series, const PlotLayout& layout) {
  const Series& each = plot.series[series];
  Curve curve;
  curve.bands = bands_of(each, layout);
  std::vector<Point> points;
  for (const Run& run : runs_of(each, layout)) {
    for (const Point& p : run) {
      if ((each.mark != Mark::line || run.size() == 1) && layout.area.has(p)) points.push_back(p);
    }
    if (each.mark == Mark::points || run.size() == 1) continue;
    for (Run& part : clipped(thinned(run), layout.area)) curve.lines.push_back(std::move(part));
  }
  curve.marks = without_covered(points);
  if (each.mark == Mark::line && plot.series.size() > 1) add_identifying_marks(plot, series, layout, curve);
  return curve;
}

std::string marks_data(const std::vector<Point>& points, int shape) {
  std::string data;
  for (const Point& p : points) {
    data +=
        fmt::format("M{} {}{}", decimal(p.x), decimal(p.y), shapes[static_cast<std::size_t>(shape) % shapes.size()]);
  }
  return data;
}

}  // namespace pliant_report
