#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <stb/stb_image.h>

#include "render/image.h"
#include "tests/mesh/meshes.h"
#include "tests/support/temporary_folder.h"

namespace test_image {

namespace fs = std::filesystem;
using namespace pliant_render;
using namespace pliant_tests;

namespace {

using Color = std::array<std::uint8_t, 3>;

/// Every pixel by its place.
template <class F>
Image image_of(int width, int height, F&& color_at) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Color color = color_at(x, y);
      for (const std::uint8_t byte : color) image.pixels.push_back(byte);
    }
  }
  return image;
}

Image plain(int width, int height, Color color) {
  return image_of(width, height, [&](int, int) { return color; });
}

Color pixel(const Image& image, int x, int y) {
  const std::size_t first =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return {image.pixels[first], image.pixels[first + 1], image.pixels[first + 2]};
}

Image read_png(const fs::path& path) {
  Image image;
  int channels = 0;
  const std::string file = TemporaryFolder::read(path);
  stbi_uc* pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()), static_cast<int>(file.size()),
                                          &image.width, &image.height, &channels, 0);
  REQUIRE(pixels != nullptr);
  CHECK(channels == 3);
  image.pixels.assign(pixels, pixels + static_cast<std::ptrdiff_t>(image.width) * image.height * 3);
  stbi_image_free(pixels);
  return image;
}

Color gradient(int x, int y) {
  return {static_cast<std::uint8_t>(37 * x + y), static_cast<std::uint8_t>(x * y), static_cast<std::uint8_t>(255 - y)};
}

constexpr Color black = {0, 0, 0};
constexpr Color white = {255, 255, 255};

}  // namespace

TEST_CASE("a PNG file holds the pixels that were written, for odd sizes too") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.png";
  for (const std::array<int, 2> size : {std::array{1, 1}, std::array{7, 5}, std::array{640, 3}, std::array{33, 257}}) {
    const Image image = image_of(size[0], size[1], gradient);
    write_png(path, image);
    const Image read = read_png(path);
    CHECK(read.width == image.width);
    CHECK(read.height == image.height);
    CHECK(read.pixels == image.pixels);
  }
  CHECK(folder.file_count() == 1);
}

TEST_CASE("a PNG file that cannot be written is an output error, and leaves nothing") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "absent" / "a.png";
  const std::string message = error_of([&] { write_png(path, plain(2, 2, white)); }, pliant::ErrorKind::output);
  CHECK(contains(message, path.string() + ": cannot be written: No such file or directory;"));
  CHECK_THROWS_AS(write_png(folder.path() / "a.png", Image{2, 2, {}}), std::logic_error);
  CHECK(folder.file_count() == 0);
}

TEST_CASE("a contact sheet shows its frames row by row, with gaps around and between") {
  constexpr Color ground = {9, 8, 7};
  std::vector<Image> frames;
  for (std::uint8_t i = 0; i < 5; ++i) frames.push_back(plain(4, 3, {static_cast<std::uint8_t>(100 + i), i, 0}));
  const Image sheet = contact_sheet(frames, 3, 2, ground);
  REQUIRE(is_whole(sheet));
  CHECK(sheet.width == 3 * 4 + 4 * 2);
  CHECK(sheet.height == 2 * 3 + 3 * 2);
  for (int y = 0; y < sheet.height; ++y) {
    for (int x = 0; x < sheet.width; ++x) {
      const bool in_frame = x % 6 >= 2 && y % 5 >= 2;
      const int frame = x / 6 + y / 5 * 3;
      const Color expected = in_frame && frame < 5 ? pixel(frames[static_cast<std::size_t>(frame)], 0, 0) : ground;
      CHECK(pixel(sheet, x, y) == expected);
    }
  }
  const Image few = contact_sheet(std::span(frames).first(2), 6, 0, ground);
  CHECK(few.width == 8);
  CHECK(few.height == 3);
}

TEST_CASE("frames of several sizes make no contact sheet, nor do none") {
  const std::vector<Image> frames = {plain(4, 3, white), plain(3, 4, white)};
  CHECK_THROWS_AS(contact_sheet(frames, 2, 0, black), std::logic_error);
  CHECK_THROWS_AS(contact_sheet({}, 2, 0, black), std::logic_error);
  CHECK_THROWS_AS(contact_sheet(std::span(frames).first(1), 0, 0, black), std::logic_error);
}

}  // namespace test_image
