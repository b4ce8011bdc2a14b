// pliant schema: what a scene file may hold, for editors and validators.
#include <fmt/format.h>

#include "commands.h"
#include "pliant_io/scene/schema.h"

namespace pliant_cli {

void add_schema_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("schema", "Print the JSON Schema of scene files");
  command->footer("Example:\n  pliant schema > scene.schema.json");
  command->callback([] { fmt::print("{}", pliant::scene_schema()); });
}

}  // namespace pliant_cli
