#include "pliant_io/files/crc32.h"

#include <zlib.h>

namespace pliant {

std::uint32_t crc32(std::string_view bytes) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());  // NOLINT: zlib's bytes are unsigned
  return static_cast<std::uint32_t>(crc32_z(0, data, bytes.size()));
}

}  // namespace pliant
