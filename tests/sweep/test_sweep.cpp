// The runs of a sweep, here made by shell scripts in the place of the program.
#include <algorithm>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant/core/error.h"
#include "sweep/sweep.h"
#include "system/folder_lock.h"
#include "tests/support/temporary_folder.h"

namespace test_sweep {

namespace {

using namespace pliant_sweep;
using pliant_system::FolderLock;
using pliant_tests::TemporaryFolder;
namespace fs = std::filesystem;

/// Runs of these values, by a program that finds the value in $value and its folder in $out.
class Rig {
 public:
  Rig(std::vector<std::string> values, const std::string& script) {
    plan.setup.scene = "scene.json";
    plan.setup.variations = {{"x", values}};
    for (std::size_t i = 0; i < values.size(); ++i) plan.runs.push_back({{values[i]}, "000" + std::to_string(i)});
    fs::create_directory(folder.path() / "runs");
    program =
        folder.write("program",
                     "#!/bin/sh\n"
                     "for word in \"$@\"; do case $word in\n"
                     "--out=*) out=${word#--out=};; --set=x=*) value=${word#--set=x=};; esac; done\n"
                     "end() { mkdir -p $out; printf 'step,time,total\\n0,0,%s\\n' $value > $out/measurements.csv\n"
                     "echo '{\"outcome\": \"'$1'\", \"error\": \"why\", \"output\": {\"every\": 1},'"
                     "'\"totals\": {\"steps\": 0, \"wall_seconds\": 1}}' > $out/run.json; }\n" +
                         script);
    fs::permissions(program, fs::perms::owner_all);
  }

  void run(std::int64_t jobs, const SweepHooks& hooks = {}) {
    run_sweep(folder.path(), program.string(), {jobs, 1}, plan, hooks);
  }

  std::string outcomes() const {
    std::string text;
    for (const SweepRun& run : plan.runs) {
      text += choice_names(run.result.outcome)[static_cast<std::size_t>(run.result.outcome)];
      text += ' ';
    }
    return text;
  }

  std::string table() const { return TemporaryFolder::read(folder.path() / "sweep.csv"); }

  TemporaryFolder folder;
  fs::path program;
  SweepPlan plan;
};

TEST_CASE("each run has its outcome, and the table is in the order of the product") {
  Rig rig({"1", "2", "3", "4", "5"},
          "case $value in\n"
          "1) while [ ! -f $(dirname $out)/0004/run.json ]; do sleep 0.01; done; end ok;;\n"
          "2) end diverged; exit 3;;\n"
          "3) echo 'pliant: error: \"no, no\"'; exit 2;;\n"
          "4) kill -9 $$;;\n"
          "5) end ok;;\n"
          "esac\n");
  std::string order;
  SweepState last;
  SweepHooks hooks;
  hooks.tell_ended = [&order](const SweepRun& run) { order += run.values[0]; };
  hooks.show = [&last](const SweepState& state) { last = state; };
  rig.run(5, hooks);
  CHECK(rig.outcomes() == "ok diverged failed failed ok ");
  CHECK(order.size() == 5);
  CHECK(last.ended == 5);
  CHECK(last.failed == 2);
  CHECK(last.diverged == 1);
  CHECK(last.running == 0);
  CHECK(rig.plan.runs[2].result.message == "\"no, no\"");
  CHECK(rig.plan.runs[3].result.message.starts_with("ended by signal 9"));
  CHECK(exit_code_of(rig.plan.runs) == 2);
  const std::string table = rig.table();
  CHECK(table == sweep_csv(rig.plan));
  CHECK(table.starts_with("run,x,outcome,steps_done,kinetic_end,"));
  CHECK(table.find("\n0000,1,ok,0,") != std::string::npos);
  CHECK(table.find("\n0001,2,diverged,0,") != std::string::npos);
  CHECK(table.find(",\"\"\"no, no\"\"\"\n") != std::string::npos);
  CHECK(!fs::exists(run_log(rig.folder.path(), "0000")));  // it was empty
  CHECK(fs::exists(run_log(rig.folder.path(), "0002")));
}

TEST_CASE("only so many runs go on at a time, and what has ended is not run again") {
  Rig rig({"1", "2", "3", "4", "5", "6"}, "echo x >> $out.count; end ok\n");
  std::size_t most = 0;
  SweepHooks hooks;
  hooks.show = [&most](const SweepState& state) { most = std::max(most, state.running); };
  rig.plan.runs[1].result.outcome = RunOutcome::ok;
  rig.plan.runs[3].result.outcome = RunOutcome::diverged;
  rig.run(2, hooks);
  CHECK(most <= 2);
  CHECK(rig.outcomes() == "ok ok ok diverged ok ok ");
  CHECK(!fs::exists(rig.folder.path() / "runs" / "0001.count"));
  CHECK(!fs::exists(rig.folder.path() / "runs" / "0003.count"));
  CHECK(exit_code_of(rig.plan.runs) == 3);
}

TEST_CASE("a stop ends what runs, and it waits again") {
  Rig rig({"1", "2", "3"}, "[ $value = 1 ] && end ok || exec sleep 1000\n");
  bool has_first = false;
  SweepHooks hooks;
  hooks.tell_ended = [&has_first](const SweepRun&) { has_first = true; };
  hooks.stop = [&has_first] { return has_first; };
  rig.run(2, hooks);
  CHECK(rig.outcomes() == "ok waiting waiting ");
  CHECK(rig.table().find("\n0001,2,waiting,,") != std::string::npos);
}

TEST_CASE("what cannot be started or written ends the sweep") {
  const auto kind_of = [](Rig& rig) {
    try {
      rig.run(1);
    } catch (const pliant::Error& error) {
      return error.kind();
    }
    return pliant::ErrorKind::diverged;
  };
  Rig no_program({"1"}, "");
  fs::remove(no_program.program);
  CHECK(kind_of(no_program) == pliant::ErrorKind::input);
  Rig no_folder({"1"}, "");
  fs::remove(no_folder.folder.path() / "runs");
  CHECK(kind_of(no_folder) == pliant::ErrorKind::output);
}

TEST_CASE("a file of the scene that changes ends the sweep, and runs that may have read it do not count") {
  enum class Is { text, mesh };
  for (const Is is : {Is::text, Is::mesh}) {
    for (const std::int64_t jobs : {1, 2}) {
      for (const std::string change : {"echo more >> $input", "rm $input"}) {
        CAPTURE(jobs);
        CAPTURE(change);
        // Of two jobs the third run's files are whole when the second one ends, and it still runs.
        const auto wait_for = [&](std::string_view run) {
          return jobs == 2 ? fmt::format("while [ ! -f $input.{} ]; do sleep 0.01; done", run) : "true";
        };
        Rig rig({"1", "2", "3", "4"},
                fmt::format("input=$(dirname $out)/../input\ncase $value in\n1) end ok;;\n2) {}; {}; end ok;;\n"
                            "3) end ok; touch $input.3; {};;\n4) end ok; touch $input.4;;\nesac\n",
                            wait_for("3"), change, wait_for("4")));
        const fs::path input = rig.folder.write("input", "a");
        constexpr std::uint32_t crc32 = 0xE8B7BE43U;
        if (is == Is::text) rig.plan.setup.texts = {{input, crc32}};
        if (is == Is::mesh) rig.plan.setup.files = {{input.string(), crc32}};
        std::string told;
        SweepHooks hooks;
        hooks.tell_ended = [&told](const SweepRun& run) { told += run.values[0]; };
        pliant::ErrorKind kind{};
        try {
          rig.run(jobs, hooks);
        } catch (const pliant::Error& error) {
          kind = error.kind();
          CHECK(std::string_view(error.what()).starts_with(input.string() + ": "));
        }
        CHECK(kind == pliant::ErrorKind::input);
        CHECK(told == "1");
        CHECK(rig.outcomes() == "ok waiting waiting waiting ");
        for (const SweepRun& run : rig.plan.runs) {
          CHECK(read_run_result(run_folder(rig.folder.path(), run.name)).outcome == run.result.outcome);
        }
        CHECK(rig.table() == sweep_csv(rig.plan));
      }
    }
  }
}

TEST_CASE("how many runs have which outcome") {
  SweepPlan plan;
  plan.runs.resize(5);
  CHECK(outcomes_text(plan) == "5 waiting");
  plan.runs[4].result.outcome = RunOutcome::ok;
  plan.runs[0].result.outcome = RunOutcome::failed;
  plan.runs[1].result.outcome = RunOutcome::diverged;
  plan.runs[2].result.outcome = RunOutcome::diverged;
  CHECK(outcomes_text(plan) == "1 ok, 2 diverged, 1 failed, 1 waiting");
  CHECK(count_of(plan, RunOutcome::diverged) == 2);
}

TEST_CASE("a folder has one sweep at a time") {
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    CHECK_THROWS_AS(FolderLock(folder.path()), pliant::Error);
  }
  CHECK_NOTHROW(FolderLock(folder.path()));
  CHECK_THROWS_AS(FolderLock(folder.path() / "none"), pliant::Error);
}

TEST_CASE("the worst outcome is the exit code") {
  const auto code = [](std::vector<RunResult> results) {
    std::vector<SweepRun> runs;
    runs.reserve(results.size());
    for (RunResult& result : results) runs.push_back({{}, "", std::move(result)});
    return exit_code_of(runs);
  };
  const RunResult ok{RunOutcome::ok};
  const RunResult diverged{RunOutcome::diverged, 3, "", 3};
  const RunResult bad{RunOutcome::failed, 0, "", 2};
  const RunResult full{RunOutcome::failed, 0, "", 4};
  const RunResult ended{RunOutcome::failed, 0, "", 130};
  CHECK(code({ok, ok}) == 0);
  CHECK(code({ok, diverged}) == 3);
  CHECK(code({diverged, bad, ok}) == 2);
  CHECK(code({bad, full, diverged}) == 4);
  CHECK(code({ended}) == 2);
}

}  // namespace

}  // namespace test_sweep
