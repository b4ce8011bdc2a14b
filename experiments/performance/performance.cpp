#include "performance/performance.h"

#include <cmath>

#include <fmt/format.h>

#include "support/claims.h"
#include "support/statistics.h"

namespace pliant_experiments {
namespace {

using pliant::Index;
using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Table;

constexpr std::array<Index, 5> sides = {16, 32, 64, 128, 192};
constexpr std::array<Index, 5> counts = {1, 2, 5, 10, 20};
constexpr Index thesis_side = 32;  // 1024 vertices

/// Times of steps [s], after some that warm up.
Spread seconds_a_step(const ExperimentContext& context, Index side, Index iterations) {
  pliant::Scene scene = context.scene("performance/curtain", {fmt::format("bodies[curtain].mesh.columns={}", side),
                                                              fmt::format("bodies[curtain].mesh.rows={}", side),
                                                              fmt::format("settings.iterations={}", iterations)});
  context.step(scene, 3);
  std::vector<double> seconds;
  double sum = 0;
  while (seconds.size() < 5 || (sum < 0.4 && seconds.size() < 500)) {
    seconds.push_back(context.step(scene).seconds_total);
    sum += seconds.back();
  }
  return spread(std::move(seconds));
}

}  // namespace

Chapter run_performance(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question =
      "A curtain of springs with bending at every interior vertex: how many steps a second, over its vertices, with 1 "
      "to 20 iterations a step? Medians of at least 5 steps, all processors.";
  Plot plot{.title = "Steps a second",
            .caption =
                "Over the vertices, by iterations a step: medians, and bands from the first to the third quartile; "
                "above the dashed line it runs in real time at 60 steps a second.",
            .x = {.label = "vertices", .is_logarithmic = true},
            .y = {.label = "steps a second", .is_logarithmic = true},
            .series = {},
            .guides = {{60, "60 a second", false}}};
  Table table{"Milliseconds a step.", {"vertices"}, {}};
  std::vector<pliant_report::Series> series;
  for (const Index count : counts) {
    const std::string name = count == 1 ? "1 iteration" : fmt::format("{} iterations", count);
    series.push_back({.name = name, .mark = pliant_report::Mark::line_and_points});
    table.columns.push_back(name);
  }
  double thesis_rate = 0;
  for (const Index side : sides) {
    std::vector<std::string> row = {std::to_string(side * side)};
    for (std::size_t i = 0; i < counts.size(); ++i) {
      context.say(fmt::format("{} vertices, {} iterations", side * side, counts[i]));
      const Spread spread_of_seconds = seconds_a_step(context, side, counts[i]);
      const double seconds = spread_of_seconds.middle;
      series[i].x.push_back(static_cast<double>(side) * side);
      series[i].y.push_back(1 / seconds);
      series[i].low.push_back(1 / spread_of_seconds.high);
      series[i].high.push_back(1 / spread_of_seconds.low);
      row.push_back(fmt::format("{:.3g}", 1e3 * seconds));
      if (side == thesis_side && counts[i] == 5) thesis_rate = 1 / seconds;
    }
    table.rows.push_back(std::move(row));
  }
  plot.series = std::move(series);
  chapter.claims.push_back(
      claim("About 1000 vertices with edges and bending run at 60 steps a second with 5 iterations", "thesis, Sec. 6.5",
            thesis_rate > 60,
            fmt::format("{} vertices: {:.0f} steps a second, {:.0f} times as many, on this machine",
                        thesis_side * thesis_side, thesis_rate, thesis_rate / 60)));
  chapter.blocks.emplace_back(std::move(plot));
  chapter.blocks.emplace_back(std::move(table));
  return chapter;
}

}  // namespace pliant_experiments
