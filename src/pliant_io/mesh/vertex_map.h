#pragma once
// One number for each vertex, from a file.
#include <filesystem>
#include <string_view>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Reads the numbers of a vertex map: a text with one number a line (`.txt`, `.csv`; what follows a # is a comment,
/// empty lines count for nothing), or a NumPy array of one dimension (`.npy`; floats, integers or truth values, little
/// end first). What the file holds decides, not its extension.
/// @throws Error (input), one line with the place and the remedy: a file that cannot be read, a line that is not one
///   finite number, an array of another type, order or dimension, one that is cut short, no number at all.
std::vector<Real> read_vertex_map(const std::filesystem::path& path);

/// The same from bytes in memory. `name` is what messages call them.
std::vector<Real> parse_vertex_map(std::string_view bytes, std::string_view name);

}  // namespace pliant
