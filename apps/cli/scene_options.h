#pragma once
// What the sub-commands that take a scene have in common.
#include <string>

#include <CLI/CLI.hpp>

#include "choice_option.h"
#include "number_option.h"
#include "pliant_io/scene/scene.h"

namespace pliant_cli {

/// A scene and the values that take the place of its own.
struct SceneArguments {
  std::string scene;
  pliant::SceneOverrides overrides;
};

/// Adds the scene and `--set` to a sub-command.
void add_scene_arguments(CLI::App& command, SceneArguments& arguments);

/// Adds the options that take the place of the scene's settings.
void add_setting_options(CLI::App& command, SceneArguments& arguments);

/// A file where there is one of that name, else a built-in scene; a folder hides none.
pliant::Scene open_scene(const SceneArguments& arguments);

}  // namespace pliant_cli
