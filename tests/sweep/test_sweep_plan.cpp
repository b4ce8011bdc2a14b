// Which runs of an earlier start are those of this one, and what forbids that they stand beside each other.
#include <string>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "sweep/sweep.h"
#include "tests/support/temporary_folder.h"

namespace test_sweep_plan {

namespace {

using namespace pliant_sweep;
using pliant_tests::TemporaryFolder;
namespace fs = std::filesystem;

constexpr std::string_view scene_text = R"({
  "pliant": 1,
  "bodies": [{"name": "rope", "mesh": {"shape": "chain", "links": 3}, "mass": {"total": 1},
              "constraints": [{"type": "edge_spring", "name": "links"}, {"type": "position", "name": "hook", "on": [0]}]}]
})";

SweepSetup setup_of(std::vector<Variation> variations, const pliant::SceneOverrides& overrides = {}) {
  const auto open = [](const pliant::SceneOverrides& values) {
    return pliant::parse_scene(scene_text, {}, "s.json", values);
  };
  return check_sweep({"s.json", std::move(variations), overrides}, open);
}

SweepPlan plan_of(const TemporaryFolder& folder, SweepSetup setup, Earlier earlier = Earlier::keep) {
  return plan_sweep(folder.path(), std::move(setup), earlier);
}

std::string names_of(const SweepPlan& plan) {
  std::string names;
  for (const SweepRun& run : plan.runs) names += (names.empty() ? "" : " ") + run.name;
  return names;
}

std::string message_of(auto&& f, pliant::ErrorKind kind = pliant::ErrorKind::input) {
  try {
    f();
  } catch (const pliant::Error& error) {
    CHECK(error.kind() == kind);
    return error.what();
  }
  return "(no error)";
}

/// What a run that has ended leaves.
void end_run(const TemporaryFolder& folder, const std::string& name) {
  const fs::path path = run_folder(folder.path(), name);
  fs::create_directories(path);
  folder.write((path / "run.json").string(),
               R"({"outcome": "ok", "output": {"every": 1}, "totals": {"steps": 0, "wall_seconds": 1}})");
  folder.write((path / "measurements.csv").string(), "step,time,total\n0,0,5\n");
}

const Variation steps{"steps", {"1", "2"}};
const Variation iterations{"settings.iterations", {"3", "4", "5"}};

TEST_CASE("runs keep their names and results from start to start") {
  const TemporaryFolder folder;
  const SweepPlan first = plan_of(folder, setup_of({steps, iterations}));
  CHECK(names_of(first) == "0001 0002 0003 0004 0005 0006");
  CHECK(folder.file_count() == 0);
  begin_sweep(folder.path(), first);
  end_run(folder, "0002");  // steps 1, iterations 4
  // The paths in another order, a value more, one less, one written in another way.
  const SweepPlan second = plan_of(folder, setup_of({{"settings.iterations", {"4", "6"}}, {"steps", {"2", "1"}}}));
  CHECK(names_of(second) == "0005 0002 0007 0008");
  CHECK(second.runs[1].result.outcome == RunOutcome::ok);
  CHECK(second.runs[1].result.figure(figure_index("total_end")) == 5.0);
  CHECK(second.runs[0].result.outcome == RunOutcome::waiting);
  CHECK(second.others.size() == 4);
  begin_sweep(folder.path(), second);
  CHECK(names_of(plan_of(folder, setup_of({steps, iterations}))) == "0001 0002 0003 0004 0005 0006");
}

TEST_CASE("what cannot be compared is refused") {
  const TemporaryFolder folder;
  const SweepSetup setup = setup_of({steps}, {.set = {"gravity=null"}});
  begin_sweep(folder.path(), plan_of(folder, setup));
  const auto message = [&](SweepSetup other) { return message_of([&] { plan_of(folder, std::move(other)); }); };
  CHECK(message(setup) == "(no error)");
  CHECK(message(setup_of({steps})).find("have --set gravity=null rather than no --set") != std::string::npos);
  CHECK(message(setup_of({steps}, {.every = 2, .set = {"gravity=null"}})).find("--every 2") != std::string::npos);
  CHECK(message(setup_of({iterations}, {.set = {"gravity=null"}})).find("vary steps") != std::string::npos);
  SweepSetup changed = setup;
  changed.texts[0].crc32 ^= 1;
  CHECK(message(changed).find("another text") != std::string::npos);
  CHECK(plan_of(folder, changed, Earlier::remove).removed.size() == 2);
  SweepSetup with_file = setup;
  with_file.files["cloth.obj"] = 1;
  begin_sweep(folder.path(), plan_of(folder, with_file));
  with_file.files["cloth.obj"] = 2;
  CHECK(message(with_file).find("another cloth.obj") != std::string::npos);
}

TEST_CASE("files of runs that are not asked for now are known, and not looked at") {
  const TemporaryFolder folder;
  SweepSetup setup = setup_of({steps});
  setup.files["gone.obj"] = 1;
  begin_sweep(folder.path(), plan_of(folder, setup));
  setup.files.clear();
  const SweepPlan plan = plan_of(folder, setup);
  CHECK_NOTHROW(check_unchanged(plan.setup));
  begin_sweep(folder.path(), plan);
  setup.files["gone.obj"] = 2;
  CHECK(message_of([&] { plan_of(folder, setup); }).find("another gone.obj") != std::string::npos);
}

TEST_CASE("values that are nested deep overflow nothing") {
  const TemporaryFolder folder;
  const SweepSetup setup = setup_of({steps});
  begin_sweep(folder.path(), plan_of(folder, setup));
  const fs::path file = folder.path() / "sweep.json";
  std::string text = TemporaryFolder::read(file);
  constexpr std::size_t depth = 1'000'000;
  const std::string deep = std::string(depth, '[') + std::string(depth, ']');
  const std::string value = "[\\\"" + std::string(depth, ']') + "\\\"," + deep + "]";
  const std::size_t place = text.rfind("\"2\"");
  REQUIRE(place != std::string::npos);
  folder.write("sweep.json", text.replace(place + 1, 1, value));
  CHECK(plan_of(folder, setup).others.size() == 1);
  folder.write("sweep.json", deep);
  CHECK(message_of([&] { plan_of(folder, setup); }, pliant::ErrorKind::output).find("was not written by a sweep") !=
        std::string::npos);
}

TEST_CASE("a place is varied once, whatever it is called") {
  const auto slip = [](std::vector<Variation> variations, std::vector<std::string> set = {}) {
    return message_of([&] { setup_of(std::move(variations), {.set = std::move(set)}); });
  };
  const Variation by_index{"bodies[0].mass.total", {"1", "2"}};
  const Variation by_name{"bodies[rope].mass.total", {"3", "4"}};
  const Variation around{"bodies[rope].mass", {R"({"total": 5})"}};
  CHECK(slip({by_index, by_name}) ==
        "--vary bodies[rope].mass.total: takes the place of --vary bodies[0].mass.total, which would count for "
        "nothing; leave out one of the two");
  CHECK(slip({by_name, steps, by_index}).find("the place of --vary bodies[rope].mass.total") != std::string::npos);
  CHECK(slip({by_index, around}).find("the place of --vary bodies[0].mass.total") != std::string::npos);
  CHECK(slip({by_name}, {"bodies[0].mass.total=7"}).find("the place of --set bodies[0].mass.total") !=
        std::string::npos);
  CHECK(slip({around, by_index}) == "(no error)");  // one value inside of the other
  // Where any value is taken nothing can be told.
  const auto open = [](const pliant::SceneOverrides&) { return pliant::parse_scene(scene_text, {}, "s.json"); };
  CHECK_NOTHROW(check_sweep({"s.json", {by_index, by_name}, {}}, open));
  CHECK(slip({{"bodies[0].constraints[links].stiffness", {"1"}}, {"bodies[0].constraints[1].stiffness", {"2"}}}) ==
        "(no error)");
  CHECK(
      slip({{"bodies[0].constraints[links].stiffness", {"1"}},
            {"bodies[0].constraints[1].stiffness", {"2"}},
            {"bodies[rope].constraints[0].stiffness", {"3"}}}) ==
      "--vary bodies[rope].constraints[0].stiffness: takes the place of --vary bodies[0].constraints[links].stiffness, "
      "which would count for nothing; leave out one of the two");
}

TEST_CASE("only the runs of the sweep are removed") {
  const TemporaryFolder folder;
  begin_sweep(folder.path(), plan_of(folder, setup_of({steps})));
  end_run(folder, "0001");
  end_run(folder, "0003");
  folder.write("notes.txt", "x");
  begin_sweep(folder.path(), plan_of(folder, setup_of({iterations}), Earlier::remove));
  CHECK(!fs::exists(run_folder(folder.path(), "0001")));
  CHECK(fs::exists(run_folder(folder.path(), "0003")));
  CHECK(fs::exists(folder.path() / "notes.txt"));
}

TEST_CASE("what no sweep wrote is not replaced") {
  for (const char* name : {"sweep.csv", "index.html", "runs", "plots"}) {
    const TemporaryFolder folder;
    folder.write(name, "x");
    CHECK(
        message_of([&] { plan_of(folder, setup_of({steps})); }, pliant::ErrorKind::output).find("no sweep wrote it") !=
        std::string::npos);
  }
  for (const char* text : {"", "{", "[]", "{}", R"({"pliant_file": "sweep"})", R"({"pliant_file": 3})",
                           R"({"pliant_file": "sweep", "pliant": "0", "texts": [], "files": {}, "set": [],
                               "options": {}, "vary": [], "runs": [{"name": "../x", "values": []}]})",
                           R"({"pliant_file": "sweep", "pliant": "0", "texts": [], "files": {}, "set": [],
                               "options": {}, "vary": [], "runs": [{"name": "0001", "values": ["1"]}]})",
                           R"({"pliant_file": "sweep", "pliant": "0", "texts": [], "files": {}, "set": [],
                               "options": {}, "vary": [{"path": "steps"}],
                               "runs": [{"name": "0001", "values": ["1"]}, {"name": "0001", "values": ["2"]}]})",
                           R"({"pliant_file": "sweep", "pliant": "0", "texts": [{"file": "a", "crc32": 1e300}],
                               "files": {}, "set": [], "options": {}, "vary": [], "runs": []})",
                           R"({"pliant_file": "sweep", "pliant": "0", "texts": [], "files": {"a": -1}, "set": [],
                               "options": {}, "vary": [], "runs": []})"}) {
    CAPTURE(text);
    const TemporaryFolder folder;
    folder.write("sweep.json", text);
    for (const Earlier earlier : {Earlier::keep, Earlier::remove}) {
      const std::string message =
          message_of([&] { plan_of(folder, setup_of({steps}), earlier); }, pliant::ErrorKind::output);
      CHECK(message.find("was not written by a sweep") != std::string::npos);
    }
  }
}

TEST_CASE("each value is read once before anything runs") {
  std::vector<std::string> seen;
  const auto open = [&seen](const pliant::SceneOverrides& values) {
    seen.push_back(values.set[0] + " " + values.set[1]);
    return pliant::parse_scene(scene_text, {}, "s.json", values);
  };
  check_sweep({"s.json", {steps, iterations}, {}}, open);
  CHECK(seen == std::vector<std::string>{"steps=1 settings.iterations=3", "steps=2 settings.iterations=3",
                                         "steps=1 settings.iterations=4", "steps=1 settings.iterations=5"});
  const auto slip = [](Variation variation, const pliant::SceneOverrides& overrides = {}) {
    return message_of([&] { setup_of({std::move(variation)}, overrides); });
  };
  CHECK(slip({"steps", {"1", "x"}}) == "--vary steps=x: found a string; give a whole number");
  CHECK(slip({"settings.time_step", {"0.1"}}, {.time_step = 0.2}).find("--time-step") != std::string::npos);
  CHECK(slip({"settings.backend", {"eigen"}}, {.backend = pliant::Backend::eigen}).find("--backend") !=
        std::string::npos);
  CHECK(slip({"settings.threads", {"1"}}, {.threads = 2}).find("--threads") != std::string::npos);
  CHECK(slip({"gravity", {"null"}}, {.set = {"gravity=null"}}).find("--set") != std::string::npos);
  const auto stop = [] { return false; };
  CHECK(message_of(
            [&] {
              check_sweep({"s.json", {steps, iterations}, {}}, open, stop);
            },
            pliant::ErrorKind::interrupted) == "nothing was run");
}

TEST_CASE("the arguments of a run") {
  const SweepSetup setup =
      setup_of({steps}, {.time_step = 0.1, .format = pliant::FrameFormat::none, .every = 2, .set = {"gravity=null"}});
  CHECK(run_arguments(setup, {"2"}, "o ut", 3) ==
        std::vector<std::string>{"run", "--out=o ut", "--time-step=0.1", "--format=none", "--every=2", "--threads=3",
                                 "--set=gravity=null", "--set=steps=2", "--quiet", "--", "s.json"});
}

TEST_CASE("processors are shared out") {
  const TemporaryFolder folder;
  const SweepPlan six = plan_of(folder, setup_of({steps, iterations}));
  const auto share = [&](std::int64_t processors, std::optional<std::int64_t> jobs,
                         std::optional<std::int64_t> threads) {
    const Sharing sharing = share_processors(processors, six, jobs, threads);
    return std::vector<std::int64_t>{sharing.jobs, sharing.threads};
  };
  using Numbers = std::vector<std::int64_t>;
  CHECK(share(4, {}, {}) == Numbers{4, 1});
  CHECK(share(0, {}, {}) == Numbers{1, 1});
  CHECK(share(16, {}, {}) == Numbers{6, 2});
  CHECK(share(16, 2, {}) == Numbers{2, 8});
  CHECK(share(16, {}, 4) == Numbers{4, 4});
  CHECK(share(4, {}, 0) == Numbers{1, 0});
  CHECK(share(4, 8, 3) == Numbers{6, 3});
  const SweepPlan threads = plan_of(folder, setup_of({{"settings.threads", {"1", "2"}}}));
  CHECK(share_processors(16, threads, {}, {}).jobs == 1);
  CHECK(share_processors(16, threads, {}, {}).threads < 0);
}

}  // namespace

}  // namespace test_sweep_plan
