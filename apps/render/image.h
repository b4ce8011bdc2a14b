#pragma once
// Images in memory, as PNG files, and combined into contact sheets.
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace pliant_render {

/// 8-bit RGB in sRGB, three bytes per pixel, top row first, without padding between rows.
struct Image {
  int width = 0;                     ///< [pixels]
  int height = 0;                    ///< [pixels]
  std::vector<std::uint8_t> pixels;  ///< 3 x width x height bytes
};

/// Whether the image has at least one pixel and as many bytes as its size requires.
bool is_whole(const Image& image);

/// The bytes of a PNG file.
/// @throws pliant::Error (output) for an image of more than 2³¹ bytes; std::logic_error for an image that is not whole.
std::string encode_png(const Image& image);

/// Writes the file atomically: it is complete or absent.
/// @throws pliant::Error (output) with the path and the reason; std::logic_error for an image that is not whole.
void write_png(const std::filesystem::path& path, const Image& image);

/// Frames of one size, row by row from the top left, `gap` pixels around and between them. With fewer frames than
/// columns the sheet is as wide as the frames are.
/// @throws std::logic_error without frames, for frames of several sizes, for columns < 1 and gap < 0
Image contact_sheet(std::span<const Image> frames, int columns, int gap, std::array<std::uint8_t, 3> background);

}  // namespace pliant_render
