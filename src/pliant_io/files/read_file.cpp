#include "pliant_io/files/read_file.h"

#include <exception>

#include <fmt/format.h>

#include "pliant_io/files/detail/byte_source.h"

namespace pliant {

std::string read_file(const std::filesystem::path& path) {
  const ByteSource source(path);
  std::string bytes;
  try {
    bytes.resize(static_cast<std::size_t>(source.size()));
  } catch (const std::exception&) {  // past the memory, or past what a string may hold
    source.fail(fmt::format("its {} bytes do not fit into memory; give a smaller file", source.size()));
  }
  source.read(0, bytes.data(), bytes.size());
  return bytes;
}

}  // namespace pliant
