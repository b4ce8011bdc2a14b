#include "scene_options.h"

#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include "commands.h"
#include "motion_advice.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/mesh/geometry.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/mesh_scene.h"
#include "pliant_io/scene/nearest_names.h"
#include "stiffness_text.h"
#include "terminal.h"

namespace pliant_cli {
namespace fs = std::filesystem;

namespace {

bool has_mesh_name(const SceneArguments& arguments) {
  return pliant::mesh_format(arguments.scene).has_value();
}

/// The name of a group of a mesh's only body; those of its material have the body's in front.
std::string short_name(const pliant::Simulation& simulation, const pliant::Group& group) {
  const std::string body = simulation.body(group.body).name + ".";
  return pliant::printable(group.name.starts_with(body) ? group.name.substr(body.size()) : group.name);
}

std::string groups_text(const pliant::Simulation& simulation) {
  std::string text;
  for (const auto& [id, group] : simulation.groups()) {
    text += fmt::format("  {:<9} {} of type {}", short_name(simulation, group), group.set.count, group.type);
    if (const auto range = stiffness_range(simulation, id)) text += ", " + stiffness_text(*range);
    text += "\n";
  }
  return text;
}

std::string forces_text(const pliant::Simulation& simulation) {
  std::string text;
  for (const auto& [id, force] : simulation.forces()) {
    text += (text.empty() ? "" : ", ") + pliant::printable(simulation.name(id));
  }
  if (text.empty()) return "none";
  return simulation.find_force("wind") ? text : text + "; no wind";
}

/// "1 x 0.5 x 2 m"
std::string size_text(const pliant::Simulation& simulation) {
  const pliant::BoundingBox box = pliant::bounding_box(simulation.state().positions);
  const pliant::Vec3 size = box.max - box.min;
  return fmt::format("{:.3g} x {:.3g} x {:.3g} m", size.x(), size.y(), size.z());
}

pliant::Real mass_of(const pliant::Simulation& simulation) {
  const auto& masses = simulation.state().masses;
  return std::accumulate(masses.begin(), masses.end(), pliant::Real(0));
}

}  // namespace

void add_scene_arguments(CLI::App& command, SceneArguments& arguments, const std::string& help) {
  command.add_option("scene", arguments.scene, help)->type_name("FILE")->required();
  command
      .add_option("--set", arguments.overrides.set,
                  "Change a value of the scene, such as settings.iterations=20, bodies[0].mass.total=2 or "
                  "'bodies[curtain].constraints[bend].stiffness=1e-3'; may be given several times")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->take_all();
}

void add_setting_options(CLI::App& command, SceneArguments& arguments) {
  pliant::SceneOverrides& overrides = arguments.overrides;
  add_number(command, "--steps", overrides.steps, "Number of steps");
  add_number(command, "--iterations", overrides.iterations,
             {"automatic", [&overrides] { overrides.set.emplace_back("settings.iterations=automatic"); }},
             "Iterations (a local and a global step each) in each step; automatic: as many as it needs");
  add_number(command, "--time-step", overrides.time_step, "Length of a step [s]");
  add_number(command, "--tolerance", overrides.tolerance,
             "Stop iterating below this residual [N]; 0: only at exact rest");
  add_number(command, "--threads", overrides.threads,
             "Number of threads at most, 0: one for each processor; results do not depend on it");
  add_choice(command, "--backend", overrides.backend,
             "Library that factorizes the system matrix: automatic, eigen or cholmod");
}

bool is_mesh(const SceneArguments& arguments) {
  std::error_code ignored;
  return has_mesh_name(arguments) && fs::exists(arguments.scene, ignored) &&
         !fs::is_directory(arguments.scene, ignored);
}

bool is_checkpoint(const SceneArguments& arguments) {
  return fs::path(arguments.scene).extension() == ".pliant";
}

bool is_session(const SceneArguments& arguments) {
  return is_session(fs::path(arguments.scene));
}

bool is_session(const fs::path& file) {
  return file.extension() == ".session";
}

void check_session(const SceneArguments& arguments) {
  const pliant::SceneOverrides& overrides = arguments.overrides;
  if (!is_session(arguments)) return;
  if (overrides.set.empty() && !overrides.time_step && !overrides.iterations && !overrides.tolerance &&
      !overrides.backend && !overrides.steps && !overrides.threads) {
    return;
  }
  pliant::fail_input("--set, --steps and the like: a recorded session comes again as it was; leave them out");
}

void check_checkpoint(const SceneArguments& arguments, const std::string& remedy) {
  const pliant::SceneOverrides& overrides = arguments.overrides;
  if (!is_checkpoint(arguments)) return;
  if (overrides.set.empty() && !overrides.time_step && !overrides.iterations && !overrides.tolerance &&
      !overrides.backend) {
    return;
  }
  pliant::fail_input("--set and the like: a checkpoint goes on as it was; " + remedy);
}

void check_import(const SceneArguments& arguments) {
  const pliant::ImportOptions plain;
  const bool is_placed =
      arguments.import.scale != plain.scale || arguments.import.up != plain.up || arguments.import.drop_loose;
  if (!is_placed || has_mesh_name(arguments)) return;
  pliant::fail_input(
      "--scale, --up, --drop-loose: these are for a mesh by itself; a scene has \"scale\", \"up\" and "
      "\"drop_loose\" with its meshes, see "
      "docs/scenes.md");
}

std::string short_assumptions_text(const SceneArguments& arguments, const pliant::Scene& scene) {
  if (!is_mesh(arguments)) return "";
  const std::string name = pliant::printable_place(fs::path(arguments.scene).filename().string());
  std::string text = fmt::format("{}: {}\n{}, {:.3g} kg", name, pliant::printable(scene.description, 1000),
                                 size_text(scene.simulation), mass_of(scene.simulation));
  if (!scene.materials.empty()) {
    text += fmt::format(" of {}", pliant::printable(scene.materials.begin()->second.name));
  }
  return text;
}

std::string assumptions_text(const SceneArguments& arguments, const pliant::Scene& scene) {
  if (!is_mesh(arguments)) return "";
  const pliant::Simulation& simulation = scene.simulation;
  const pliant::SolverSettings& settings = simulation.settings();
  const std::string name = pliant::printable_place(arguments.scene);
  std::string text = fmt::format("{}: {}", name, pliant::printable(scene.description, 1000));
  const bool is_scaled = scene.description.ends_with("are taken as 1 m");
  text += is_scaled ? ", --scale says how many meters a unit has\n" : "\n";
  text += fmt::format("  size      {}, z is up\n", size_text(simulation));
  text += fmt::format("  mass      {:.4g} kg\n", mass_of(simulation));
  for (const auto& [id, material] : scene.materials)
    text += fmt::format("  material  {}\n", pliant::printable(material.name));
  text += groups_text(simulation);
  text += fmt::format("  forces    {}\n", forces_text(simulation));
  if (simulation.contact().surfaces) text += "  contact   of surfaces, each with itself too\n";
  text += fmt::format("  steps     {} of {:.4g} s, {}\n", scene.steps, settings.time_step, steps_text(settings));
  return text + fmt::format("  --set changes this; `pliant check {} --scene` prints it as a scene file\n", name);
}

pliant::Scene open_scene(const SceneArguments& arguments) {
  check_import(arguments);
  if (is_mesh(arguments)) return pliant::make_mesh_scene(arguments.scene, arguments.import, arguments.overrides);
  std::error_code error;
  const fs::file_status status = fs::status(arguments.scene, error);
  if (fs::exists(status) && !fs::is_directory(status)) return pliant::load_scene(arguments.scene, arguments.overrides);
  std::vector<std::string_view> names;
  for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) {
    if (scene.name == arguments.scene) return pliant::parse_scene(scene.text, {}, scene.name, arguments.overrides);
    names.push_back(scene.name);
  }
  if (has_mesh_name(arguments) && status.type() == fs::file_type::not_found) {
    pliant::fail_input(pliant::printable_place(arguments.scene) + ": no such file; give a mesh that exists");
  }
  const bool is_hidden = status.type() != fs::file_type::not_found && error != std::errc::filename_too_long;
  if (is_hidden) return pliant::load_scene(arguments.scene, arguments.overrides);  // says what is wrong with it
  const std::string suggestion = pliant::did_you_mean(arguments.scene, names);
  pliant::fail_input(fmt::format("unknown scene '{}': neither a file nor a built-in scene{}",
                                 pliant::printable_place(arguments.scene),
                                 suggestion.empty() ? "; `pliant scenes` lists those" : suggestion));
}

void print_warnings(const pliant::Scene& scene) {
  for (const std::string& warning : scene.warnings) {
    print_to_stderr("warning: " + pliant::printable_place(warning, message_limit) + "\n");
  }
}

}  // namespace pliant_cli
