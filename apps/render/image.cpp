#include "render/image.h"

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <stb/stb_image_write.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"

namespace pliant_render {
namespace {

constexpr int channels = 3;

std::size_t byte_count(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace

bool is_whole(const Image& image) {
  return image.width > 0 && image.height > 0 && image.pixels.size() == byte_count(image.width, image.height);
}

std::string encode_png(const Image& image) {
  require(is_whole(image), "encode_png: the image is not whole");
  // stb counts in int, with one byte more a row.
  if (byte_count(image.width, image.height) + static_cast<std::size_t>(image.height) >
      static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw pliant::Error(pliant::ErrorKind::output,
                        "cannot be written: the picture has more than 2^31 bytes; choose a smaller size");
  }
  // Pictures have the same pattern of 4 by 4 pixels nearly everywhere (shaders::dithering): differences to the pixel
  // before are the shortest then, and patterns are found by a longer search.
  static const bool is_set_up = [] {
    stbi_write_force_png_filter = 1;
    stbi_write_png_compression_level = 32;
    return true;
  }();
  static_cast<void>(is_set_up);
  std::string file;
  const auto append = [](void* context, void* bytes, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &file, image.width, image.height, channels, image.pixels.data(), 0) == 0) {
    throw std::bad_alloc();
  }
  return file;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  std::string file;
  try {
    file = encode_png(image);
  } catch (const pliant::Error& error) {
    throw pliant::Error(error.kind(), fmt::format("{}: {}", pliant::printable_place(path.string()), error.what()));
  }
  pliant::write_file_atomically(path, file);
}

Image contact_sheet(std::span<const Image> frames, int columns, int gap, std::array<std::uint8_t, 3> background) {
  require(!frames.empty() && columns >= 1 && gap >= 0, "contact_sheet: no frames, no columns or a negative gap");
  const int width = frames[0].width;
  const int height = frames[0].height;
  for (const Image& frame : frames) {
    require(is_whole(frame) && frame.width == width && frame.height == height,
            "contact_sheet: frames of several sizes");
  }
  const int count = static_cast<int>(frames.size());
  columns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  Image sheet{columns * (width + gap) + gap, rows * (height + gap) + gap, {}};
  sheet.pixels.resize(byte_count(sheet.width, sheet.height));
  for (std::size_t i = 0; i < sheet.pixels.size(); ++i) sheet.pixels[i] = background[i % channels];
  for (int i = 0; i < count; ++i) {
    const Image& frame = frames[static_cast<std::size_t>(i)];
    const int left = gap + i % columns * (width + gap);
    const int top = gap + i / columns * (height + gap);
    for (int y = 0; y < height; ++y) {
      std::copy_n(frame.pixels.data() + byte_count(width, y), byte_count(width, 1),
                  sheet.pixels.data() + byte_count(sheet.width, top + y) + byte_count(left, 1));
    }
  }
  return sheet;
}

}  // namespace pliant_render
