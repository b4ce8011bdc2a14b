#pragma once
// Pictures in memory, as PNG files, and put together.
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace pliant_render {

/// RGB of 8 bits each in sRGB, three bytes a pixel, the top row first and no padding between rows.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

/// Whether there is at least one pixel and as many bytes as the size says.
bool is_whole(const Image& image);

/// The bytes of a PNG file.
/// @throws pliant::Error (output) for an image of more than 2³¹ bytes; std::logic_error for one that is not whole.
std::string encode_png(const Image& image);

/// Writes the file in one go: it is whole or absent.
/// @throws pliant::Error (output) with the path and the reason; std::logic_error for an image that is not whole.
void write_png(const std::filesystem::path& path, const Image& image);

/// Frames of one size, row by row from the top left, `gap` pixels around and between them. With fewer frames than
/// columns the sheet is as wide as the frames are.
/// @throws std::logic_error without frames, for frames of several sizes, for columns < 1 and gap < 0
Image contact_sheet(std::span<const Image> frames, int columns, int gap, std::array<std::uint8_t, 3> background);

}  // namespace pliant_render
