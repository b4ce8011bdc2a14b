#include "scene_options.h"

#include <filesystem>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant_cli {
namespace fs = std::filesystem;

void add_scene_arguments(CLI::App& command, SceneArguments& arguments) {
  command.add_option("scene", arguments.scene, "A scene file, or the name of a built-in scene")->required();
  command
      .add_option("--set", arguments.overrides.set,
                  "PATH=VALUE: take another value, such as settings.iterations=20, bodies[0].mass.total=2 or "
                  "'bodies[curtain].constraints[bend].stiffness=1e-3'; may be given several times")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->take_all();
}

void add_setting_options(CLI::App& command, SceneArguments& arguments) {
  pliant::SceneOverrides& overrides = arguments.overrides;
  add_number(command, "--steps", overrides.steps, "Steps to take");
  add_number(command, "--iterations", overrides.iterations, "Local and global steps in each step");
  add_number(command, "--time-step", overrides.time_step, "Length of a step [s]");
  add_number(command, "--tolerance", overrides.tolerance,
             "Iterate no further below this residual [N]; 0: only at exact rest");
  add_number(command, "--threads", overrides.threads, "0: one a processor; results do not depend on it");
  add_choice(command, "--backend", overrides.backend, "Library that factorizes: automatic, eigen or cholmod");
}

pliant::Scene open_scene(const SceneArguments& arguments) {
  std::error_code error;
  const fs::file_status status = fs::status(arguments.scene, error);
  if (fs::exists(status) && !fs::is_directory(status)) return pliant::load_scene(arguments.scene, arguments.overrides);
  std::vector<std::string_view> names;
  for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) {
    if (scene.name == arguments.scene) return pliant::parse_scene(scene.text, {}, scene.name, arguments.overrides);
    names.push_back(scene.name);
  }
  const bool is_hidden = status.type() != fs::file_type::not_found && error != std::errc::filename_too_long;
  if (is_hidden) return pliant::load_scene(arguments.scene, arguments.overrides);  // says what is wrong with it
  pliant::fail_input(
      fmt::format("{}: neither a file nor a built-in scene; `pliant scenes` lists those, the nearest first: {}",
                  pliant::printable_place(arguments.scene), pliant::nearest_names_text(arguments.scene, names)));
}

}  // namespace pliant_cli
