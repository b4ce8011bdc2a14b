#pragma once
// --scale and --up, for every sub-command that reads a mesh file.
#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "pliant/mesh/io/mesh_file.h"

namespace pliant_cli {

/// The command must not outlive `options`.
inline void add_import_options(CLI::App& command, pliant::ImportOptions& options) {
  command.add_option("--scale", options.scale, "Metres per unit of the file: 0.001 where it counts in millimetres");
  constexpr auto names = choice_names(pliant::UpAxis{});
  const auto take = [&options, names](const std::string& name) {
    options.up = static_cast<pliant::UpAxis>(std::ranges::find(names, std::string_view(name)) - names.begin());
  };
  command.add_option_function<std::string>("--up", take, "The file's axis that points up, turned to +z: z, y or x")
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
}

}  // namespace pliant_cli
