#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "sweep/measurement_table.h"
#include "sweep/sweep_report.h"

namespace pliant_sweep {
namespace {

using pliant_report::Axis;
using pliant_report::Mark;
using pliant_report::Plot;
using pliant_report::Series;

/// The figures that are drawn, if they differ from run to run.
constexpr std::array drawn_figures = {"total_end",       "elastic_end",           "speed_sum_late", "speed_sum_max",
                                      "residual_max",    "iterations_mean",       "contacts_end",   "deepest_max",
                                      "backtracks_mean", "refactorizations_mean", "ms_total"};

struct Range {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
  bool is_constant() const { return !(max - min > 1e-9 * std::max(std::abs(min), std::abs(max))); }
  bool spans(double ratio) const { return min > 0 && max / min > ratio; }
};

/// The last key of a path where it alone says which variation is meant, else the path.
std::string short_name(const std::vector<Variation>& variations, std::size_t which) {
  const auto key = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
  const std::string name = key(variations[which].path);
  const auto same = std::ranges::count_if(variations, [&](const Variation& each) { return key(each.path) == name; });
  return pliant::printable(same == 1 ? name : variations[which].path, 80);
}

/// "stiffness=1, drag=2" of all variations but one.
std::string series_name(const std::vector<Variation>& variations, const Combination& values, std::size_t axis) {
  std::string name;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == axis) continue;
    name +=
        fmt::format("{}{}={}", name.empty() ? "" : ", ", short_name(variations, i), pliant::printable(values[i], 60));
  }
  return name;
}

/// Of what several plots show, so that they can be compared.
void set_range(Axis& axis, const Range& range) {
  constexpr double margin = 0.05;
  if (axis.is_logarithmic) {
    const double factor = std::pow(range.max / range.min, margin);
    axis.min = range.min / factor;
    axis.max = range.max * factor;
  } else {
    axis.min = range.min - margin * (range.max - range.min);
    axis.max = range.max + margin * (range.max - range.min);
  }
}

std::string missing_text(const SweepPlan& plan) {
  const auto missing =
      std::ranges::count_if(plan.runs, [](const SweepRun& run) { return run.result.outcome != RunOutcome::ok; });
  if (missing == 0) return "";
  return fmt::format(" {} of {} runs did not end well and {} left out.", missing, plan.runs.size(),
                     missing == 1 ? "is" : "are");
}

/// A figure over the values of one variation.
class FigureDrawer {
 public:
  FigureDrawer(const SweepPlan& plan, std::size_t axis) : plan_(plan), axis_(axis) {
    for (const std::string& value : variation().values) x_range_.add(number_of(value).value_or(0));
  }

  std::vector<NamedPlot> draw(const std::string& figure) const {
    const std::size_t index = figure_index(figure);
    Range range;
    const std::vector<Series> series = series_of(index, range);
    if (series.empty() || range.is_constant()) return {};
    const std::size_t parts = (series.size() + max_series - 1) / max_series;
    if (parts > max_parts) return {};
    std::vector<NamedPlot> plots;
    for (std::size_t part = 0; part < parts; ++part) {
      Plot plot = empty_plot(index, range);
      if (parts > 1) {
        plot.title += fmt::format(" ({} of {})", part + 1, parts);
        set_range(plot.y, range);
      }
      const auto begin = series.begin() + static_cast<std::ptrdiff_t>(part * max_series);
      plot.series.assign(begin, begin + std::min<std::ptrdiff_t>(max_series, series.end() - begin));
      plots.push_back({part == 0 ? figure : fmt::format("{}-{}", figure, part + 1), std::move(plot)});
    }
    return plots;
  }

 private:
  const Variation& variation() const { return plan_.setup.variations[axis_]; }

  Plot empty_plot(std::size_t figure, const Range& range) const {
    const std::string& label = figure_infos()[figure].label;
    Plot plot;
    plot.title = label.substr(0, label.rfind(" ["));
    plot.title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(plot.title.front())));
    plot.caption = fmt::format("Over {}.{}", pliant::printable(variation().path), missing_text(plan_));
    plot.x.label = pliant::printable(variation().path);
    plot.x.is_logarithmic = x_range_.spans(30);
    plot.y.label = label;
    plot.y.is_logarithmic = range.spans(100);
    return plot;
  }

  /// One for each combination of the other values, in the order in which they come.
  std::vector<Series> series_of(std::size_t figure, Range& range) const {
    std::map<Combination, std::map<double, double>> curves;
    std::vector<Combination> order;
    for (const SweepRun& run : plan_.runs) {
      const auto value = run.result.outcome == RunOutcome::ok ? run.result.figure(figure) : std::nullopt;
      const auto x = number_of(run.values[axis_]);
      if (!value || !x || !std::isfinite(*value)) continue;
      range.add(*value);
      Combination others = run.values;
      others[axis_].clear();
      const auto [curve, is_new] = curves.try_emplace(std::move(others));
      if (is_new) order.push_back(curve->first);
      curve->second[*x] = *value;
    }
    std::vector<Series> series;
    for (const Combination& others : order) {
      Series& one = series.emplace_back(Series{series_name(plan_.setup.variations, others, axis_)});
      for (const auto& [x, y] : curves[others]) {
        one.x.push_back(x);
        one.y.push_back(y);
      }
      one.mark = Mark::line_and_points;
    }
    return series;
  }

  const SweepPlan& plan_;
  std::size_t axis_;
  Range x_range_;
};

/// Every n-th value, so that no more than a thousand are drawn.
std::vector<double> thinned(const std::vector<double>& values, std::size_t stride) {
  std::vector<double> result;
  for (std::size_t i = 0; i < values.size(); i += stride) result.push_back(values[i]);
  return result;
}

std::optional<Series> time_series(const std::filesystem::path& file, const std::string& column, std::size_t& stride) {
  try {
    const MeasurementTable table = read_measurements(file);
    const auto* row_times = table.find("time");
    const auto* values = table.find(column);
    if (row_times == nullptr || values == nullptr || values->empty()) return std::nullopt;
    constexpr std::size_t most = 1000;
    const std::size_t every = (values->size() + most - 1) / most;
    stride = std::max(stride, every);
    return Series{"", thinned(*row_times, every), thinned(*values, every)};
  } catch (const pliant::Error&) {  // it was there a moment ago; the others still tell something
    return std::nullopt;
  }
}

}  // namespace

std::size_t find_axis(const std::vector<Variation>& variations) {
  const auto found = std::ranges::find_if(variations, [](const Variation& variation) {
    std::set<double> numbers;
    for (const std::string& value : variation.values) {
      const auto number = number_of(value);
      if (!number) return false;
      numbers.insert(*number);
    }
    return numbers.size() > 1;
  });
  return static_cast<std::size_t>(found - variations.begin());
}

std::vector<NamedPlot> figure_plots(const SweepPlan& plan) {
  const std::size_t axis = find_axis(plan.setup.variations);
  if (axis == plan.setup.variations.size()) return {};
  const FigureDrawer drawer(plan, axis);
  std::vector<NamedPlot> plots;
  for (const char* figure : drawn_figures) {
    for (NamedPlot& plot : drawer.draw(figure)) plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<NamedPlot> time_plots(const std::filesystem::path& folder, const SweepPlan& plan) {
  if (plan.runs.size() > max_series) return {};
  const auto draw = [&](const std::string& name, const std::string& title, const std::string& column,
                        const std::string& label) {
    NamedPlot result{name, {}};
    result.plot.title = title;
    result.plot.x.label = "time [s]";
    result.plot.y.label = label;
    std::size_t stride = 1;
    for (std::size_t i = 0; i < plan.runs.size(); ++i) {
      const SweepRun& run = plan.runs[i];
      if (run.result.outcome != RunOutcome::ok) continue;
      auto series = time_series(run_folder(folder, run.name) / "measurements.csv", column, stride);
      if (!series) continue;
      series->name = series_name(plan.setup.variations, run.values, run.values.size());
      series->color = static_cast<int>(i);
      result.plot.series.push_back(std::move(*series));
    }
    const std::string thinning = stride > 1 ? fmt::format(" Up to every {}th record is drawn.", stride) : "";
    result.plot.caption = fmt::format("As measured.{}{}", thinning, missing_text(plan));
    return result;
  };
  std::vector<NamedPlot> plots = {
      draw("energy_over_time", "Total energy over time", "total", "total energy [J]"),
      draw("speed_over_time", "Total speed over time", "speed_sum", "total speed Σ‖v‖ [m/s]")};
  std::erase_if(plots, [](const NamedPlot& plot) { return plot.plot.series.empty(); });
  return plots;
}

}  // namespace pliant_sweep
