#pragma once
// What the sub-commands that take a scene have in common.
#include <algorithm>
#include <optional>

#include <CLI/CLI.hpp>

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

/// An option whose value is one of the names of an enumeration.
template <class Choice>
void add_choice(CLI::App& command, const std::string& name, std::optional<Choice>& choice, const std::string& help) {
  constexpr auto names = choice_names(Choice{});
  const auto take = [&choice, names](const std::string& value) {
    choice = static_cast<Choice>(std::ranges::find(names, std::string_view(value)) - names.begin());
  };
  command.add_option_function<std::string>(name, take, help)
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
}

}  // namespace pliant_cli
