#include "pliant_io/scene/texture_file.h"

#include <fstream>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/read_file.h"

namespace pliant {

std::optional<TextureFormat> texture_format(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return TextureFormat::png;
  if (bytes.starts_with("\xff\xd8\xff")) return TextureFormat::jpeg;
  return {};
}

void check_texture(const std::filesystem::path& path, std::string_view bytes) {
  if (texture_format(bytes)) return;
  fail_input(printable_place(path.string()) + ": not a picture in PNG or JPEG; convert it to one of these");
}

void check_texture_file(const std::filesystem::path& path) {
  constexpr std::size_t enough = 8;
  std::error_code ignored;
  std::ifstream file;
  if (std::filesystem::is_regular_file(path, ignored)) file.open(path, std::ios::binary);
  std::string bytes(enough, '\0');
  if (!file.is_open() || !file.read(bytes.data(), enough)) bytes = read_file(path);  // which says why it cannot be
  check_texture(path, bytes);
}

std::string read_texture_file(const std::filesystem::path& path) {
  std::string bytes = read_file(path);
  check_texture(path, bytes);
  return bytes;
}

}  // namespace pliant
