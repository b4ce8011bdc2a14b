#pragma once
// The measurements of one or several runs over time, as plots.
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/plot.h"
#include "sweep/measurement_table.h"

namespace pliant_plot {

/// More lines cannot be told apart by their colors.
inline constexpr std::size_t most_lines = 8;

struct MeasuredRun {
  std::string name;  ///< in legends
  pliant_sweep::MeasurementTable table;
};

struct PlotChoice {
  std::vector<std::string> columns{};    ///< of measurements.csv, or "elastic", the sum of all groups'; none: the usual
  std::optional<bool> is_logarithmic{};  ///< of the vertical axes; none: where the column is best seen so
  bool joins_over_nan = false;  ///< lines go on over rows in which a column was not measured, else they have a gap
  bool is_thinned = true;       ///< long lines are drawn by the least and the largest value of each short span of time
  double from = -std::numeric_limits<double>::infinity();  ///< [s]
  double to = std::numeric_limits<double>::infinity();     ///< [s]
};

/// Of one run: lines of one unit in one plot. Of several: a plot for each column, with a line for each run. Without a
/// choice of columns those plots in which anything happens.
/// At most most_lines runs. @throws pliant::Error (input): a column that no run has, no row between `from` and `to`
std::vector<pliant_report::Plot> run_plots(const std::vector<MeasuredRun>& runs, const PlotChoice& choice);

/// What goes into one plot of a run.
struct Figure {
  std::string title;
  std::vector<std::string> columns;
  std::string axis = {};  ///< of several lines; empty: the title
};

/// The usual figures of a run with these columns, each with those of its columns that the run has.
std::vector<Figure> usual_figures(const std::vector<std::string>& names);

/// A figure of one run, in parts where it has more than most_lines lines; lines go on over what was not measured. What
/// is zero throughout the run is left out unless all of it is; nothing where there is no row between `from` and `to`.
std::vector<pliant_report::Plot> figure_plots(const MeasuredRun& run, const Figure& figure, const PlotChoice& choice);

/// Leaves of a long line the least and the largest value of each short span, in their order. Where a span has no number
/// the line has a gap.
void thin(pliant_report::Series& line);

}  // namespace pliant_plot
