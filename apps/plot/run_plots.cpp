#include "plot/run_plots.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/scene/nearest_names.h"
#include "plot/column_info.h"

namespace pliant_plot {
namespace {

using pliant_report::Plot;
using pliant_report::Series;
using pliant_sweep::MeasurementTable;

constexpr std::size_t spans = 600;  // of time, with two points each

char letter(int changed) {
  return static_cast<char>(changed);
}

/// "energy", as axes are labeled.
std::string in_axis(std::string title) {
  if (!title.empty()) title.front() = letter(std::tolower(static_cast<unsigned char>(title.front())));
  return title;
}

/// "Total energy".
std::string as_title(std::string label) {
  if (!label.empty()) label.front() = letter(std::toupper(static_cast<unsigned char>(label.front())));
  return label;
}

/// Those of a run; a column stands in one of them.
std::vector<Figure> all_figures(const std::vector<std::string>& names) {
  std::vector<Figure> figures = {
      {"Energy", {"kinetic", "elastic", "gravitational", "other_potential", "total"}},
      {"Elastic energy by group", {}},
      {"Total speed", {"speed_sum"}},
      {"Momentum", {"momentum"}},
      {"Stretch past limits", {"past_limits"}},
      {"What the last iteration leaves", {"residual"}},
      {"Iterations", {"iterations"}},
      {"Contacts", {"contacts", "active"}},
      {"Smallest gap", {"smallest_gap"}},
      {"Moves that contact cut", {"held_back", "shortened", "backtracks"}},
      {"Power of friction", {"friction_power"}},
      {"Lag of pinned vertices", {"lag"}},
      {"Forces on colliders", {}},
      {"Time of a step", {"ms_local", "ms_global", "ms_contact", "ms_total"}},
  };
  for (const std::string& name : names) {
    if (name.starts_with("elastic_")) figures[1].columns.push_back(name);
    if (name.starts_with("force_")) figures[12].columns.push_back(name);
  }
  if (figures[1].columns.size() < 2) figures[1].columns.clear();
  return figures;
}

/// Null where there is none; sums stand in `sums`.
const std::vector<double>* values_of(const MeasurementTable& table, const std::string& column,
                                     std::vector<double>& sums) {
  if (column != "elastic") return table.find(column);
  sums = table.elastic();
  return &sums;
}

bool is_event(double value) {
  return std::isfinite(value) && value != 0;
}

/// A column of a run, between two times.
std::optional<Series> line_of(const MeasuredRun& run, const std::string& column, const PlotChoice& choice) {
  const std::vector<double>* times = run.table.find("time");
  std::vector<double> sums;
  const std::vector<double>* values = values_of(run.table, column, sums);
  if (times == nullptr || values == nullptr) return {};
  Series line;
  line.x.reserve(times->size());
  line.y.reserve(times->size());
  for (std::size_t i = column_info(column).is_of_step ? 1 : 0; i < times->size(); ++i) {
    const double time = (*times)[i];
    if (time < choice.from || time > choice.to) continue;
    if (choice.joins_over_nan && std::isnan((*values)[i])) continue;
    line.x.push_back(time);
    line.y.push_back((*values)[i]);
  }
  return line;
}

}  // namespace

void thin(Series& line) {
  const std::size_t count = line.x.size();
  if (count <= 2 * spans) return;
  Series thinned;
  const auto keep = [&](std::size_t i) {
    thinned.x.push_back(line.x[i]);
    thinned.y.push_back(line.y[i]);
  };
  for (std::size_t span = 0; span < spans; ++span) {
    const std::size_t begin = span * count / spans, end = (span + 1) * count / spans;
    std::size_t least = end, largest = end;
    for (std::size_t i = begin; i < end; ++i) {
      if (!std::isfinite(line.y[i])) continue;
      if (least == end || line.y[i] < line.y[least]) least = i;
      if (largest == end || line.y[i] >= line.y[largest]) largest = i;
    }
    if (least == end) {
      keep(begin);
      continue;
    }
    keep(std::min(least, largest));
    keep(std::max(least, largest));
  }
  line.x = std::move(thinned.x);
  line.y = std::move(thinned.y);
}

namespace {

bool has_events(const Series& line) {
  return std::ranges::any_of(line.y, is_event);
}

/// Whether values span powers of ten, so that a logarithmic axis shows more.
bool spans_decades(const std::vector<Series>& lines) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Series& line : lines) {
    for (const double value : line.y) {
      if (!std::isfinite(value) || !(value > 0)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  return most > 30 * least;
}

class RunPlotter {
 public:
  RunPlotter(std::span<const MeasuredRun> runs, const PlotChoice& choice) : runs_(runs), choice_(choice) {}

  /// Of the one run, lines that are more than zero throughout, or were asked for; in parts where there are many.
  std::vector<Plot> lines_of_run(const Figure& figure, bool is_asked_for) const {
    std::vector<Series> lines;
    std::string first;
    for (const std::string& column : figure.columns) {
      std::optional<Series> line = line_of(runs_.front(), column, choice_);
      if (!line || !(is_asked_for || (has_events(*line) && !is_given_number(column, *line)))) continue;
      if (lines.empty()) first = column;
      line->name = column_info(column).label;
      lines.push_back(std::move(*line));
    }
    const ColumnInfo info = column_info(first);
    const std::size_t parts = (lines.size() + most_lines - 1) / most_lines;
    std::vector<Plot> plots;
    for (std::size_t part = 0; part < parts; ++part) {
      const auto begin = lines.begin() + static_cast<std::ptrdiff_t>(part * most_lines);
      const auto end = lines.begin() + static_cast<std::ptrdiff_t>(std::min(lines.size(), (part + 1) * most_lines));
      const std::string several = figure.axis.empty() ? in_axis(figure.title) : figure.axis;
      const std::string label = lines.size() == 1 ? info.label : several;
      const std::string number = parts > 1 ? fmt::format(" ({} of {})", part + 1, parts) : "";
      plots.push_back(
          finish(figure.title + number, label, info, {std::make_move_iterator(begin), std::make_move_iterator(end)}));
    }
    return plots;
  }

  /// Of a column, a line for each run that has it.
  std::optional<Plot> lines_of_column(const std::string& column, bool is_asked_for) const {
    std::vector<Series> lines;
    const ColumnInfo info = column_info(column);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      std::optional<Series> line = line_of(runs_[i], column, choice_);
      if (!line) continue;
      line->name = runs_[i].name;
      line->color = static_cast<int>(i);
      lines.push_back(std::move(*line));
    }
    if (lines.empty() || !(is_asked_for || std::ranges::any_of(lines, has_events))) return {};
    return finish(as_title(info.label), info.label, info, std::move(lines));
  }

 private:
  /// Iterations that are as many in every step say nothing.
  static bool is_given_number(const std::string& column, const Series& line) {
    return column == "iterations" && std::ranges::all_of(line.y, [&](double value) { return value == line.y.front(); });
  }

  Plot finish(const std::string& title, const std::string& label, const ColumnInfo& info,
              std::vector<Series> lines) const {
    Plot plot;
    plot.title = title;
    plot.x.label = "time [s]";
    plot.y.label = with_unit(label, info.unit);
    plot.y.is_logarithmic = choice_.is_logarithmic.value_or(info.is_logarithmic && spans_decades(lines));
    std::size_t rows = 0;
    for (Series& line : lines) {
      rows = std::max(rows, line.x.size());
      if (choice_.is_thinned) thin(line);
    }
    if (choice_.is_thinned && rows > 2 * spans) {
      plot.caption = fmt::format("The least and the largest value of each {:.3g} records.",
                                 static_cast<double>(rows) / static_cast<double>(spans));
    }
    plot.series = std::move(lines);
    return plot;
  }

  std::span<const MeasuredRun> runs_;
  const PlotChoice& choice_;
};

/// Of all runs, in the order in which they come.
std::vector<std::string> all_names(const std::vector<MeasuredRun>& runs) {
  std::vector<std::string> names;
  std::set<std::string_view> known;
  for (const MeasuredRun& run : runs) {
    for (const std::string& name : run.table.names) {
      if (known.insert(name).second) names.push_back(name);
    }
  }
  return names;
}

void check_columns(const std::vector<std::string>& asked, const std::vector<std::string>& names) {
  std::vector<std::string_view> known(names.begin(), names.end());
  known.emplace_back("elastic");
  for (const std::string& column : asked) {
    if (column.empty()) pliant::fail_input("--columns: a name is empty; separate names by single commas");
    if (std::ranges::find(known, std::string_view(column)) != known.end()) continue;
    pliant::fail_input(fmt::format("--columns: unknown column '{}'; {}", pliant::printable(column, 60),
                                   pliant::suggestion_text(column, known)));
  }
}

void check_times(const std::vector<MeasuredRun>& runs, const PlotChoice& choice) {
  if (choice.from > choice.to) pliant::fail_input("--from: it is later than --to; exchange the two");
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const MeasuredRun& run : runs) {
    const std::vector<double>* times = run.table.find("time");
    if (times == nullptr || times->empty()) continue;
    for (const double time : *times) {
      if (time >= choice.from && time <= choice.to) return;
    }
    first = std::min(first, times->front());
    last = std::max(last, times->back());
  }
  if (first > last) pliant::fail_input("nothing was measured yet");
  pliant::fail_input(
      fmt::format("--from, --to: nothing was measured then; the records are from {:.6g} to {:.6g} s", first, last));
}

/// Columns of one unit together.
std::vector<Figure> figures_by_unit(const std::vector<std::string>& columns) {
  std::vector<Figure> figures;
  std::vector<std::string> units;
  for (const std::string& column : columns) {
    const ColumnInfo info = column_info(column);
    const auto known = std::ranges::find(units, info.unit);
    if (known != units.end()) {
      Figure& figure = figures[static_cast<std::size_t>(known - units.begin())];
      figure.columns.push_back(column);
      figure.title += ", " + info.label;
      figure.axis = "value";
      continue;
    }
    units.push_back(info.unit);
    figures.push_back({as_title(info.label), {column}});
  }
  return figures;
}

}  // namespace

std::vector<Figure> usual_figures(const std::vector<std::string>& names) {
  std::vector<Figure> figures = all_figures(names);
  const auto is_missing = [&](const std::string& column) {
    if (column != "elastic") return std::ranges::find(names, column) == names.end();
    return std::ranges::none_of(names, [](const std::string& name) { return name.starts_with("elastic_"); });
  };
  for (Figure& figure : figures) std::erase_if(figure.columns, is_missing);
  std::erase_if(figures, [](const Figure& figure) { return figure.columns.empty(); });
  return figures;
}

std::vector<Plot> figure_plots(const MeasuredRun& run, const Figure& figure, const PlotChoice& choice) {
  Figure eventful = figure;
  std::erase_if(eventful.columns, [&](const std::string& column) {
    for (std::size_t i = 0; i < run.table.names.size(); ++i) {
      const std::string& name = run.table.names[i];
      const bool counts = column == "elastic" ? name.starts_with("elastic_") : name == column;
      if (counts && std::ranges::any_of(run.table.columns[i], is_event)) return false;
    }
    return true;
  });
  PlotChoice joined = choice;
  joined.joins_over_nan = true;
  std::vector<Plot> plots =
      RunPlotter({&run, 1}, joined).lines_of_run(eventful.columns.empty() ? figure : eventful, true);
  std::erase_if(plots, [](const Plot& plot) {
    return std::ranges::all_of(plot.series, [](const Series& line) { return line.x.empty(); });
  });
  return plots;
}

std::vector<Plot> run_plots(const std::vector<MeasuredRun>& runs, const PlotChoice& choice) {
  const std::vector<std::string> names = all_names(runs);
  check_columns(choice.columns, names);
  check_times(runs, choice);
  const bool is_asked_for = !choice.columns.empty();
  const RunPlotter plotter(runs, choice);
  std::vector<Plot> plots;
  for (const Figure& figure : is_asked_for ? figures_by_unit(choice.columns) : all_figures(names)) {
    if (runs.size() == 1) {
      for (Plot& plot : plotter.lines_of_run(figure, is_asked_for)) plots.push_back(std::move(plot));
      continue;
    }
    for (const std::string& column : figure.columns) {
      std::optional<Plot> plot = plotter.lines_of_column(column, is_asked_for);
      if (plot) plots.push_back(std::move(*plot));
    }
  }
  return plots;
}

}  // namespace pliant_plot
