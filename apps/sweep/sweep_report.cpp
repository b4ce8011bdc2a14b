#include "sweep/sweep_report.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/core/version.h"
#include "pliant_io/files/atomic_file.h"
#include "report/report.h"
#include "report/typeset.h"

namespace pliant_sweep {
namespace {

namespace fs = std::filesystem;
using pliant_report::Chapter;
using pliant_report::Paragraph;
using pliant_report::Report;
using pliant_report::Table;

constexpr std::array table_figures = {"total_end", "elastic_end", "speed_sum_late", "residual_max", "ms_total"};

void add_facts(Report& report, const SweepPlan& plan) {
  const SweepSetup& setup = plan.setup;
  report.facts.emplace_back("Scene", pliant::printable_place(setup.scene));
  for (const Variation& variation : setup.variations) {
    report.facts.emplace_back(pliant::printable(variation.path),
                              pliant::printable(fmt::format("{}", fmt::join(variation.values, ", ")), 400));
  }
  for (const std::string& assignment : setup.set) {
    report.facts.emplace_back("All runs", pliant::printable(assignment));
  }
  for (const auto& [name, value] : setup.options) {
    report.facts.emplace_back("All runs", pliant::printable(fmt::format("{} {}", name, value)));
  }
  report.facts.emplace_back("Runs", fmt::format("{}: {}", plan.runs.size(), outcomes_text(plan)));
  report.facts.emplace_back("Pliant", fmt::format("{} ({})", pliant::version, pliant::compiler));
}

/// A warning where figures at the end are of different times, as where time steps vary and their number does not.
std::string ends_text(const SweepPlan& plan) {
  double first = std::numeric_limits<double>::infinity();
  double last = 0;
  for (const SweepRun& run : plan.runs) {
    const auto time = run.result.outcome == RunOutcome::ok ? run.result.figure(figure_index("time_end")) : std::nullopt;
    first = std::min(first, time.value_or(first));
    last = std::max(last, time.value_or(last));
  }
  if (!(last > first * (1 + 1e-9))) return "";
  return fmt::format(
      "The runs end at different times, from {:.4g} to {:.4g} s: figures at the end are of these, and means "
      "and maxima of different spans. ",
      first, last);
}

/// Why there are fewer plots than one might look for; empty: there are all.
std::string plots_text(const SweepPlan& plan, const std::vector<NamedPlot>& plots) {
  const std::vector<Variation>& variations = plan.setup.variations;
  const std::size_t axis = find_axis(variations);
  if (axis == variations.size()) {
    return "No variation has numbers alone, and more than one, so that nothing can be drawn over it; see the table.";
  }
  const std::size_t series = plan.runs.size() / variations[axis].values.size();
  if (series > max_series * max_parts) {
    return fmt::format("{} series over {} are too many for plots; see sweep.csv.", series,
                       pliant::printable(variations[axis].path));
  }
  if (plots.empty()) return "No figure differs from run to run; see the table.";
  if (series > max_series) return fmt::format("{} series are several plots of each figure.", series);
  return "";
}

Table table_of(const SweepPlan& plan) {
  constexpr std::size_t most_rows = 500;
  Table table{"The runs in the order of the product; sweep.csv has all of their figures.", {"run"}, {}};
  if (plan.runs.size() > most_rows) {
    table.caption = fmt::format("The first {} of {} runs; sweep.csv has all.", most_rows, plan.runs.size());
  }
  for (const Variation& variation : plan.setup.variations) table.columns.push_back(pliant::printable(variation.path));
  table.columns.emplace_back("outcome");
  for (const char* figure : table_figures) table.columns.push_back(figure_infos()[figure_index(figure)].label);
  const auto has_message = [](const SweepRun& run) { return !run.result.message.empty(); };
  const bool has_messages = std::ranges::any_of(plan.runs, has_message);
  if (has_messages) table.columns.emplace_back("message");
  for (std::size_t i = 0; i < std::min(most_rows, plan.runs.size()); ++i) {
    const SweepRun& run = plan.runs[i];
    std::vector<std::string> row = {run.name};
    for (const std::string& value : run.values) row.push_back(pliant::printable(value));
    const auto names = choice_names(run.result.outcome);
    row.emplace_back(names[static_cast<std::size_t>(run.result.outcome)]);
    for (const char* name : table_figures) {
      const auto figure = run.result.figure(figure_index(name));
      row.push_back(figure ? fmt::format("{:.4g}", *figure) : "");
    }
    if (has_messages) row.push_back(pliant::printable(run.result.message, 400));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Chapter chapter_of(std::string name, std::string title, const std::string& text, const std::vector<NamedPlot>& plots) {
  Chapter chapter;
  chapter.name = std::move(name);
  chapter.title = std::move(title);
  if (!text.empty()) chapter.blocks.emplace_back(Paragraph{text});
  for (const NamedPlot& plot : plots) chapter.blocks.emplace_back(plot.plot);
  return chapter;
}

/// Every name that a plot of any start may have had.
std::set<std::string> possible_names() {
  std::set<std::string> names = {"energy_over_time", "speed_over_time"};
  for (const FigureInfo& info : figure_infos()) {
    names.insert(info.name);
    for (std::size_t part = 2; part <= max_parts; ++part) names.insert(fmt::format("{}-{}", info.name, part));
  }
  return names;
}

void write_plots(const fs::path& folder, const std::vector<NamedPlot>& plots) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw pliant::Error(
        pliant::ErrorKind::output,
        fmt::format("{}: cannot be made: {}", pliant::printable_place(folder.string()), error.message()));
  }
  std::set<std::string> others = possible_names();
  for (const NamedPlot& plot : plots) {
    pliant::write_file_atomically(folder / (plot.name + ".svg"), to_svg(pliant_report::with_powers(plot.plot), true));
    others.erase(plot.name);
  }
  for (const std::string& name : others) fs::remove(folder / (name + ".svg"), error);
}

}  // namespace

void write_sweep_report(const fs::path& folder, const SweepPlan& plan) {
  const std::vector<NamedPlot> figures = figure_plots(plan);
  const std::vector<NamedPlot> over_time = time_plots(folder, plan);
  std::vector<NamedPlot> all = figures;
  all.insert(all.end(), over_time.begin(), over_time.end());
  write_plots(folder / "plots", all);

  Report report;
  report.title = fmt::format("Sweep of {}", pliant::printable_place(fs::path(plan.setup.scene).stem().string(), 100));
  add_facts(report, plan);
  report.chapters.push_back(
      chapter_of("figures", "Figures over the varied values", ends_text(plan) + plots_text(plan, figures), figures));
  if (!over_time.empty()) report.chapters.push_back(chapter_of("times", "The runs over time", "", over_time));
  report.chapters.push_back(chapter_of("runs", "All runs", "", {}));
  report.chapters.back().blocks.emplace_back(table_of(plan));
  pliant::write_file_atomically(folder / "index.html", pliant_report::to_html(report));
}

}  // namespace pliant_sweep
