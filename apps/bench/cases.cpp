#include "bench/cases.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant_bench {
namespace {

using namespace pliant;
using Json = nlohmann::ordered_json;

constexpr Index usual_size = 100;

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
  return {
      {"hanging", "a cloth of W5 that hangs at rest from two corners, pushed in its middle", hanging(n), true, 150,
       true},
      {"swinging", "a cloth of W5 that falls and swings from two corners", swinging(n), true, 30},
      {"falling", "a cloth of W7 that falls onto a sphere above a floor and folds", on_sphere(n), false, 60},
      {"dress", "the built-in scene dress_from_panels, while its seams close", builtin_text("dress_from_panels"), false,
       60},
      {"bar", "a soft bar at a wall that sinks under its weight", bar_at_wall(std::max<Index>(1, n / 10)), true, 10}};
}

std::vector<StepCase> choose_cases(const std::vector<std::string>& names, std::optional<Index> size) {
  std::vector<StepCase> all = step_cases(size);
  if (names.size() == 1 && names[0] == "all") return all;
  std::vector<std::string_view> known = {"all"};
  for (const StepCase& each : all) known.push_back(each.name);
  std::vector<StepCase> chosen;
  for (const std::string& name : names) {
    if (name == "all") fail_input("--time-to-error: 'all' has the others in it; give it by itself");
    const auto found = std::ranges::find(all, name, &StepCase::name);
    if (found == all.end()) {
      fail_input("--time-to-error: there is no '" + printable(name) + "'; " + suggestion_text(name, known));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

Scene begin_of(const StepCase& step_case, int threads) {
  Scene scene = parse_scene(step_case.scene, {}, step_case.name);
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
