#include "bench/against.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/timing.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/core/stopwatch.h"
#include "pliant_io/scene/scene.h"
#include "system/child_process.h"
#include "system/temporary_folder.h"

namespace pliant_bench {
namespace {

using namespace pliant;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double seconds_of_run = 1;  // of the long one, about
constexpr int usual_repeats = 9;

/// Runs one program once, without frames [s].
double seconds_of(const std::string& program, std::vector<std::string> arguments, std::int64_t steps) {
  arguments.insert(arguments.end(),
                   {"--steps", std::to_string(steps), "--format", "none", "--every", "1000000000", "--quiet"});
  try {
    const Stopwatch watch;
    pliant_system::ChildProcess process({.program = program, .arguments = arguments});
    process.end_input();
    const pliant_system::ProcessEnd end = process.wait();
    const double seconds = watch.seconds();
    if (end.signal == 0 && end.exit_code == 0) return seconds;
    fail_input(fmt::format("--against: {} ended with {}: {}", printable(program), end_text(end),
                           printable(process.messages(), 500)));
  } catch (const std::system_error& error) {
    fail_input(
        fmt::format("--against: {} cannot be started: {}; give the path of a build of this program, as in ./old/pliant",
                    printable(program), error.code().message()));
  }
}

/// So many steps that they take about as long as a run shall.
std::int64_t steps_of_run(Scene scene) {
  constexpr int tried = 5;
  scene.step();
  const Stopwatch watch;
  for (int i = 0; i < tried; ++i) scene.step();
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(seconds_of_run * tried / watch.seconds()), 20, 5000);
}

/// Lengths of a short and a long run of about so many steps. After steps 30, 300, 3000 `pliant run` looks how far the
/// next one is from its end, which takes hundreds of iterations: no such look is between them.
std::pair<std::int64_t, std::int64_t> lengths_of_runs(std::int64_t steps) {
  std::int64_t before = 0, next = 30;
  for (; steps > 3 * next; next *= 10) before = next;
  const std::int64_t most = std::min(steps, next);
  return {before == 0 ? std::max<std::int64_t>(1, most / 10) : before + 1, most};
}

Json constraints_of(const Workload& workload, const Mesh& mesh) {
  Json list = Json::array();
  if (workload.kind == Kind::bar) {
    list.push_back({{"type", "tetrahedron_strain"}, {"stiffness", 1e5}});
  } else if (workload.kind == Kind::cloth) {
    list.push_back({{"type", "triangle_strain"}, {"stiffness", 1e3}});
    list.push_back({{"type", "hinge"}, {"stiffness", 1e-5}});
  } else {
    list.push_back({{"type", "edge_spring"}, {"stiffness", 1e3}});
  }
  if (workload.kind == Kind::curtain_bending) list.push_back({{"type", "bending"}, {"stiffness", 1e-3}});
  Json pins = {{"type", "position"}, {"on", pinned_vertices(workload, mesh)}};
  if (workload.kind != Kind::cloth) pins.update({{"hold", "soft"}, {"stiffness", 1e6}});
  list.push_back(pins);
  return list;
}

/// Begins at rest, where both programs take the same time.
std::string scene_of(const Workload& workload) {
  const Index n = workload.size;
  const bool is_bar = workload.kind == Kind::bar;
  const Json mesh = is_bar ? Json{{"shape", "bar"}, {"cells", {4 * n, n, n}}, {"size", {4, 1, 1}}, {"cut", "five"}}
                           : Json{{"shape", "grid"}, {"columns", n}, {"rows", n}, {"size", {1, 1}}};
  const Json mass = workload.kind == Kind::cloth ? Json{{"area_density", 0.2}} : Json{{"per_vertex", 1}};
  return Json{{"pliant", 1},
              {"settings", {{"time_step", 1.0 / 60}, {"iterations", workload.iterations}}},
              {"bodies",
               {{{"name", "body"},
                 {"mesh", mesh},
                 {"mass", mass},
                 {"constraints", constraints_of(workload, make_mesh(workload))}}}},
              {"output", {{"format", "none"}, {"every", 1'000'000'000}}}}
      .dump(1);
}

}  // namespace

std::vector<AgainstTask> tasks_of(const BenchOptions& options) {
  std::vector<AgainstTask> tasks;
  for (const StepCase& each : options.cases) {
    if (!each.is_plain) {
      fail_input(fmt::format(
          "--against: '{}' does not take plain steps, by whose time the other program is judged; give a file "
          "without contact, with a number of iterations and \"acceleration\": \"none\"",
          printable(each.name)));
    }
    if (each.is_old) tasks.push_back({each.name, each.scene, each.folder, each.is_file, each.iterations});
  }
  for (const Workload& workload : options.workloads) {
    const bool is_old = workload.kind != Kind::falling;  // 0.1.0 has no contact
    if (is_old && workload.order == MeshOrder::rows)
      tasks.push_back({workload.name, scene_of(workload), {}, false, workload.iterations});
  }
  return tasks;
}

AgainstResult measure_against(const AgainstTask& task, const std::string& other, int threads,
                              std::optional<int> repeats) {
  const pliant_system::TemporaryFolder folder("pliant-against");
  const fs::path file = folder.path() / "scene.json";
  if (!task.is_file) std::ofstream(file) << task.scene;
  const std::vector<std::string> arguments = {"run",          task.is_file ? task.name : file.string(),
                                              "--out",        (folder.path() / "run").string(),
                                              "--threads",    std::to_string(threads),
                                              "--iterations", std::to_string(task.iterations)};
  const auto lengths = lengths_of_runs(steps_of_run(
      parse_scene(task.scene, task.folder, task.name, {.iterations = task.iterations, .threads = threads})));
  const std::int64_t few = lengths.first, many = lengths.second;
  AgainstResult result{task.name, threads, task.iterations, {}, {}, 1};
  Samples own, others, ratios;
  const auto step_of = [&](const std::string& program) {
    const double shorter = seconds_of(program, arguments, few);
    return (seconds_of(program, arguments, many) - shorter) / static_cast<double>(many - few);
  };
  const std::string this_program = pliant_system::own_program();
  repeat(repeats.value_or(usual_repeats), 0, [&] {
    const double a = step_of(this_program), b = step_of(other);
    own.add(a);
    others.add(b);
    ratios.add(b / a);
  });
  result.own_step = own.spread();
  result.other_step = others.spread();
  result.times_as_fast = ratios.spread().median;
  return result;
}

}  // namespace pliant_bench
