#pragma once
// Input files, read whole.
#include <filesystem>
#include <string>

namespace pliant {

/// The bytes of a regular file. Anything else is refused, since a pipe or a device may never end.
/// @throws Error (input) with the path: missing, a directory, not a regular file, not readable.
std::string read_file(const std::filesystem::path& path);

}  // namespace pliant
