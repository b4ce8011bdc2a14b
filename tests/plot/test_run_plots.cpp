// Measurements over time: which columns go into which plot, and that thinning loses no peak.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant/core/error.h"
#include "plot/column_info.h"
#include "plot/run_plots.h"

namespace test_run_plots {

using namespace pliant_plot;
using pliant_report::Plot;

namespace {

MeasuredRun run_of(const std::string& name, const std::string& text) {
  return {name, pliant_sweep::parse_measurements(text)};
}

const char* const head = "step,time,kinetic,elastic_links,elastic_bend,total,iterations,residual,ms_total,contacts\n";

/// Ten steps; `links` is the elastic energy of one of two groups.
MeasuredRun small_run(const std::string& name, double links = 1) {
  std::string text = head;
  for (int i = 0; i <= 10; ++i) {
    text += fmt::format("{},{},{},{},2,{},20,{},{},0\n", i, 0.1 * i, i, links, i + links + 2,
                        i == 0 ? 0.0 : std::pow(10.0, -i), i == 0 ? 0.0 : 1.5);
  }
  return run_of(name, text);
}

std::vector<std::string> titles(const std::vector<Plot>& plots) {
  std::vector<std::string> result;
  for (const Plot& plot : plots) result.push_back(plot.title);
  return result;
}

std::string message_of(const std::vector<MeasuredRun>& runs, const PlotChoice& choice) {
  try {
    run_plots(runs, choice);
  } catch (const pliant::Error& error) {
    return error.what();
  }
  return "(no error)";
}

TEST_CASE("the usual plots of a run are those in which anything happens") {
  const std::vector<Plot> plots = run_plots({small_run("run")}, {});
  CHECK(titles(plots) == std::vector<std::string>{"Energy", "Elastic energy by group", "What the last iteration leaves",
                                                  "Time of a step"});
  const Plot& energy = plots[0];
  REQUIRE(energy.series.size() == 3);
  CHECK(energy.series[0].name == "kinetic energy");
  CHECK(energy.series[1].name == "elastic energy");
  CHECK(energy.series[1].y == std::vector<double>(11, 3));  // of both groups
  CHECK(energy.series[2].name == "total energy");
  CHECK(energy.y.label == "energy [J]");
  CHECK(energy.x.label == "time [s]");
  CHECK_FALSE(energy.y.is_logarithmic);
  CHECK(plots[1].series[0].name == "elastic energy of links");
  CHECK(plots[2].y.is_logarithmic);
  CHECK(plots[2].y.label == "largest force left on a vertex [N]");
  CHECK(plots[2].series[0].x.size() == 10);  // the start has had no step
  CHECK(plots[2].series[0].x[0] == doctest::Approx(0.1));
}

TEST_CASE("columns that are asked for are drawn, those of one unit together") {
  const std::vector<Plot> plots =
      run_plots({small_run("run")}, {.columns = {"contacts", "kinetic", "total"}, .is_logarithmic = true, .to = 0.45});
  REQUIRE(plots.size() == 2);
  CHECK(plots[0].series[0].y == std::vector<double>{0, 0, 0, 0});
  CHECK(plots[0].y.label == "contacts with colliders and surfaces");
  CHECK(plots[1].title == "Kinetic energy, total energy");
  CHECK(plots[1].y.label == "value [J]");
  CHECK(plots[1].series[0].y == std::vector<double>{0, 1, 2, 3, 4});
  CHECK(plots[1].y.is_logarithmic);
}

TEST_CASE("of several runs every column has a plot, with a line for each run") {
  const std::vector<Plot> plots = run_plots({small_run("soft"), small_run("stiff", 5)}, {.columns = {"total"}});
  REQUIRE(plots.size() == 1);
  CHECK(plots[0].title == "Total energy");
  REQUIRE(plots[0].series.size() == 2);
  CHECK(plots[0].series[0].name == "soft");
  CHECK(plots[0].series[1].name == "stiff");
  CHECK(plots[0].series[0].y[0] == 3);
  CHECK(plots[0].series[1].y[0] == 7);
  CHECK(plots[0].series[1].color == 1);

  const MeasuredRun other = run_of("other", "step,time,lag\n0,0,0\n1,0.5,0.25\n");
  const std::vector<Plot> mixed = run_plots({small_run("soft"), other}, {});
  const auto lag = std::ranges::find(mixed, "Lag of pinned vertices", &Plot::title);
  REQUIRE(lag != mixed.end());
  REQUIRE(lag->series.size() == 1);
  CHECK(lag->series[0].name == "other");
}

TEST_CASE("long runs are thinned to the least and the largest of each span") {
  std::string text = "step,time,speed_sum\n";
  for (int i = 0; i < 50'000; ++i) text += fmt::format("{},{},{}\n", i, 0.01 * i, i == 31'415 ? 9 : i == 2718 ? -4 : 1);
  const std::vector<Plot> plots = run_plots({run_of("long", text)}, {});
  REQUIRE(plots.size() == 1);
  const pliant_report::Series& line = plots[0].series[0];
  CHECK(line.x.size() <= 1200);
  CHECK(std::ranges::is_sorted(line.x));
  const auto peak = std::ranges::find(line.y, 9.0);
  REQUIRE(peak != line.y.end());
  CHECK(line.x[static_cast<std::size_t>(peak - line.y.begin())] == doctest::Approx(314.15));
  CHECK(std::ranges::count(line.y, -4.0) == 1);
  CHECK(plots[0].caption.starts_with("The least and the largest value of each 83"));
}

TEST_CASE("many colliders go into several plots") {
  std::string text = "step,time", row;
  for (int i = 0; i < 6; ++i) {
    text += fmt::format(",force_x_ball{0},force_z_ball{0}", i);
    row += ",1,2";
  }
  const std::vector<Plot> plots = run_plots({run_of("balls", text + "\n0,0" + row + "\n1,1" + row + "\n")}, {});
  REQUIRE(plots.size() == 2);
  CHECK(plots[0].title == "Forces on colliders (1 of 2)");
  CHECK(plots[0].series.size() == 8);
  CHECK(plots[1].series.size() == 4);
  CHECK(plots[1].series[3].name == "force on ball5 along z");
}

TEST_CASE("of long runs every peak is drawn, whatever is not a number beside it, or all records") {
  std::string text = "step,time,smallest_gap\n";
  double most = 0, least = 1e9;
  for (int i = 0; i < 6000; ++i) {
    const double value = 1 + (i * 7919 % 1000) * 1e-3;
    const bool is_known = i % 10 < 2 && i / 100 % 7 != 3;
    if (is_known) most = std::max(most, value), least = std::min(least, value);
    text += std::to_string(i) + "," + std::to_string(i / 60.0) + "," +
            (is_known     ? std::to_string(value)
             : i % 3 == 0 ? "nan"
                          : "inf") +
            "\n";
  }
  const std::vector<Plot> plots = run_plots({run_of("long", text)}, {.columns = {"smallest_gap"}});
  REQUIRE(plots.size() == 1);
  const std::vector<double>& y = plots[0].series.at(0).y;
  CHECK(y.size() <= 1200);
  double drawn_most = 0, drawn_least = 1e9;
  std::size_t numbers = 0;
  for (const double value : y) {
    if (!std::isfinite(value)) continue;
    ++numbers;
    drawn_most = std::max(drawn_most, value);
    drawn_least = std::min(drawn_least, value);
  }
  CHECK(drawn_most == doctest::Approx(most));
  CHECK(drawn_least == doctest::Approx(least));
  CHECK(numbers > 1000);      // all spans in which there is one
  CHECK(numbers < y.size());  // and a gap in each of the others
  const std::vector<Plot> all = run_plots({run_of("long", text)}, {.columns = {"smallest_gap"}, .is_thinned = false});
  CHECK(all[0].series.at(0).y.size() >= 5999);
}

TEST_CASE("what cannot be drawn is refused") {
  CHECK(message_of({small_run("run")}, {.columns = {"totl"}}) ==
        "--columns: unknown column 'totl'; did you mean 'total'? (known: step, time, kinetic, elastic_links, "
        "elastic_bend, total, iterations, residual, ...)");
  CHECK(message_of({small_run("run")}, {.from = 2}) ==
        "--from, --to: nothing was measured then; the records are from 0 to 1 s");
  CHECK(message_of({small_run("run")}, {.columns = {"total", ""}}) ==
        "--columns: a name is empty; separate names by single commas");
  CHECK(message_of({small_run("run")}, {.from = 1, .to = 0.5}) == "--from: it is later than --to; exchange the two");
  CHECK(message_of({run_of("empty", "step,time,total\n")}, {}) == "nothing was measured yet");
}

TEST_CASE("columns of groups and colliders have these in their labels, and what is not known is its own") {
  CHECK(column_info("force_x_the ball").label == "force on the ball along x");
  CHECK(column_info("something_else").label == "something_else");
  CHECK(column_info("past_limits").unit.empty());
  CHECK(with_unit("time", "s") == "time [s]");
}

}  // namespace

}  // namespace test_run_plots
