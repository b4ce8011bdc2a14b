#pragma once
// What the header of a PLY file says about its rows.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pliant_io/files/detail/byte_source.h"

namespace pliant {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t byte_count(PlyType type);
bool is_float(PlyType type);

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyProperty {
  std::string name;
  PlyType type{};                     ///< of each number
  std::optional<PlyType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding{};
  std::vector<PlyElement> elements;
  std::uint64_t end = 0;  ///< offset of the first byte behind it
  std::int64_t line = 1;  ///< number of the line there
};

/// @throws Error (input): no PLY header, or one with a line, a type or a count that no reader knows.
PlyHeader read_ply_header(const ByteSource& source);

}  // namespace pliant
