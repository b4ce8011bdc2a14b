#include "bench/cases.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant_bench {
namespace {

using namespace pliant;
using Json = nlohmann::ordered_json;

constexpr Index usual_size = 100;
constexpr std::int64_t usual_steps = 60;

Json scene_of(Json body, Json more = Json::object()) {
  Json scene = {{"pliant", 1},
                {"settings", {{"time_step", 1.0 / 60}, {"iterations", 10}}},
                {"bodies", Json::array({std::move(body)})},
                {"output", {{"format", "none"}, {"every", 1'000'000'000}}}};
  scene.update(more);
  return scene;
}

/// That of the workloads W5 and W7: a meter of it, n × n vertices.
Json cloth(Index n, const char* plane, const Json& transform = nullptr) {
  Json body = {
      {"name", "cloth"},
      {"mesh", {{"shape", "grid"}, {"columns", n}, {"rows", n}, {"size", {1, 1}}, {"plane", plane}}},
      {"mass", {{"area_density", 0.2}}},
      {"constraints", {{{"type", "triangle_strain"}, {"stiffness", 1000}}, {{"type", "hinge"}, {"stiffness", 1e-5}}}}};
  if (!transform.is_null()) body["transform"] = transform;
  return body;
}

Json pinned(Json body, Index n) {
  body["constraints"].push_back({{"type", "position"}, {"on", {n * (n - 1), n * n - 1}}});
  return body;
}

std::string hanging(Index n) {
  return scene_of(pinned(cloth(n, "xz"), n)).dump(1);
}

std::string swinging(Index n) {
  return scene_of(pinned(cloth(n, "xy"), n)).dump(1);
}

std::string on_sphere(Index n) {
  const Json more = {
      {"contact", {{"friction", 0.3}}},
      {"colliders",
       {{{"type", "sphere"}, {"center", {0, 0, 0.4}}, {"radius", 0.3}}, {{"type", "plane"}, {"name", "floor"}}}}};
  return scene_of(cloth(n, "xy", {{"translate", {-0.48, -0.49, 0.75}}}), more).dump(1);
}

std::string bar_at_wall(Index cells) {
  const Json body = {
      {"name", "bar"},
      {"mesh", {{"shape", "bar"}, {"cells", {4 * cells, cells, cells}}, {"size", {4, 1, 1}}, {"cut", "five"}}},
      {"mass", {{"density", 1000}}},
      {"constraints",
       {{{"type", "tetrahedron_strain"}, {"stiffness", 1e6}},
        {{"type", "position"}, {"on", {{"half_space", {{"point", {0, 0, 0}}, {"normal", {-1, 0, 0}}}}}}}}}};
  return scene_of(body).dump(1);
}

std::string builtin_text(std::string_view name) {
  return std::string(std::ranges::find(builtin_scenes(), name, &BuiltinScene::name)->text);
}

bool takes_plain_steps(const Scene& scene) {
  const SolverSettings& settings = scene.simulation.settings();
  const bool has_contact = scene.has_surfaces || !scene.simulation.colliders().empty();
  if (settings.iterations == automatic_iterations || has_contact) return false;
  if (settings.acceleration != Acceleration::automatic) return settings.acceleration == Acceleration::none;
  return std::ranges::all_of(scene.simulation.groups(), [](const auto& each) {
    return std::ranges::all_of(each.second.set.batches, [](const auto& batch) { return batch->is_projective(); });
  });
}

/// A built-in scene, or a file.
StepCase case_of_scene(const std::string& name, const std::vector<StepCase>& cases, std::int64_t steps) {
  StepCase result{.name = name, .is_old = true, .steps = steps};
  const auto builtin = std::ranges::find(builtin_scenes(), name, &BuiltinScene::name);
  if (builtin != builtin_scenes().end()) {
    result.description = fmt::format("the built-in scene, step {}", steps + 1);
    result.scene = std::string(builtin->text);
  } else if (name.ends_with(".json")) {
    result.description = fmt::format("a scene file, step {}", steps + 1);
    result.scene = read_file(name);
    result.folder = std::filesystem::path(name).parent_path();
    result.is_file = true;
  } else {
    std::vector<std::string_view> known = {"all"};
    for (const StepCase& each : cases) known.push_back(each.name);
    for (const BuiltinScene& each : builtin_scenes()) {
      if (std::ranges::find(known, each.name) == known.end()) known.push_back(each.name);
    }
    fail_input("--time-to-error: there is no '" + printable(name) +
               "'; give a case of the bench, a built-in scene or a scene file; " + suggestion_text(name, known));
  }
  const Scene scene = parse_scene(result.scene, result.folder, name);
  result.iterations = scene.simulation.settings().iterations;
  result.is_plain = takes_plain_steps(scene);
  return result;
}

/// A push of the middle of a cloth, out of its plane [m/s].
void push(Simulation& simulation) {
  constexpr Real speed = 0.5, width = 0.15;
  const State& state = simulation.state();
  const Vec3 middle = state.positions.colwise().mean().transpose();
  Positions velocities = state.velocities;
  for (Index i = 0; i < state.vertex_count(); ++i) {
    const Real distance = (row(state.positions, i) - middle).norm() / width;
    velocities(i, 1) += speed * std::exp(-distance * distance);
  }
  simulation.set_state(Positions(state.positions), velocities);
}

}  // namespace

std::vector<StepCase> step_cases(std::optional<Index> size) {
  const Index n = size.value_or(usual_size);
  return {{.name = "hanging",
           .description = "a cloth of W5 that hangs at rest from two corners, pushed in its middle",
           .scene = hanging(n),
           .is_old = true,
           .steps = 150,
           .settles = true},
          {.name = "swinging",
           .description = "a cloth of W5 that falls and swings from two corners",
           .scene = swinging(n),
           .is_old = true,
           .steps = 30},
          {.name = "falling",
           .description = "a cloth of W7 that falls onto a sphere above a floor and folds",
           .scene = on_sphere(n),
           .steps = 60},
          {.name = "dress",
           .description = "the built-in scene dress_from_panels, while its seams close",
           .scene = builtin_text("dress_from_panels"),
           .steps = 60},
          {.name = "bar",
           .description = "a soft bar at a wall that sinks under its weight",
           .scene = bar_at_wall(std::max<Index>(1, n / 10)),
           .is_old = true,
           .steps = 10}};
}

std::vector<StepCase> choose_cases(const std::vector<std::string>& names, std::optional<Index> size,
                                   std::optional<std::int64_t> steps) {
  std::vector<StepCase> all = step_cases(size);
  const auto is_of_bench = [&](const std::string& name) {
    return name == "all" || std::ranges::find(all, name, &StepCase::name) != all.end();
  };
  if (steps && std::ranges::all_of(names, is_of_bench)) {
    fail_input("--steps: the bench's own cases take theirs; give a built-in scene or a scene file, or leave it out");
  }
  if (names.size() == 1 && names[0] == "all") return all;
  std::vector<StepCase> chosen;
  for (const std::string& name : names) {
    if (name == "all") fail_input("--time-to-error: 'all' has the others in it; give it by itself");
    const auto found = std::ranges::find(all, name, &StepCase::name);
    chosen.push_back(found == all.end() ? case_of_scene(name, all, steps.value_or(usual_steps)) : *found);
  }
  return chosen;
}

Scene begin_of(const StepCase& step_case, int threads) {
  Scene scene = parse_scene(step_case.scene, step_case.folder, step_case.name);
  Simulation& simulation = scene.simulation;
  const auto set = [&](const auto& change) {
    SolverSettings settings = simulation.settings();
    change(settings);
    simulation.set_settings(settings);
  };
  const SolverSettings given = simulation.settings();
  set([&](SolverSettings& settings) {
    settings.threads = threads;
    settings.acceleration = Acceleration::lbfgs;
    settings.iterations = std::max<Index>(settings.iterations, 20);
    if (step_case.settles) settings.damping = 3;
  });
  for (std::int64_t i = 0; i < step_case.steps; ++i) scene.step();
  set([&](SolverSettings& settings) {
    settings = given;
    settings.threads = threads;
  });
  if (step_case.settles) push(simulation);
  return scene;
}

}  // namespace pliant_bench
