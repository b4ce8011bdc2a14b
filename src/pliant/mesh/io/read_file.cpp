#include "pliant/mesh/io/read_file.h"

#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  const auto fail = [&](std::string_view what) { fail_input(fmt::format("{}: {}", path.string(), what)); };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) fail("no such file; check the path");
  if (status.type() == fs::file_type::directory) fail("is a directory; give the path of a file in it");
  if (error) fail(fmt::format("cannot be read: {}; check its permissions", error.message()));
  if (status.type() != fs::file_type::regular) fail("is not a regular file; copy its contents to one");

  const auto size = fs::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) fail("cannot be opened; check its permissions");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) fail("cannot be read to its end; try again when nothing writes to it");
  return bytes;
}

}  // namespace pliant
