// The figures of a run, from its files, also when these are cut, missing or of something else.
#include <string>

#include <doctest/doctest.h>

#include "sweep/measurement_table.h"
#include "sweep/run_result.h"
#include "tests/support/temporary_folder.h"

namespace test_run_result {

namespace {

using namespace pliant_sweep;
using pliant_tests::TemporaryFolder;

constexpr std::string_view measurements =
    "step,time,kinetic,elastic_a,\"elastic_b,\"\"c\n\",total,speed_sum,residual,iterations,ms_total\n"
    "0,0,1,2,30,9,1,7,0,0\n"
    "1,0.1,2,3,40,5,2,1,4,10\n"
    "2,0.2,5,4,50,-8,4,3,8,20\n"
    "3,0.3,4,1,60,3,8,2,6,60\n";

std::string run_json(const std::string& outcome, int steps) {
  return R"({"outcome": ")" + outcome + R"(", "error": "why", "output": {"every": 1}, "totals": {"steps": )" +
         std::to_string(steps) + R"(, "wall_seconds": 1.5}})";
}

RunResult result_of(const std::string& json, std::string_view csv) {
  const TemporaryFolder folder;
  folder.write("run.json", json);
  folder.write("measurements.csv", csv);
  return read_run_result(folder.path());
}

TEST_CASE("a table is read as far as its rows are whole") {
  const MeasurementTable table = parse_measurements(measurements);
  REQUIRE(table.is_whole);
  CHECK(table.row_count() == 4);
  CHECK(table.names[4] == "elastic_b,\"c\n");
  CHECK(table.elastic() == std::vector<double>{32, 43, 54, 61});
  CHECK(table.find("nothing") == nullptr);
  const std::size_t names_end = measurements.find("0,0,1");
  for (std::size_t size = 0; size < measurements.size(); ++size) {
    CAPTURE(size);
    const MeasurementTable cut = parse_measurements(measurements.substr(0, size));
    const bool is_at_line_end = size >= names_end && measurements[size - 1] == '\n';
    CHECK(cut.is_whole == is_at_line_end);
    CHECK(cut.row_count() < 4);
    for (const auto& column : cut.columns) CHECK(column.size() == cut.row_count());
  }
  CHECK(!parse_measurements("a,b\n1,2\n1,2,3\n").is_whole);
  CHECK(!parse_measurements("a,b\n1\n").is_whole);
  CHECK(!parse_measurements("a,b\n1,x\n").is_whole);
  CHECK(!parse_measurements("a,b\n1, 2\n").is_whole);
}

TEST_CASE("the figures of a run") {
  const RunResult result = result_of(run_json("ok", 3), measurements);
  REQUIRE(result.outcome == RunOutcome::ok);
  CHECK(result.steps_done == 3);
  const auto figure = [&](std::string_view name) { return result.figure(figure_index(name)); };
  CHECK(figure("kinetic_end") == 4.0);
  CHECK(figure("kinetic_mean") == 3.0);
  CHECK(figure("kinetic_max") == 5.0);
  CHECK(figure("elastic_max") == 61.0);
  CHECK(figure("total_max") == 9.0);
  CHECK(figure("residual_max") == 3.0);  // not that of the start
  CHECK(figure("iterations_mean") == 6.0);
  CHECK(figure("ms_total") == 30.0);
  CHECK(figure("speed_sum_late") == 6.0);  // from 0.2 s on
  CHECK(figure("time_end") == 0.3);
  CHECK(figure("wall_seconds") == 1.5);
  CHECK(!figure("momentum_end"));
  CHECK_THROWS_AS(figure_index("nothing"), std::logic_error);
}

TEST_CASE("the figures of contact of a run with colliders, without the start, which is no step") {
  const RunResult result = result_of(run_json("ok", 3),
                                     "step,time,contacts,deepest,friction_power,held_back,backtracks,refactorizations\n"
                                     "0,0,0,0,0,0,0,0\n"
                                     "1,0.1,7,0.25,1,1,3,1\n"
                                     "2,0.2,9,0.5,1,1,2,0\n"
                                     "3,0.3,5,0.125,1,1,1,1\n");
  const auto figure = [&](std::string_view name) { return result.figure(figure_index(name)).value_or(-1); };
  CHECK(figure("contacts_end") == 5);
  CHECK(figure("contacts_mean") == 7);
  CHECK(figure("deepest_max") == 0.5);
  CHECK(figure("deepest_end") == 0.125);
  CHECK(figure("backtracks_mean") == 2);
  CHECK(figure("refactorizations_mean") == doctest::Approx(2.0 / 3));
  CHECK(figure("refactorizations_max") == 1);
  const RunResult without = result_of(run_json("ok", 3), measurements);
  CHECK(without.figure(figure_index("iterations_mean")).has_value());
  CHECK_FALSE(without.figure(figure_index("contacts_end")).has_value());
  for (const std::string_view name : {"deepest_max", "backtracks_mean", "refactorizations_mean"}) {
    const std::string label = figure_infos()[figure_index(name)].label;
    CHECK(label.ends_with(name.starts_with("deepest") ? " [m]" : " [a step]"));
  }
}

TEST_CASE("the figures of surfaces: the smallest gap of all steps in which one was known") {
  const auto figures_of = [](const std::string& gaps_3_and_4) {
    return result_of(run_json("ok", 3),
                     "step,time,pairs,active,smallest_gap,shortened\n"
                     "0,0,0,0,inf,0\n"
                     "1,0.1,4,1,inf,2\n" +
                         gaps_3_and_4);
  };
  const auto figure = [](const RunResult& result, std::string_view name) { return result.figure(figure_index(name)); };
  const RunResult result = figures_of("2,0.2,8,3,0.25,0\n3,0.3,0,0,0.5,1\n");
  CHECK(figure(result, "pairs_mean") == 4.0);
  CHECK(figure(result, "active_max") == 3.0);
  CHECK(figure(result, "shortened_mean") == 1.0);
  CHECK(figure(result, "smallest_gap_min") == 0.25);
  CHECK_FALSE(figure(figures_of("2,0.2,8,3,inf,0\n3,0.3,0,0,inf,1\n"), "smallest_gap_min").has_value());
}

TEST_CASE("a run without steps has a state, and no step") {
  const std::string_view start = measurements.substr(0, measurements.find("1,0.1"));
  const RunResult result = result_of(run_json("ok", 0), start);
  REQUIRE(result.outcome == RunOutcome::ok);
  CHECK(result.figure(figure_index("kinetic_end")) == 1.0);
  CHECK(result.figure(figure_index("speed_sum_late")) == 1.0);
  CHECK(!result.figure(figure_index("iterations_mean")));
}

TEST_CASE("what is not whole has not ended") {
  const std::string_view text = measurements;
  CHECK(result_of(run_json("running", 3), text).outcome == RunOutcome::waiting);
  CHECK(result_of(run_json("interrupted", 3), text).outcome == RunOutcome::waiting);
  CHECK(result_of(run_json("ok", 4), text).outcome == RunOutcome::waiting);
  CHECK(result_of(run_json("ok", 3), text.substr(0, text.size() - 1)).outcome == RunOutcome::waiting);
  CHECK(result_of(run_json("ok", 3), "").outcome == RunOutcome::waiting);
  for (const char* json :
       {"", "{", "[]", "{}", "3", R"({"outcome": 3})", R"({"outcome": "ok"})", R"({"outcome": "ok", "totals": []})"}) {
    CAPTURE(json);
    CHECK(result_of(json, text).outcome == RunOutcome::waiting);
  }
  // Numbers of steps that are none, the largest of which would overflow.
  for (const char* steps : {"9223372036854775807", "9007199254740993", "-1", "3.0", "1e300", "null"}) {
    CAPTURE(steps);
    const std::string json = R"({"outcome": "ok", "output": {"every": 1}, "totals": {"steps": )";
    CHECK(result_of(json + steps + R"(, "wall_seconds": 1.5}})", text).outcome == RunOutcome::waiting);
  }
  for (const char* every : {"0", "-1", "1.0", "1e300", "9223372036854775808"}) {
    CAPTURE(every);
    const std::string json = R"({"outcome": "ok", "totals": {"steps": 3, "wall_seconds": 1.5}, "output": {"every": )";
    CHECK(result_of(json + every + "}}", text).outcome == RunOutcome::waiting);
  }
  CHECK(read_run_result("/nonexistent").outcome == RunOutcome::waiting);
  // It may diverge while its last step is measured.
  CHECK(result_of(run_json("diverged", 4), text).outcome == RunOutcome::diverged);
  CHECK(result_of(run_json("diverged", 5), text).outcome == RunOutcome::waiting);
  CHECK(result_of(run_json("diverged", 3), text).message == "why");
}

TEST_CASE("a result is forgotten, and nothing else of its run") {
  const TemporaryFolder folder;
  CHECK_NOTHROW(forget_run_result(folder.path()));
  CHECK(folder.file_count() == 0);
  const auto info = folder.write("run.json", run_json("ok", 3));
  const auto table = folder.write("measurements.csv", measurements);
  REQUIRE(read_run_result(folder.path()).outcome == RunOutcome::ok);
  forget_run_result(folder.path());
  CHECK(read_run_result(folder.path()).outcome == RunOutcome::waiting);
  CHECK(TemporaryFolder::read(info).find("\"outcome\": \"interrupted\"") != std::string::npos);
  CHECK(TemporaryFolder::read(table) == measurements);
}

TEST_CASE("a result that is cut is forgotten, and a whole one is kept") {
  const TemporaryFolder folder;
  const auto info = folder.write("run.json", run_json("ok", 3));
  const auto table = folder.write("measurements.csv", measurements);
  forget_cut_result(folder.path());
  CHECK(TemporaryFolder::read(info) == run_json("ok", 3));
  folder.write("measurements.csv", std::string_view(measurements).substr(0, 20));
  forget_cut_result(folder.path());
  CHECK(TemporaryFolder::read(info).find("\"outcome\": \"interrupted\"") != std::string::npos);
  for (const char* text : {"", "{", "[]", R"({"outcome": 3})", R"({"outcome": "running"})"}) {
    folder.write("run.json", text);
    forget_cut_result(folder.path());
    CHECK(TemporaryFolder::read(info) == text);
  }
}

TEST_CASE("a run that did not end by itself says why") {
  const TemporaryFolder folder;
  const auto log = folder.write("log", "warning: x\npliant: error: the disk\x1b is full\n");
  RunResult result = result_of_ended_run(folder.path(), {4, 0}, log);
  CHECK(result.outcome == RunOutcome::failed);
  CHECK(result.exit_code == 4);
  CHECK(result.message == "the disk  is full");
  result = result_of_ended_run(folder.path(), {0, 9}, folder.path() / "none");
  CHECK(result.message.starts_with("ended by signal 9"));
  CHECK(result_of_ended_run(folder.path(), {4, 0}, folder.path() / "none").message.find("make room") !=
        std::string::npos);  // a full disk has no place for messages either
  folder.write("run.json", run_json("ok", 3));
  folder.write("measurements.csv", measurements);
  CHECK(result_of_ended_run(folder.path(), {0, 0}, log).outcome == RunOutcome::ok);
  CHECK(result_of_ended_run(folder.path(), {2, 0}, log).outcome == RunOutcome::failed);  // the files are older
  CHECK(result_of_ended_run(folder.path(), {0, 9}, log).outcome == RunOutcome::failed);
  folder.write("measurements.csv", "");
  CHECK(result_of_ended_run(folder.path(), {0, 0}, log).message.find("not whole") != std::string::npos);
}

}  // namespace

}  // namespace test_run_result
