#pragma once
// One plot over time, drawn by ImGui: the lines, colors, units and ticks of apps/report, with values to read.
#include <array>
#include <optional>
#include <string>

#include "report/plot.h"
#include "report/scale.h"
#include "viewer/panels/panel_style.h"
#include "viewer/time_view.h"

namespace pliant_viewer {

/// Left, top, right, bottom in the window.
using Rect = std::array<float, 4>;

/// What of a plot is known before it is drawn.
struct PreparedPlot {
  pliant_report::Plot plot;  ///< with all its points, but those at some distance from the range
  pliant_report::Scale values;
  pliant_report::Ticks ticks{};
  std::string heading{};
  float label_width = 0;  ///< of the widest number along its axis

  /// For an area of about this height.
  PreparedPlot(pliant_report::Plot given, float height, const PanelStyle& style);
};

struct PlotMarks {
  std::optional<double> read_at{};  ///< the time at which values are read; none: the last that is shown [s]
  std::optional<double> now{};      ///< a line at this time [s]
};

/// With which a plot of this width can be read.
float least_height(const PreparedPlot& prepared, float width, const PanelStyle& style);

/// Draws it into a rectangle of ImGui's current window, its axis `left` from there, so that axes of several plots can
/// stand in line; returns the area of the curves.
Rect draw_plot(const PreparedPlot& prepared, const Rect& place, float left, const TimeRange& range,
               const PlotMarks& marks, const PanelStyle& style);

}  // namespace pliant_viewer
