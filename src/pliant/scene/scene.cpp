#include "pliant/scene/scene.h"

#include "pliant/mesh/io/read_file.h"
#include "pliant/scene/detail/option_reader.h"
#include "pliant/scene/detail/scene_reader.h"

namespace pliant {
namespace {

constexpr std::int64_t format_version = 1;

void check_version(const Node& root) {
  const Node version = root.require("pliant");
  if (version.value() != format_version) {
    version.fail(fmt::format("this program reads scenes of version {} alone; write \"pliant\": {}", format_version,
                             format_version));
  }
}

template <class T>
void replace(T& value, const std::optional<T>& override) {
  if (override) value = *override;
}

SolverSettings read_settings(const Node& root, const SceneOverrides& overrides) {
  SolverSettings settings;
  if (const auto node = root.find("settings")) read_options(*node, settings);
  replace(settings.time_step, overrides.time_step);
  replace(settings.iterations, overrides.iterations);
  replace(settings.tolerance, overrides.tolerance);
  replace(settings.threads, overrides.threads);
  replace(settings.backend, overrides.backend);
  return settings;
}

void read_run(const Node& root, const SceneOverrides& overrides, Scene& scene) {
  read_optional(root, "name", scene.name);
  read_optional(root, "description", scene.description);
  read_optional(root, "steps", scene.steps);
  if (const auto output = root.find("output")) read_options(*output, scene.output);
  replace(scene.steps, overrides.steps);
  replace(scene.output.format, overrides.format);
  replace(scene.output.every, overrides.every);
  if (scene.steps < 0) root.fail(fmt::format("steps: {} is negative; give a number from 0 up", scene.steps));
  if (scene.output.every < 1) {
    root.fail(fmt::format("output.every: {} is not possible; give a number from 1 up", scene.output.every));
  }
}

/// Calls f for each entry of a list that may be missing.
void for_each_entry(const Node& root, std::string_view key, auto&& f) {
  const auto list = root.find(key);
  if (!list) return;
  list->require_list();
  for (std::size_t i = 0; i < list->value().size(); ++i) f((*list)[i]);
}

}  // namespace

StepReport Scene::step() {
  return timeline.step(simulation);
}

Scene parse_scene(std::string_view text, const std::filesystem::path& folder, std::string_view name,
                  const SceneOverrides& overrides) {
  const Json json = parse_json(text, name);
  const Node root(name, json);
  root.require_object();
  check_version(root);
  root.check_keys({"pliant", "name", "description", "settings", "steps", "gravity", "bodies", "forces", "moves",
                   "events", "output"});
  Scene scene;
  scene.name = std::filesystem::path(name).stem().string();
  read_run(root, overrides, scene);
  const SolverSettings settings = read_settings(root, overrides);
  scene.simulation = root.locate([&] { return Simulation(settings); });

  if (const Node bodies = root.require("bodies"); bodies.value().empty()) bodies.fail("there is no body; add one");
  SceneReader reader{scene.simulation, folder, {}};
  for_each_entry(root, "bodies", [&](const Node& node) { reader.read_body(node); });
  reader.read_gravity(root);
  for_each_entry(root, "forces", [&](const Node& node) { reader.read_force(node); });
  reader.read_events(root, name, scene.timeline);
  scene.later_groups = std::move(reader.later_groups);
  return scene;
}

Scene load_scene(const std::filesystem::path& file, const SceneOverrides& overrides) {
  return parse_scene(read_file(file), file.parent_path(), file.string(), overrides);
}

std::string scene_description(std::string_view text, std::string_view name) {
  const Json json = parse_json(text, name);
  const Node root(name, json);
  root.require_object();
  std::string description;
  read_optional(root, "description", description);
  return description;
}

}  // namespace pliant
