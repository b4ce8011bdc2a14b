#pragma once
// What the window saves of its plots.
#include <filesystem>
#include <string>
#include <vector>

#include "plot/run_plots.h"

namespace pliant_viewer {

/// "out/sheet-plot-1.svg, sheet-plot-2.svg and sheet-plot-3.svg", which are in one folder; not of none.
std::string saved_names(const std::vector<std::filesystem::path>& files);

/// Writes all that was measured, as measurements.csv has it, under a free name, which it returns.
/// @throws pliant::Error (output)
std::filesystem::path save_measured(const pliant_plot::MeasuredRun& run, const std::filesystem::path& folder);

/// Writes each plot as an SVG file of its own under a free name; returns these. @throws pliant::Error (output)
std::vector<std::filesystem::path> save_plots(const std::vector<pliant_report::Plot>& plots, const std::string& scene,
                                              const std::filesystem::path& folder);

}  // namespace pliant_viewer
