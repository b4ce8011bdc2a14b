#include "pliant_io/files/crc32.h"

#include <array>
#include <cstddef>

namespace pliant {

namespace {

constexpr std::uint32_t crc32_polynomial = 0xEDB88320;

/// How many bytes are taken at once ("slicing by 8").
constexpr std::size_t crc32_slices = 8;

/// Entry [k][b]: what a byte b leaves behind when k bytes of zero follow it.
constexpr auto crc32_tables = [] {
  std::array<std::array<std::uint32_t, 256>, crc32_slices> tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1U) ^ ((rest & 1U) * crc32_polynomial);
    tables[0][byte] = rest;
  }
  for (std::size_t k = 1; k < crc32_slices; ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[k - 1][byte];
      tables[k][byte] = (before >> 8U) ^ tables[0][before & 0xFFU];
    }
  }
  return tables;
}();

std::uint32_t byte_at(std::string_view bytes, std::size_t place) {
  return static_cast<unsigned char>(bytes[place]);
}

}  // namespace

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t rest = ~std::uint32_t{0};
  for (; bytes.size() >= crc32_slices; bytes.remove_prefix(crc32_slices)) {
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < crc32_slices; ++k) {
      const std::uint32_t mixed = k < 4 ? (rest >> (8 * k)) & 0xFFU : 0;
      next ^= crc32_tables[crc32_slices - 1 - k][byte_at(bytes, k) ^ mixed];
    }
    rest = next;
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    rest = (rest >> 8U) ^ crc32_tables[0][(rest ^ byte_at(bytes, i)) & 0xFFU];
  }
  return ~rest;
}

}  // namespace pliant
