// pliant plot: what runs measured, over time.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "number_option.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/read_file.h"
#include "plot/run_plots.h"
#include "report/report.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;
using pliant_plot::MeasuredRun;
using pliant_report::Plot;

struct PlotArguments {
  std::vector<fs::path> runs;        ///< folders, or measurements.csv themselves
  fs::path out;                      ///< page, drawing or numbers
  std::vector<std::string> columns;  ///< none: the usual
  bool is_logarithmic = false;       ///< all vertical axes; else where values span decades
  std::optional<pliant::Real> from;  ///< [s]
  std::optional<pliant::Real> to;    ///< [s]
};

fs::path measurements_of(const fs::path& run) {
  std::error_code ignored;
  return fs::is_directory(run, ignored) ? run / "measurements.csv" : run;
}

/// The last part of the path where it alone says which run is meant, else the path.
std::string short_name(const std::vector<fs::path>& runs, std::size_t which) {
  const auto key = [](const fs::path& path) {
    const fs::path folder = path.filename() == "measurements.csv" ? path.parent_path() : path;
    return (folder.filename().empty() ? folder.parent_path() : folder).filename();
  };
  const fs::path name = key(runs[which]);
  const auto same = std::ranges::count_if(runs, [&](const fs::path& each) { return key(each) == name; });
  return pliant::printable(same == 1 && !name.empty() ? name.string() : runs[which].string(), 60);
}

std::vector<MeasuredRun> read_runs(const PlotArguments& arguments) {
  std::vector<MeasuredRun> runs;
  for (std::size_t i = 0; i < arguments.runs.size(); ++i) {
    const fs::path file = measurements_of(arguments.runs[i]);
    std::error_code ignored;
    if (!fs::exists(file, ignored)) {
      pliant::fail_input(fmt::format("{} is not there; give the folder of a run: pliant run SCENE --out FOLDER",
                                     pliant::printable_place(file.string())));
    }
    runs.push_back({short_name(arguments.runs, i), pliant_sweep::read_measurements(file)});
    if (runs.back().table.find("time") == nullptr) {
      pliant::fail_input(fmt::format("{}: it has no column 'time'; give the measurements.csv of a run",
                                     pliant::printable_place(file.string())));
    }
  }
  return runs;
}

/// What run.json says of a run, as far as it is there: it may still go on, or be of another program.
void add_facts(pliant_report::Report& report, const fs::path& run, const MeasuredRun& measured) {
  std::string text =
      measured.table.row_count() == 1 ? "1 record" : fmt::format("{} records", measured.table.row_count());
  try {
    const fs::path file = measurements_of(run).parent_path() / "run.json";
    const nlohmann::json json = nlohmann::json::parse(pliant::read_file(file), nullptr, false);
    if (json.is_object() && json.contains("outcome") && json["outcome"].is_string()) {
      text += fmt::format(", {}", pliant::printable(json["outcome"].get<std::string>(), 40));
    }
  } catch (const pliant::Error&) {  // there is none
  }
  report.facts.emplace_back(measured.name, text);
}

pliant_report::Report make_report(const PlotArguments& arguments, const std::vector<MeasuredRun>& runs,
                                  const std::vector<Plot>& plots) {
  pliant_report::Report report;
  report.title = runs.size() == 1 ? runs[0].name : fmt::format("{} runs", runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) add_facts(report, arguments.runs[i], runs[i]);
  pliant_report::Chapter chapter{.name = "measured", .title = "Over time"};
  for (const Plot& plot : plots) chapter.blocks.emplace_back(plot);
  report.chapters.push_back(std::move(chapter));
  return report;
}

/// A drawing has one plot.
const Plot& only_plot(const std::vector<Plot>& plots) {
  if (plots.size() == 1) return plots.front();
  pliant::fail_input(
      fmt::format("--out: {} plots do not go into one drawing; give --columns of one unit, or a name "
                  "that ends in .html",
                  plots.size()));
}

/// The numbers of a plot, as a report has them beside its figures.
std::string csv_of(const Plot& plot) {
  pliant_report::Report report;
  report.chapters.push_back({.name = "plot", .title = plot.title, .blocks = {plot}});
  for (const pliant_report::FigureFile& file : figure_files(report)) {
    if (fs::path(file.name).extension() == ".csv") return file.content;
  }
  return {};
}

void check(const PlotArguments& arguments) {
  if (arguments.runs.size() > pliant_plot::most_lines) {
    pliant::fail_input(fmt::format("{} runs in one plot cannot be told apart; give at most {}", arguments.runs.size(),
                                   pliant_plot::most_lines));
  }
  const fs::path ending = arguments.out.extension();
  if (ending != ".html" && ending != ".svg" && ending != ".csv") {
    pliant::fail_input(fmt::format("--out: '{}' has no known ending; give .html, .svg or .csv",
                                   pliant::printable_place(arguments.out.string())));
  }
}

/// The measurements of a run are never replaced by a plot of them.
void refuse_to_replace(const PlotArguments& arguments) {
  for (const fs::path& run : arguments.runs) {
    std::error_code ignored;
    if (!fs::equivalent(arguments.out, measurements_of(run), ignored)) continue;
    pliant::fail_input(fmt::format("--out: {} is what is to be plotted; give another name",
                                   pliant::printable_place(arguments.out.string())));
  }
}

void plot(const PlotArguments& arguments) {
  check(arguments);
  refuse_to_replace(arguments);
  pliant_plot::PlotChoice choice{.columns = arguments.columns};
  choice.is_thinned = arguments.out.extension() != ".csv";
  if (arguments.is_logarithmic) choice.is_logarithmic = true;
  choice.from = arguments.from.value_or(choice.from);
  choice.to = arguments.to.value_or(choice.to);
  const std::vector<MeasuredRun> runs = read_runs(arguments);
  const std::vector<Plot> plots = run_plots(runs, choice);
  const fs::path ending = arguments.out.extension();
  std::string text;
  if (ending == ".html") text = to_html(make_report(arguments, runs, plots));
  if (ending == ".svg") text = to_svg(only_plot(plots), true);
  if (ending == ".csv") text = csv_of(only_plot(plots));
  pliant::write_file_atomically(arguments.out, text);
  fmt::print("{}: {} of {}\n", pliant::printable_place(arguments.out.string()),
             plots.size() == 1 ? "a plot" : fmt::format("{} plots", plots.size()),
             runs.size() == 1 ? "a run" : fmt::format("{} runs", runs.size()));
}

}  // namespace

void add_plot_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("plot", "Draw what runs measured over time: energies, speed, contact");
  const auto arguments = std::make_shared<PlotArguments>();
  command->add_option("runs", arguments->runs, "Folders of runs, which may still go on; at most 8")
      ->type_name("FOLDER")
      ->required();
  command
      ->add_option("--out", arguments->out,
                   "Page with all plots (.html), or one plot as a drawing (.svg) or its numbers (.csv)")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--columns", arguments->columns,
                   "Columns of measurements.csv, separated by commas; \"elastic\" is the sum of all groups'; default: "
                   "those in which anything happens")
      ->type_name("NAMES")
      ->delimiter(',');
  command->add_flag("--log", arguments->is_logarithmic, "Logarithmic vertical axes");
  add_number(*command, "--from", arguments->from, "Begin at this time [s]");
  add_number(*command, "--to", arguments->to, "End at this time [s]");
  command->footer(
      "Examples:\n"
      "  pliant plot out/flag --out flag.html\n"
      "  pliant plot out/flag --out energy.svg --columns kinetic,elastic,total\n"
      "  pliant plot out/soft out/stiff --out compare.html\n"
      "  pliant plot out/soft out/stiff --out residual.svg --columns residual --log --from 1");
  command->callback([arguments] { plot(*arguments); });
}

}  // namespace pliant_cli
