#pragma once
// Small pictures of built-in scenes and of recent files, for the list of what can be opened.
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "render/gl_objects.h"
#include "render/image.h"

namespace pliant_viewer {

/// The picture of a built-in scene as a WebP file; empty where there is none.
std::span<const unsigned char> thumbnail_file(std::string_view scene);

/// The same as pixels; none where there is none.
std::optional<pliant_render::Image> thumbnail(std::string_view scene);

/// Textures with these pictures, made when they are first asked for. Needs a current OpenGL context.
class ThumbnailTextures {
 public:
  /// Of a built-in scene, or of the PNG file that is named. Null where there is no picture.
  const pliant_render::Texture* find(const std::string& scene, const std::filesystem::path& file = {});

 private:
  std::map<std::string, std::optional<pliant_render::Texture>> textures_;
};

}  // namespace pliant_viewer
