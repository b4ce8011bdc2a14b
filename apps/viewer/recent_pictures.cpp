#include "viewer/recent_pictures.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "pliant_io/files/crc32.h"
#include "render/texture_image.h"

namespace pliant_viewer {
namespace {

namespace fs = std::filesystem;

void remove_oldest(const fs::path& folder) {
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".png") files.emplace_back(entry.last_write_time(), entry.path());
  }
  std::ranges::sort(files, std::greater{});
  for (std::size_t i = most_recent_pictures; i < files.size(); ++i) fs::remove(files[i].second);
}

}  // namespace

fs::path recent_pictures_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && fs::path(cache).is_absolute()) return fs::path(cache) / "pliant" / "pictures";
  const char* home = std::getenv("HOME");
  if (home == nullptr || !fs::path(home).is_absolute()) return {};
  return fs::path(home) / ".cache" / "pliant" / "pictures";
}

fs::path recent_picture_file(const fs::path& folder, const fs::path& shown) {
  if (folder.empty()) return {};
  fs::path whole = fs::absolute(shown).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();  // out/flag/
  const std::string name = whole.string();
  return folder / fmt::format("{:08x}-{}.png", pliant::crc32(name), name.size());
}

void keep_recent_picture(const fs::path& folder, const fs::path& shown, const pliant_render::Image& picture) {
  try {
    if (folder.empty() || !fs::exists(shown)) return;
    fs::create_directories(folder);
    write_png(recent_picture_file(folder, shown), picture);
    remove_oldest(folder);
  } catch (const std::exception&) {
    return;
  }
}

std::optional<pliant_render::Image> read_recent_picture(const fs::path& file) {
  try {
    if (!fs::exists(file)) return {};
    const pliant_render::TextureImage read = pliant_render::read_texture(file);
    pliant_render::Image image{read.width, read.height, {}};
    image.pixels.reserve(read.pixels.size() / 4 * 3);
    for (std::size_t i = 0; i < read.pixels.size(); ++i) {
      if (i % 4 != 3) image.pixels.push_back(read.pixels[i]);
    }
    return image;
  } catch (const std::exception&) {
    return {};
  }
}

pliant_render::Image halved(const pliant_render::Image& image) {
  if (!is_whole(image)) throw std::logic_error("halved: the image is not whole");
  pliant_render::Image half{image.width / 2, image.height / 2, {}};
  const auto at = [&](int x, int y, int channel) {
    const auto place =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 3 +
        static_cast<std::size_t>(channel);
    return static_cast<int>(image.pixels[place]);
  };
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      for (int k = 0; k < 3; ++k) {
        const int sum =
            at(2 * x, 2 * y, k) + at(2 * x + 1, 2 * y, k) + at(2 * x, 2 * y + 1, k) + at(2 * x + 1, 2 * y + 1, k);
        half.pixels.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
      }
    }
  }
  return half;
}

}  // namespace pliant_viewer
