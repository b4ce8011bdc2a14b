#include "render/image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <stb/stb_image_write.h>

#include "pliant/core/atomic_file.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant_render {

namespace {

constexpr int channels = 3;

std::size_t byte_count(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

// ---- sRGB, IEC 61966-2-1

float linear_of(int code) {
  const double value = code / 255.0;
  return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

double code_of(double linear) {
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

/// Both ways by table. The steps of the way back are a fifth of a code in the dark, where codes lie closest.
struct TransferTables {
  static constexpr int steps = 1 << 14;
  std::array<float, 256> linear{};
  std::array<std::uint8_t, steps + 1> code{};

  TransferTables() {
    for (int i = 0; i < 256; ++i) linear[static_cast<std::size_t>(i)] = linear_of(i);
    for (int i = 0; i <= steps; ++i) {
      code[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(code_of(double(i) / steps)));
    }
  }

  std::uint8_t encoded(float light) const {
    return code[static_cast<std::size_t>(std::clamp(light, 0.0F, 1.0F) * float{steps} + 0.5F)];
  }
};

const TransferTables& transfer_tables() {
  static const TransferTables tables;
  return tables;
}

// ---- averages

/// The old pixels that a new one covers along one axis, and the parts that they have in it.
struct Cover {
  int first = 0;
  std::vector<float> weights;  ///< sum to 1
};

std::vector<Cover> covers_of(int old_size, int new_size) {
  // In units of 1 / new_size old pixels all ends are whole numbers.
  std::vector<Cover> covers(static_cast<std::size_t>(new_size));
  std::int64_t begin = 0;
  for (Cover& cover : covers) {
    const std::int64_t end = begin + old_size;
    cover.first = static_cast<int>(begin / new_size);
    for (std::int64_t pixel = cover.first; pixel * new_size < end; ++pixel) {
      const std::int64_t shared = std::min(end, (pixel + 1) * new_size) - std::max(begin, pixel * new_size);
      cover.weights.push_back(static_cast<float>(static_cast<double>(shared) / old_size));
    }
    begin = end;
  }
  return covers;
}

/// Adds `weight` times the averages along one old row to a row of linear light.
void add_row(const std::uint8_t* old_row, const std::vector<Cover>& covers, float weight, std::vector<float>& row) {
  const std::array<float, 256>& linear = transfer_tables().linear;
  float* sum = row.data();
  for (const Cover& cover : covers) {
    const std::uint8_t* pixel = old_row + byte_count(cover.first, 1);
    for (const float part : cover.weights) {
      for (int c = 0; c < channels; ++c) sum[c] += weight * part * linear[pixel[c]];
      pixel += channels;
    }
    sum += channels;
  }
}

}  // namespace

bool is_whole(const Image& image) {
  return image.width > 0 && image.height > 0 && image.pixels.size() == byte_count(image.width, image.height);
}

void write_png(const std::filesystem::path& path, const Image& image) {
  require(is_whole(image), "write_png: the image is not whole");
  const auto fail = [&](const char* why) {
    throw pliant::Error(pliant::ErrorKind::output,
                        fmt::format("{}: cannot be written: {}", pliant::printable_place(path.string()), why));
  };
  // stb counts in int, with one byte more a row.
  if (byte_count(image.width, image.height) + static_cast<std::size_t>(image.height) >
      static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    fail("the picture has more than 2^31 bytes; choose a smaller size");
  }
  std::string file;
  const auto append = [](void* context, void* bytes, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &file, image.width, image.height, channels, image.pixels.data(), 0) == 0) {
    throw std::bad_alloc();
  }
  pliant::write_file_atomically(path, file);
}

Image scaled_down(const Image& image, int width, int height) {
  require(is_whole(image), "scaled_down: the image is not whole");
  require(width >= 1 && width <= image.width && height >= 1 && height <= image.height,
          "scaled_down: not a smaller size");
  const std::vector<Cover> columns = covers_of(image.width, width);
  const std::vector<Cover> rows = covers_of(image.height, height);
  const std::size_t old_stride = byte_count(image.width, 1);
  Image result{width, height, {}};
  result.pixels.reserve(byte_count(width, height));
  std::vector<float> light(byte_count(width, 1));
  for (const Cover& row : rows) {
    std::fill(light.begin(), light.end(), 0.0F);
    const std::uint8_t* old_row = image.pixels.data() + old_stride * static_cast<std::size_t>(row.first);
    for (const float weight : row.weights) {
      add_row(old_row, columns, weight, light);
      old_row += old_stride;
    }
    for (const float value : light) result.pixels.push_back(transfer_tables().encoded(value));
  }
  return result;
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
