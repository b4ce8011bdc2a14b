#pragma once
// Plots of a sweep over the values that were varied, and the page with all of them.
#include <filesystem>
#include <string>
#include <vector>

#include "report/plot.h"
#include "sweep/sweep_plan.h"

namespace pliant_sweep {

struct NamedPlot {
  std::string name;  ///< of its file, without ".svg"
  pliant_report::Plot plot;
};

/// More lines cannot be told apart by their colors.
inline constexpr std::size_t max_series = 8;
/// Of one figure, each with its share of the series.
inline constexpr std::size_t max_parts = 4;

/// The first variation whose values are all numbers, and more than one; none: variations.size().
std::size_t find_axis(const std::vector<Variation>& variations);

/// Figures of the runs that ended well over the first variation of numbers, a series for each combination of the
/// others' values; figures that are the same for all runs are left out. Up to max_series series are one plot, more are
/// several with the same axes, and more than max_parts of these are none.
std::vector<NamedPlot> figure_plots(const SweepPlan& plan);

/// Total energy and total speed over time, of the runs that ended well; none when there are more than max_series runs.
std::vector<NamedPlot> time_plots(const std::filesystem::path& folder, const SweepPlan& plan);

/// Writes FOLDER/plots/*.svg, in the place of those of an earlier start, and FOLDER/index.html.
/// @throws pliant::Error (output)
void write_sweep_report(const std::filesystem::path& folder, const SweepPlan& plan);

}  // namespace pliant_sweep
