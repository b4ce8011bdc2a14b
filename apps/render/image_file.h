#pragma once
// Pictures in the bytes of their files.
#include <array>
#include <optional>
#include <string_view>

namespace pliant_render {

/// Width and height of a PNG or JPEG picture [pixels], by the head of its file; none: it is not one, or damaged there.
std::optional<std::array<int, 2>> image_size(std::string_view bytes);

}  // namespace pliant_render
