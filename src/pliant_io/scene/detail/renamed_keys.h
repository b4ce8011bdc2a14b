#pragma once
// Keys of scenes that have another name since a version: the old one is still read for one version, with a warning.
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// Gives each key of an old name its new one; messages about its value keep the old. A warning for each is added.
/// @throws Error(input) where both stand.
void rename_old_keys(Document& document, std::vector<std::string>& warnings);

/// A path as set_value takes it, in new names. `name` is what a warning calls the option that has it.
std::string rename_old_path(std::string_view path, std::string_view name, std::vector<std::string>& warnings);

}  // namespace pliant
