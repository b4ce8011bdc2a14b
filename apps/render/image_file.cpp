#include "render/image_file.h"

#include <limits>

#include <stb/stb_image.h>

namespace pliant_render {

std::optional<std::array<int, 2>> image_size(std::string_view bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return {};
  int width = 0, height = 0, channels = 0;
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const bool is_known = stbi_info_from_memory(data, static_cast<int>(bytes.size()), &width, &height, &channels) != 0;
  if (!is_known || width <= 0 || height <= 0) return {};
  return std::array{width, height};
}

}  // namespace pliant_render
