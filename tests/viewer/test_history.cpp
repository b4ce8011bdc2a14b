// What the window records for its plots: the numbers of measurements.csv, of a bounded number of steps.
#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "pliant_io/recorder/recorder.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "tests/support/temporary_folder.h"
#include "viewer/history.h"
#include "viewer/live_source.h"

namespace test_history {

using namespace pliant_viewer;
using pliant::Scene;
using pliant_sweep::MeasurementTable;
using pliant_tests::TemporaryFolder;

namespace {

constexpr Measuring everything = {.energies = true, .past_limits = true};

/// A sheet that falls onto a ball and onto itself; a group comes at step 4, another goes at step 6.
Scene make_scene() {
  return pliant::parse_scene(R"({
    "pliant": 1,
    "settings": { "iterations": 6, "threads": 1 },
    "bodies": [ {
      "name": "sheet",
      "mesh": { "shape": "grid", "columns": 9, "rows": 9, "plane": "xy" },
      "mass": { "area_density": 0.3 },
      "constraints": [ { "type": "triangle_strain", "name": "stretch", "stiffness": 500 },
                       { "type": "hinge", "name": "bend", "stiffness": 1e-3 } ]
    } ],
    "contact": { "surfaces": true },
    "colliders": [ { "type": "sphere", "name": "ball, red", "center": [0.5, 0.5, -0.22], "radius": 0.2 } ],
    "events": [ { "step": 4, "add": { "type": "edge_spring", "name": "later", "body": "sheet", "stiffness": 50 } },
                { "step": 6, "remove": "bend" } ]
  })",
                             {}, "sheet");
}

/// The file that a run of so many steps writes.
MeasurementTable recorded(int steps) {
  const TemporaryFolder folder;
  Scene scene = make_scene();
  pliant::Recorder recorder(folder.path(), nullptr, 1, scene.group_names, 0,
                            pliant::ContactColumns{scene.collider_names, scene.has_surfaces});
  recorder.record(scene.simulation, {});
  for (int i = 0; i < steps; ++i) recorder.record(scene.simulation, scene.step());
  return pliant_sweep::read_measurements(folder.path() / "measurements.csv");
}

void check_same_but_times(const MeasurementTable& is, const MeasurementTable& should_be) {
  REQUIRE(is.names == should_be.names);
  for (std::size_t i = 0; i < is.names.size(); ++i) {
    CAPTURE(is.names[i]);
    if (is.names[i].starts_with("ms_")) {
      CHECK(is.columns[i].size() == should_be.columns[i].size());
    } else {
      CHECK(is.columns[i] == should_be.columns[i]);
    }
  }
}

using Names = std::shared_ptr<const std::vector<std::string>>;

Names names(std::vector<std::string> columns) {
  return std::make_shared<const std::vector<std::string>>(std::move(columns));
}

void take_step(LiveSource& source) {
  const std::int64_t next = source.snapshot().step + 1;
  source.step(1);
  while (source.snapshot().step < next) source.refresh(Clock::now());
}

const std::vector<double>& steps_of(const LiveSource& source) {
  return *source.measured()->table.find("step");
}

}  // namespace

TEST_CASE("what is recorded, and saved as CSV, is what a run of the scene has in measurements.csv") {
  const MeasurementTable file = recorded(12);
  CHECK(*std::ranges::max_element(*file.find("contacts")) > 0);
  CHECK(*std::ranges::max_element(*file.find("elastic_later")) > 0);
  Scene scene = make_scene();
  StepMeasurer measurer;
  History history("sheet");
  history.add(measurer.measure_start(scene).value());
  for (int i = 0; i < 12; ++i) {
    history.add(measurer.measure_step(scene, scene.step(), everything).value());
  }
  check_same_but_times(history.run().table, file);
  const MeasurementTable read = pliant_sweep::parse_measurements(to_csv(history.run().table));
  CHECK(read.is_whole);
  CHECK(read.names == history.run().table.names);
  CHECK(read.columns == history.run().table.columns);
}

TEST_CASE("the simulation's thread hands over every step, whatever is changed in between") {
  LiveSource source(make_scene, 1, false, [] {});
  CHECK(steps_of(source) == std::vector<double>{0});  // the start
  source.measure(everything);
  for (int i = 0; i < 12; ++i) take_step(source);
  check_same_but_times(source.measured()->table, recorded(12));
  // Another material, and taking it back, make the scene anew.
  source.live()->post([](CommandContext& context) { context.session.set_material("sheet", "wool"); });
  take_step(source);
  source.live()->post([](CommandContext& context) { context.session.undo(); });
  source.live()->post([](CommandContext& context) { context.session.pin(40); });
  take_step(source);
  CHECK(steps_of(source).size() == 15);
  CHECK(steps_of(source).back() == 14);
  CHECK(source.measured()->table.find("elastic_sheet.warp") != nullptr);
  CHECK(source.measured()->table.find("elastic_pinned by hand") == nullptr);  // holds no energy
  for (const std::vector<double>& column : source.measured()->table.columns) CHECK(column.size() == 15);
  // A restart begins another curve.
  source.restart(false);
  while (source.restarts() == 0) source.refresh(Clock::now());
  CHECK(steps_of(source) == std::vector<double>{0});
  for (int i = 0; i < 12; ++i) take_step(source);
  check_same_but_times(source.measured()->table, recorded(12));
}

TEST_CASE("measuring changes nothing of what is simulated") {
  for (const char* name : {"crate_on_cloth", "towel", "dress"}) {
    CAPTURE(name);
    const auto make = [&] {
      const auto scenes = pliant::builtin_scenes();
      const auto found = std::ranges::find(scenes, std::string_view(name), &pliant::BuiltinScene::name);
      return pliant::parse_scene(found->text, {}, name, {.set = {"settings.threads=1"}});
    };
    Scene measured = make(), plain = make();
    StepMeasurer measurer;
    measurer.measure_start(measured);
    for (int i = 0; i < 6; ++i) {
      measurer.measure_step(measured, measured.step(), i == 2 ? Measuring{} : everything);
      plain.step();
    }
    CHECK(measured.simulation.state().positions == plain.simulation.state().positions);
    CHECK(measured.simulation.state().velocities == plain.simulation.state().velocities);
  }
}

TEST_CASE("without energies nearly all steps are measured without a local step") {
  Scene scene = make_scene();
  StepMeasurer measurer;
  measurer.measure_start(scene);
  pliant::StepReport report = scene.step();
  report.seconds_total = 0;  // so that none may cost anything
  const MeasuredStep first = measurer.measure_step(scene, report, Measuring{}).value();
  const MeasuredStep second = measurer.measure_step(scene, report, Measuring{}).value();
  REQUIRE(second.names == first.names);
  for (std::size_t i = 0; i < first.values.size(); ++i) {
    CAPTURE((*first.names)[i]);
    CHECK_FALSE(std::isnan(first.values[i]));
    const bool is_there = (*first.names)[i] != "elastic_later";  // from step 4 on
    CHECK(std::isnan(second.values[i]) == (is_there && pliant::takes_local_step((*first.names)[i])));
    if (!std::isnan(second.values[i])) CHECK(second.values[i] == first.values[i]);
  }
  const auto value = [&](const Measuring& measuring, const char* name) {
    const MeasuredStep step = measurer.measure_step(scene, report, measuring).value();
    return step.values[static_cast<std::size_t>(std::ranges::find(*step.names, name) - step.names->begin())];
  };
  CHECK(std::isfinite(value({.energies = true}, "residual")));
  CHECK(std::isnan(value({.energies = true}, "past_limits")));
  CHECK(std::isfinite(value({.past_limits = true}, "past_limits")));
  report.seconds_total = 3600;  // small shares of it are enough
  CHECK(std::isfinite(value({}, "past_limits")));
  CHECK(std::isfinite(value({}, "total")));
}

TEST_CASE("rows are of a bounded number, the newest of them all there, the older ones evenly spread") {
  constexpr std::size_t capacity = 512, recent = 128;
  History history("sheet", capacity, recent);
  const Names columns = names({"step", "time", "speed_sum"});
  constexpr int count = 100'000;
  for (int i = 0; i < count; ++i) {
    const double step = 7 + i;  // goes on from a checkpoint
    history.add({columns, {step, step / 64, std::sin(step)}, i == 0});
    REQUIRE(history.run().table.row_count() < capacity);
  }
  const MeasurementTable& table = history.run().table;
  const std::vector<double>& steps = *table.find("step");
  CHECK(table.row_count() >= capacity / 4);
  CHECK(steps.front() == 7);
  CHECK(steps.back() == 7 + count - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    REQUIRE((*table.find("time"))[i] == steps[i] / 64);
    REQUIRE((*table.find("speed_sum"))[i] == std::sin(steps[i]));
    if (i + recent >= steps.size()) CHECK(steps[i] == 7 + count - static_cast<double>(steps.size() - i));
  }
  // No gap is larger than one stride, a power of two.
  double widest = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    REQUIRE(steps[i] > steps[i - 1]);
    widest = std::max(widest, steps[i] - steps[i - 1]);
  }
  CHECK(widest <= 4.0 * count / (capacity - recent));
  CHECK(std::exp2(std::round(std::log2(widest))) == widest);
}

TEST_CASE("columns that come later have zeros before, and each of several of one name its own") {
  History history("sheet");
  history.add({names({"step", "time", "elastic_a", "total"}), {0, 0, 1, 2}, true});
  history.add({names({"step", "time", "elastic_a", "elastic_a", "total"}), {1, 0.5, 3, 4, 5}});
  const MeasurementTable& table = history.run().table;
  CHECK(table.names == std::vector<std::string>{"step", "time", "elastic_a", "elastic_a", "total"});
  CHECK(table.columns == std::vector<std::vector<double>>{{0, 1}, {0, 0.5}, {1, 3}, {0, 4}, {2, 5}});
  history.add({names({"step", "time"}), {0, 0}, true});
  CHECK(history.run().table.names == std::vector<std::string>{"step", "time"});
  CHECK(history.run().table.row_count() == 1);
}

TEST_CASE("a window that takes no snapshots loses every second step, but no start") {
  std::vector<MeasuredStep> waiting;
  const Names columns = names({"step"});
  for (int i = 0; i < 8; ++i) waiting.push_back({columns, {static_cast<double>(i)}, i == 5});
  leave_out_every_second(waiting);
  std::vector<double> left;
  for (const MeasuredStep& step : waiting) left.push_back(step.values[0]);
  CHECK(left == std::vector<double>{0, 2, 4, 5, 6});
}

}  // namespace test_history
