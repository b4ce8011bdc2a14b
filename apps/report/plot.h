#pragma once
// Plots of measured series, as SVG: what a figure says, not where its ink goes.
#include <optional>
#include <string>
#include <vector>

namespace pliant_report {

/// How the values of a series are shown. Where there are several, a line has a few marks that tell it from the others.
enum class Mark { line, points, line_and_points };

/// Values over values. Those that are not finite, those that a logarithmic axis cannot show and those without a partner
/// leave gaps.
struct Series {
  std::string name;  ///< in the legend
  std::vector<double> x{};
  std::vector<double> y{};
  Mark mark = Mark::line;
  bool is_dashed = false;
  /// Which of the palette's eight colors, so that the same thing has the same one in all plots; default: by position.
  std::optional<int> color{};
  /// A band about the line, as from the least to the largest of repeats: one value for each of `y`, or none at all.
  std::vector<double> low{};
  std::vector<double> high{};
};

struct Axis {
  std::string label;  ///< with the unit: "total speed Σ‖v‖ [m/s]"
  bool is_logarithmic = false;
  std::optional<double> min{};  ///< default: so that all values have room
  std::optional<double> max{};
};

/// A value that the eye compares with: a line across the plot.
struct Guide {
  double value = 0;
  std::string label{};
  bool is_vertical = false;
};

struct Plot {
  std::string title{};
  std::string caption{};  ///< what is seen, and of what; below the plot
  Axis x;
  Axis y;
  std::vector<Series> series;
  std::vector<Guide> guides{};
};

/// The plot without its caption, as an <svg> element that stands in a page with plot_style(), or, `is_alone`, as a file
/// of its own that brings the style along. As wide as a column (640 units, text of 13), with a legend that covers no
/// data, ticks at round numbers, a name for screen readers. Colors are those of the reader's light or dark scheme; on
/// paper they are the light ones.
std::string to_svg(const Plot& plot, bool is_alone);

/// The palette's color of a series, 0xRRGGBB, on light ground or on dark; after eight they come again.
enum class Ground { light, dark };
unsigned int palette_color(int color, Ground ground);

/// The style sheet of all plots, of classes that begin with "plot": shapes, and colors for light, dark and print.
std::string plot_style();

}  // namespace pliant_report
