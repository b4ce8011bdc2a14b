// What is drawn of a sweep: over which values, in how many series and plots.
#include <cmath>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "sweep/sweep_report.h"
#include "tests/support/temporary_folder.h"

namespace test_sweep_plots {

namespace {

using namespace pliant_sweep;
using pliant_tests::TemporaryFolder;

/// A sweep whose final total energy is f of the values of each run, all other figures being the same.
SweepPlan plan_with(std::vector<Variation> variations, auto&& f) {
  SweepPlan plan;
  plan.setup.scene = "scene.json";
  plan.setup.variations = std::move(variations);
  for (const Combination& values : product_of(plan.setup.variations)) {
    SweepRun run{values, fmt::format("{:04}", plan.runs.size() + 1)};
    run.result.outcome = RunOutcome::ok;
    run.result.figures.assign(figure_infos().size(), 1.0);
    run.result.figures[figure_index("total_end")] = f(values);
    plan.runs.push_back(std::move(run));
  }
  return plan;
}

std::vector<std::string> names_of(const std::vector<NamedPlot>& plots) {
  std::vector<std::string> names;
  names.reserve(plots.size());
  for (const NamedPlot& plot : plots) names.push_back(plot.name);
  return names;
}

std::vector<std::string> numbers(int count) {
  std::vector<std::string> texts;
  texts.reserve(static_cast<std::size_t>(count));
  for (int i = 1; i <= count; ++i) texts.push_back(std::to_string(i));
  return texts;
}

double number(const std::string& text) {
  return number_of(text).value();
}

TEST_CASE("the first variation of numbers is the axis, the others are series") {
  const std::vector<Variation> variations = {{"v", {"[0,1]", "[0,2]"}}, {"a.k", {"3", "1", "2"}}, {"b.k", {"5", "6"}}};
  CHECK(find_axis(variations) == 1);
  CHECK(find_axis({{"v", {"a", "b"}}}) == 1);
  CHECK(find_axis({{"v", {"1"}}, {"w", {"1", "1.0"}}}) == 2);
  const auto plots = figure_plots(
      plan_with(variations, [](const Combination& values) { return 10 * number(values[2]) + number(values[1]); }));
  REQUIRE(names_of(plots) == std::vector<std::string>{"total_end"});  // the others are constant
  const pliant_report::Plot& plot = plots[0].plot;
  CHECK(plot.x.label == "a.k");
  CHECK(!plot.x.is_logarithmic);
  REQUIRE(plot.series.size() == 4);
  CHECK(plot.series[0].name == "v=[0,1], b.k=5");
  CHECK(plot.series[3].name == "v=[0,2], b.k=6");
  CHECK(plot.series[1].x == std::vector<double>{1, 2, 3});
  CHECK(plot.series[1].y == std::vector<double>{61, 62, 63});
}

TEST_CASE("wide ranges of positive values have logarithmic axes") {
  const auto plot_of = [](const std::string& values, double power) {
    const auto plan = plan_with({read_variation("a=" + values)}, [power](const Combination& combination) {
      return std::pow(number(combination[0]), power);
    });
    return figure_plots(plan).at(0).plot;
  };
  CHECK(plot_of("1,31", 1).x.is_logarithmic);
  CHECK(!plot_of("1,29", 1).x.is_logarithmic);
  CHECK(!plot_of("0,100", 1).x.is_logarithmic);
  CHECK(plot_of("1,31", 2).y.is_logarithmic);
  CHECK(!plot_of("1,31", 1).y.is_logarithmic);
  CHECK(plot_of("1,31", 1).series.at(0).name.empty());
}

TEST_CASE("more series are more plots with the same axis, and then none") {
  const auto plots_of = [](int series) {
    return figure_plots(plan_with({{"a", {"1", "2"}}, {"b", numbers(series)}},
                                  [](const Combination& values) { return number(values[0]) - number(values[1]); }));
  };
  CHECK(names_of(plots_of(8)) == std::vector<std::string>{"total_end"});
  const auto plots = plots_of(20);
  REQUIRE(names_of(plots) == std::vector<std::string>{"total_end", "total_end-2", "total_end-3"});
  CHECK(plots[0].plot.series.size() == 8);
  CHECK(plots[2].plot.series.size() == 4);
  CHECK(plots[2].plot.series[3].name == "b=20");
  CHECK(plots[0].plot.y.min == plots[2].plot.y.min);
  CHECK(plots[0].plot.y.min.value() < 1 - 20);
  CHECK(plots[0].plot.y.max.value() > 2 - 1);
  CHECK(plots_of(32).size() == 4);
  CHECK(plots_of(33).empty());
}

TEST_CASE("runs that did not end well are left out, and counted") {
  SweepPlan plan = plan_with({{"a", numbers(4)}}, [](const Combination& values) { return number(values[0]); });
  plan.runs[1].result.outcome = RunOutcome::diverged;
  plan.runs[1].result.figures[figure_index("total_end")] = 1e300;
  plan.runs[3].result = {RunOutcome::failed};
  const auto plots = figure_plots(plan);
  REQUIRE(plots.size() == 1);
  CHECK(plots[0].plot.series[0].x == std::vector<double>{1, 3});
  CHECK(plots[0].plot.caption.find("2 of 4 runs did not end well") != std::string::npos);
  for (SweepRun& run : plan.runs) run.result = {};
  CHECK(figure_plots(plan).empty());
}

TEST_CASE("a few runs are drawn over time, thinned") {
  const TemporaryFolder folder;
  SweepPlan plan = plan_with({{"a", numbers(2)}}, [](const Combination&) { return 1.0; });
  std::string text = "step,time,total,speed_sum\n";
  for (int i = 0; i < 2500; ++i) text += fmt::format("{},{},{},{}\n", i, i, 2 * i, 3 * i);
  std::filesystem::create_directories(run_folder(folder.path(), "0001"));
  folder.write("runs/0001/measurements.csv", text);
  const auto plots = time_plots(folder.path(), plan);  // the other's file is missing
  REQUIRE(names_of(plots) == std::vector<std::string>{"energy_over_time", "speed_over_time"});
  REQUIRE(plots[1].plot.series.size() == 1);
  CHECK(plots[1].plot.series[0].name == "a=1");
  CHECK(plots[1].plot.series[0].x.size() == 834);
  CHECK(plots[1].plot.series[0].y[2] == 18);
  CHECK(time_plots(folder.path(), plan_with({{"a", numbers(9)}}, [](const Combination&) { return 1.0; })).empty());
}

TEST_CASE("plots of an earlier start that are drawn no more are removed, other files are not") {
  const TemporaryFolder folder;
  write_sweep_report(folder.path(), plan_with({{"a", {"1", "2"}}, {"b", numbers(9)}}, [](const Combination& values) {
                       return number(values[0]) * number(values[1]);
                     }));
  const auto exists = [&](const char* name) { return std::filesystem::exists(folder.path() / "plots" / name); };
  CHECK(exists("total_end.svg"));
  CHECK(exists("total_end-2.svg"));
  folder.write("plots/mine.svg", "x");
  write_sweep_report(folder.path(),
                     plan_with({{"<a>", {"1", "2"}}}, [](const Combination& values) { return number(values[0]); }));
  CHECK(exists("total_end.svg"));
  CHECK(!exists("total_end-2.svg"));
  CHECK(exists("mine.svg"));
  const std::string page = TemporaryFolder::read(folder.path() / "index.html");
  CHECK(page.find("<svg") != std::string::npos);
  CHECK(page.find("&lt;a&gt;") != std::string::npos);
  CHECK(page.find("<a>") == std::string::npos);
}

}  // namespace

}  // namespace test_sweep_plots
