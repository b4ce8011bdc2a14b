// pliant scenes: the built-in scenes and what to watch in them.
#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "commands.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/scene.h"

namespace pliant_cli {

void add_scenes_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("scenes", "List the built-in scenes");
  command->callback([] {
    std::size_t width = 0;
    for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) width = std::max(width, scene.name.size());
    for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) {
      fmt::print("{:<{}}  {}\n", scene.name, width, pliant::scene_description(scene.text, scene.name));
    }
  });
}

}  // namespace pliant_cli
