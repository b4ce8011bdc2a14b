#pragma once
// --scale and --up, for every sub-command that reads a mesh file.
#include <CLI/CLI.hpp>

#include "choice_option.h"
#include "number_option.h"
#include "pliant_io/mesh/mesh_file.h"

namespace pliant_cli {

/// The command must not outlive `options`.
inline void add_import_options(CLI::App& command, pliant::ImportOptions& options) {
  add_number(command, "--scale", options.scale, "Meters per unit of the file: 0.001 where it counts in millimeters");
  add_choice(command, "--up", options.up, "The file's axis that points up, turned to +z: z, y or x");
}

}  // namespace pliant_cli
