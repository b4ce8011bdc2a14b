#pragma once
// The header of NumPy's array file (numpy.lib.format): magic bytes, a version, the length of a Python dictionary, and
// that dictionary; the numbers follow. Read and written here alone.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/files/detail/byte_source.h"

namespace pliant {

inline constexpr std::string_view npy_magic = "\x93NUMPY";

struct NpyHeader {
  std::string type;                 ///< of a number, as NumPy writes it: "<f8" is a double, little end first
  bool is_fortran_order = false;    ///< the first index runs fastest
  std::vector<std::int64_t> shape;  ///< counts ≥ 0, one per dimension; none for a single number
  std::uint64_t first_byte = 0;     ///< of the numbers
};

/// Reads a header of any version. Whether the numbers behind it are all there is for the caller to check.
/// @throws Error (input) `name: header: what; remedy`: other magic bytes, a header that is cut off or of more than
///   64 KiB, a key that is missing, a type of several fields, a shape that is not counts.
NpyHeader read_npy_header(const ByteSource& source);

/// A header of version 1.0. Its size is 128 bytes for any counts of up to three dimensions, so that it can be replaced
/// in place.
std::string npy_header(std::string_view type, std::span<const std::int64_t> shape);

}  // namespace pliant
