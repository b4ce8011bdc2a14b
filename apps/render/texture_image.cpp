#include "render/texture_image.h"

#include <limits>
#include <memory>

#include <fmt/format.h>
#include <stb/stb_image.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/scene/texture_file.h"

namespace pliant_render {
namespace {

constexpr int texture_channels = 4;

const stbi_uc* start_of(std::string_view bytes) {
  return reinterpret_cast<const stbi_uc*>(bytes.data());  // NOLINT: as stb takes bytes
}

[[noreturn]] void fail_on(std::string_view name, std::string_view what) {
  pliant::fail_input(fmt::format("{}: {}", pliant::printable_place(std::string(name)), what));
}

}  // namespace

std::array<int, 2> texture_size(std::string_view bytes, std::string_view name) {
  pliant::check_texture(std::filesystem::path(name), bytes);
  int width = 0, height = 0, ignored = 0;
  const bool is_short = bytes.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (!is_short ||
      stbi_info_from_memory(start_of(bytes), static_cast<int>(bytes.size()), &width, &height, &ignored) == 0 ||
      width < 1 || height < 1) {
    fail_on(name, "the picture is broken, or of a kind that is not read; save it again as PNG or JPEG");
  }
  if (std::max(width, height) > most_texture_pixels) {
    fail_on(name, fmt::format("{} x {} pixels are more than {} along a side; make the picture smaller", width, height,
                              most_texture_pixels));
  }
  return {width, height};
}

TextureImage decode_texture(std::string_view bytes, std::string_view name) {
  const auto [width, height] = texture_size(bytes, name);
  TextureImage image{width, height, {}};
  int ignored = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(start_of(bytes), static_cast<int>(bytes.size()), &image.width, &image.height, &ignored,
                            texture_channels),
      stbi_image_free);
  if (!pixels)
    fail_on(name, fmt::format("the picture is broken ({}); save it again", pliant::printable(stbi_failure_reason())));
  const auto count = texture_channels * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.pixels.assign(pixels.get(), pixels.get() + count);
  return image;
}

TextureImage read_texture(const std::filesystem::path& path) {
  return decode_texture(pliant::read_texture_file(path), path.string());
}

}  // namespace pliant_render
