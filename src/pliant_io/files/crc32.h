#pragma once
#include <cstdint>
#include <string_view>

namespace pliant {

/// The CRC-32 of gzip and PNG (polynomial 0xEDB88320) of the bytes.
std::uint32_t crc32(std::string_view bytes);

}  // namespace pliant
