#pragma once
// How a mesh file is read, for every sub-command that reads one.
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "choice_option.h"
#include "number_option.h"
#include "pliant_io/mesh/mesh_file.h"

namespace pliant_cli {

/// The command must not outlive `options`.
inline void add_import_options(CLI::App& command, pliant::ImportOptions& options) {
  add_number(command, "--scale", options.scale, "Meters per unit of the file: 0.001 where it counts in millimeters");
  add_choice(command, "--up", options.up, "The file's axis that points up, turned to +z: z, y or x");
}

/// The options and their values that say the same on another command line; none for a mesh that is taken as it is.
inline std::vector<std::pair<std::string, std::string>> import_arguments(const pliant::ImportOptions& options) {
  const pliant::ImportOptions plain;
  std::vector<std::pair<std::string, std::string>> arguments;
  if (options.scale != plain.scale) arguments.emplace_back("--scale", fmt::format("{}", options.scale));
  if (options.up != plain.up) {
    arguments.emplace_back("--up", choice_names(options.up)[static_cast<std::size_t>(options.up)]);
  }
  if (options.drop_loose) arguments.emplace_back("--drop-loose", "true");
  return arguments;
}

/// --scale, --up and --drop-loose, for every sub-command that simulates a mesh file.
inline void add_simulated_import_options(CLI::App& command, pliant::ImportOptions& options) {
  add_import_options(command, options);
  command.add_flag("--drop-loose", options.drop_loose, "Leave out the mesh's vertices that no element has");
}

}  // namespace pliant_cli
