#pragma once
// What is drawn of a series: its lines and its marks.
#include <string>
#include <vector>

#include "report/plot_layout.h"

namespace pliant_report {

constexpr int color_count = 8;

/// What tells a series from the others, in print without colors too.
struct Look {
  int color = 0;
  int shape = 0;
  bool is_dashed = false;
  bool is_hollow = false;
};

/// By the series' own color or its position; after eight, colors come again with hollow marks and the other kind of
/// line.
Look look_of(const Plot& plot, std::size_t series);

struct Curve {
  std::vector<Run> lines{};
  std::vector<Point> marks{};
  std::vector<Run> bands{};  ///< outlines of the areas between low and high
};

/// All of it lies within the plotting area, and no more points than its units can show. Of several lines, each bears a
/// few marks, those of different lines at different places; a value between two gaps is a mark.
Curve curve_of(const Plot& plot, std::size_t series, const PlotLayout& layout);

/// The shape at every point: path data, where each shape begins with its center, "M3 4".
std::string marks_data(const std::vector<Point>& points, int shape);

}  // namespace pliant_report
