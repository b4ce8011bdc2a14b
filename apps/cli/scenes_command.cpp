// pliant scenes: the built-in scenes and what to watch in them.
#include <algorithm>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/scene.h"

namespace pliant_cli {
namespace {

void list_scenes() {
  std::size_t width = 0;
  for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) width = std::max(width, scene.name.size());
  for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) {
    fmt::print("{:<{}}  {}\n", scene.name, width, pliant::scene_description(scene.text, scene.name));
  }
}

void list_scenes_as_json() {
  nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
  for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) {
    scenes.push_back({{"name", scene.name}, {"description", pliant::scene_description(scene.text, scene.name)}});
  }
  fmt::print("{}\n", scenes.dump(2));
}

}  // namespace

void add_scenes_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("scenes", "List the built-in scenes");
  const auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "As JSON, for programs: a list of names and descriptions");
  command->footer("`pliant check NAME --scene` prints the file of a scene.");
  command->callback([as_json] { *as_json ? list_scenes_as_json() : list_scenes(); });
}

}  // namespace pliant_cli
