#pragma once
// Pictures in PNG and JPEG, as textures of bodies.
#include <filesystem>
#include <string_view>

#include "render/image.h"

namespace pliant_render {

/// 8-bit RGBA in sRGB, four bytes per pixel, top row first. Opaque where the file has no transparency.
struct TextureImage {
  int width = 0;                     ///< [pixels]
  int height = 0;                    ///< [pixels]
  std::vector<std::uint8_t> pixels;  ///< 4 x width x height bytes
};

inline constexpr int most_texture_pixels = 8192;  ///< along a side

/// @throws pliant::Error (input) with the name: bytes that are no whole picture, one of more than most_texture_pixels
TextureImage decode_texture(std::string_view bytes, std::string_view name);
/// Width and height, without reading more than the head; throws as decode_texture does.
std::array<int, 2> texture_size(std::string_view bytes, std::string_view name);
/// Reads a file and decodes it; throws as read_texture_file and decode_texture do.
TextureImage read_texture(const std::filesystem::path& path);

}  // namespace pliant_render
