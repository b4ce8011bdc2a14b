#pragma once
// Where the parts of a plot go: the room for its texts comes first, and the rest is the plotting area.
#include <string>
#include <vector>

#include "report/geometry.h"
#include "report/plot.h"
#include "report/scale.h"

namespace pliant_report {

constexpr double plot_width = 640;
constexpr double line_height = 17;  ///< of the text, which has 13 units

struct PlacedTick {
  double at = 0;  ///< x or y, on the axis
  std::string label{};
  Box box{};  ///< of the label, by the estimate of text_width()
};

struct LegendEntry {
  std::size_t series = 0;
  std::string name{};
  Box box{};  ///< of sample and name
};

struct PlotLayout {
  Scale x;
  Scale y;
  Box area{};
  double height = 0;  ///< of the whole
  std::vector<std::string> title{};
  std::vector<std::string> x_label{};  ///< below the area
  std::vector<std::string> y_label{};  ///< at the left, to be read from the right
  std::vector<PlacedTick> x_ticks{};
  std::vector<PlacedTick> y_ticks{};
  std::vector<LegendEntry> legend{};

  /// NaN where an axis cannot show the value.
  Point place(double x_value, double y_value) const;
};

constexpr double legend_sample_width = 26;

PlotLayout plot_layout(const Plot& plot);

}  // namespace pliant_report
