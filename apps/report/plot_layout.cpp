#include "report/plot_layout.h"

#include <algorithm>
#include <cmath>

#include "report/text.h"

namespace pliant_report {
namespace {

constexpr double edge = 6;  ///< free at the figure's sides
constexpr double area_height = 280;
constexpr double tick_gap = 8;       ///< between the axis and its numbers
constexpr double label_space = 12;   ///< between the numbers along the x axis
constexpr double legend_gap = 6;     ///< between sample and name
constexpr double legend_space = 20;  ///< between entries
constexpr double legend_row = 20;

Extent extent_of(const Plot& plot, bool is_x) {
  Extent extent;
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      if (!Scale::can_show(plot.x, series.x[i])) continue;
      for (const std::vector<double>* values : {&series.y, &series.low, &series.high}) {
        if (values->size() != series.y.size() || !Scale::can_show(plot.y, (*values)[i])) continue;
        extent.add(is_x ? series.x[i] : (*values)[i]);
      }
    }
  }
  for (const Guide& guide : plot.guides) {
    if (guide.is_vertical == is_x && Scale::can_show(is_x ? plot.x : plot.y, guide.value)) extent.add(guide.value);
  }
  return extent;
}

/// Lines go from edge to edge; marks would stand over it.
double x_margin(const Plot& plot) {
  const bool has_lines_alone = std::all_of(plot.series.begin(), plot.series.end(),
                                           [](const Series& series) { return series.mark == Mark::line; });
  return has_lines_alone ? 0 : 0.03;
}

/// Entries beside each other as long as there is room; when there is not, in columns.
std::vector<LegendEntry> legend_of(const Plot& plot, double top) {
  std::vector<LegendEntry> legend;
  const double room = plot_width - 2 * edge;
  double widest = 0;
  double total = -legend_space;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    if (plot.series[i].name.empty()) continue;
    const std::string name = shortened(plot.series[i].name, room - legend_sample_width - legend_gap);
    const double width = legend_sample_width + legend_gap + text_width(name);
    legend.push_back({i, name, {0, 0, width, 0}});
    widest = std::max(widest, width);
    total += width + legend_space;
  }
  const bool is_one_row = total <= room;
  const auto columns =
      static_cast<std::size_t>(std::max(1.0, std::floor((room + legend_space) / (widest + legend_space))));
  double left = edge;
  for (std::size_t i = 0; i < legend.size(); ++i) {
    Box& box = legend[i].box;
    if (!is_one_row) left = edge + static_cast<double>(i % columns) * (widest + legend_space);
    const double row_top = is_one_row ? top : top + static_cast<double>(i / columns) * legend_row;
    box = {left, row_top, left + box.width(), row_top + legend_row};
    left = box.right + legend_space;
  }
  return legend;
}

Box y_label_box(double y, const std::string& label, double right) {
  return {right - text_width(label), y - line_height / 2, right, y + line_height / 2};
}

Box x_label_box(double x, const std::string& label, double top) {
  const double half = text_width(label) / 2;
  return {x - half, top, x + half, top + line_height};
}

/// The places of ticks from `start` to `end`; box_of gives that of a label.
template <class BoxOf>
std::vector<PlacedTick> placed(const Scale& scale, const Ticks& ticks, double start, double end, BoxOf&& box_of) {
  std::vector<PlacedTick> result;
  for (const Tick& tick : ticks.ticks) {
    const double at = start + std::clamp(scale.fraction(tick), 0.0, 1.0) * (end - start);
    result.push_back({at, tick.label, tick.label.empty() ? Box{at, 0, at, 0} : box_of(at, tick.label)});
  }
  return result;
}

/// Takes the labels from those ticks whose label would touch the one before; whether there were any.
bool drop_overlaps(std::vector<PlacedTick>& ticks, double space) {
  bool has_dropped = false;
  const PlacedTick* before = nullptr;
  for (PlacedTick& tick : ticks) {
    if (tick.label.empty()) continue;
    Box box = tick.box;
    if (before != nullptr) {
      box.left -= space;
      if (box.meets(before->box)) {
        tick.label.clear();
        has_dropped = true;
        continue;
      }
    }
    before = &tick;
  }
  return has_dropped;
}

double widest_label(const std::vector<PlacedTick>& ticks) {
  double width = 0;
  for (const PlacedTick& tick : ticks) width = std::max(width, tick.label.empty() ? 0 : tick.box.width());
  return width;
}

constexpr int fewest_ticks = 3;

void lay_out_y(PlotLayout& layout, const Axis& axis) {
  constexpr int most_ticks = 7;
  for (int count = most_ticks; count >= fewest_ticks; --count) {
    const Ticks ticks = layout.y.ticks(count);
    layout.y_ticks = placed(layout.y, ticks, layout.area.bottom, layout.area.top,
                            [](double y, const std::string& label) { return y_label_box(y, label, 0); });
    layout.y_label = wrapped(with_power(axis.label, ticks.power), area_height);
    if (!drop_overlaps(layout.y_ticks, 0)) break;
  }
  const bool has_label = !layout.y_label.front().empty();
  const double label_height = has_label ? line_height * static_cast<double>(layout.y_label.size()) + 4 : 0;
  const double right = edge + label_height + widest_label(layout.y_ticks);
  for (PlacedTick& tick : layout.y_ticks) {
    tick.box.left += right;
    tick.box.right += right;
  }
  layout.area.left = right + tick_gap;
}

void lay_out_x(PlotLayout& layout, const Axis& axis) {
  constexpr int most_ticks = 9;
  const double top = layout.area.bottom + tick_gap - 1;
  for (int count = most_ticks; count >= fewest_ticks; --count) {
    const Ticks ticks = layout.x.ticks(count);
    layout.x_label = wrapped(with_power(axis.label, ticks.power), plot_width - 2 * edge - layout.area.left);
    // The last number may stand half over the area's end.
    double over = 0;
    for (int i = 0; i < 2; ++i) {
      layout.area.right = plot_width - edge - std::max(over, edge);
      layout.x_ticks = placed(layout.x, ticks, layout.area.left, layout.area.right,
                              [top](double x, const std::string& label) { return x_label_box(x, label, top); });
      for (const PlacedTick& tick : layout.x_ticks) over = std::max(over, tick.box.right - layout.area.right);
    }
    if (!drop_overlaps(layout.x_ticks, label_space)) break;
  }
  const double lines = layout.x_label.front().empty() ? 0 : static_cast<double>(layout.x_label.size());
  layout.height = top + line_height + lines * line_height + edge;
}

}  // namespace

Point PlotLayout::place(double x_value, double y_value) const {
  return {area.left + x.fraction(x_value) * area.width(), area.bottom - y.fraction(y_value) * area.height()};
}

PlotLayout plot_layout(const Plot& plot) {
  constexpr double y_margin = 0.05;
  PlotLayout layout{Scale(plot.x, extent_of(plot, true), x_margin(plot)),
                    Scale(plot.y, extent_of(plot, false), y_margin)};
  layout.title = wrapped(plot.title, plot_width - 2 * edge, true);
  double top = edge;
  if (!layout.title.front().empty()) top += line_height * static_cast<double>(layout.title.size()) + 5;
  layout.legend = legend_of(plot, top);
  if (!layout.legend.empty()) top = layout.legend.back().box.bottom;
  layout.area.top = top + line_height / 2 + 1;
  layout.area.bottom = layout.area.top + area_height;
  lay_out_y(layout, plot.y);
  lay_out_x(layout, plot.x);
  return layout;
}

}  // namespace pliant_report
