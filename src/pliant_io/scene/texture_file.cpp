#include "pliant_io/scene/texture_file.h"

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

std::string read_texture_file(const std::filesystem::path& path) {
  std::string bytes = read_file(path);
  check_texture(path, bytes);
  return bytes;
}

}  // namespace pliant
