#pragma once
// Checkpoints made by hand, with a sum that fits.
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "pliant_io/files/crc32.h"

namespace pliant_tests {

/// The file of a format's version with that content, as checkpoint_file.h describes it.
inline std::string checkpoint_bytes(std::string_view content, std::uint32_t version) {
  const auto bytes_of = [](auto number) {
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    return bytes;
  };
  const std::uint32_t sum = pliant::crc32(bytes_of(version).append(content));
  return "PLIANTCP" + bytes_of(version) + bytes_of(sum) + bytes_of(std::uint64_t{content.size()}) +
         std::string(content);
}

}  // namespace pliant_tests
