#pragma once
// The scenes that are part of the library: every scenes/*.json, as it stood when the library was built.
#include <span>
#include <string_view>

namespace pliant {

struct BuiltinScene {
  std::string_view name;  ///< the file's name without ".json"
  std::string_view text;  ///< the whole file, JSON
};

/// All built-in scenes in the order of their names; valid for the life of the program.
std::span<const BuiltinScene> builtin_scenes();

}  // namespace pliant
