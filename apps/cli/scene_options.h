#pragma once
// What the sub-commands that take a scene have in common.
#include <optional>

#include <CLI/CLI.hpp>

#include "choice_option.h"
#include "pliant/scene/scene.h"

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

/// An option whose value is a number; whole ones are written without point and exponent.
void add_number(CLI::App& command, const std::string& name, std::optional<std::int64_t>& number,
                const std::string& help);
void add_number(CLI::App& command, const std::string& name, std::optional<pliant::Index>& number,
                const std::string& help);
void add_number(CLI::App& command, const std::string& name, std::optional<pliant::Real>& number,
                const std::string& help);

}  // namespace pliant_cli
