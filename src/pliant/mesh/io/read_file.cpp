#include "pliant/mesh/io/read_file.h"

#include "pliant/mesh/io/detail/byte_source.h"

namespace pliant {

std::string read_file(const std::filesystem::path& path) {
  const ByteSource source(path);
  std::string bytes(static_cast<std::size_t>(source.size()), '\0');
  source.read(0, bytes.data(), bytes.size());
  return bytes;
}

}  // namespace pliant
