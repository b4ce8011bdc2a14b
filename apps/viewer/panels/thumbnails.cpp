#include "viewer/panels/thumbnails.h"

#include <webp/decode.h>

#include "viewer/recent_pictures.h"

namespace pliant_viewer {

std::optional<pliant_render::Image> thumbnail(std::string_view scene) {
  const std::span<const unsigned char> file = thumbnail_file(scene);
  pliant_render::Image image;
  if (WebPGetInfo(file.data(), file.size(), &image.width, &image.height) == 0) return {};
  const auto row = static_cast<std::size_t>(image.width) * 3;
  image.pixels.resize(row * static_cast<std::size_t>(image.height));
  if (WebPDecodeRGBInto(file.data(), file.size(), image.pixels.data(), image.pixels.size(), static_cast<int>(row)) ==
      nullptr) {
    return {};
  }
  return image;
}

const pliant_render::Texture* ThumbnailTextures::find(const std::string& scene, const std::filesystem::path& file) {
  const auto [place, is_new] = textures_.try_emplace(file.empty() ? scene : file.string());
  std::optional<pliant_render::Texture>& texture = place->second;
  if (is_new) {
    if (const auto image = file.empty() ? thumbnail(scene) : read_recent_picture(file)) {
      texture.emplace();
      pliant_render::set_up_texture(*texture, GL_RGB8, image->width, image->height, image->pixels.data());
    }
  }
  return texture ? &*texture : nullptr;
}

}  // namespace pliant_viewer
