#include <cstdint>
#include <string>

#include <doctest/doctest.h>

#include "pliant_io/files/crc32.h"

namespace test_crc32 {

using pliant::crc32;

/// By its definition, bit by bit.
std::uint32_t bit_by_bit(const std::string& bytes) {
  std::uint32_t rest = 0xFFFFFFFF;
  for (const char byte : bytes) {
    rest ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1U) ^ ((rest & 1U) != 0 ? 0xEDB88320 : 0);
  }
  return ~rest;
}

TEST_CASE("the CRC-32 of gzip: published values") {
  CHECK(crc32("") == 0);
  CHECK(crc32("a") == 0xE8B7BE43);
  CHECK(crc32("123456789") == 0xCBF43926);
  CHECK(crc32("The quick brown fox jumps over the lazy dog") == 0x414FA339);
  CHECK(crc32(std::string(32, '\0')) == 0x190A55AD);
  CHECK(crc32(std::string(32, '\xff')) == 0xFF6CAB0B);
}

TEST_CASE("the CRC-32 of any number of bytes, those left over behind groups of eight too") {
  std::string bytes;
  for (unsigned i = 0; i < 300; ++i) {
    CAPTURE(i);
    CHECK(crc32(bytes) == bit_by_bit(bytes));
    bytes += static_cast<char>((i * i * 31U + 7U * i) & 0xFFU);
  }
}

}  // namespace test_crc32
