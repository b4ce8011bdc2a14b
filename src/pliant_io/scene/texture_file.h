#pragma once
// Files of textures. They are decoded where they are drawn; exports hold their bytes as they are.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace pliant {

enum class TextureFormat { png, jpeg };

/// By the first bytes; none: another format.
std::optional<TextureFormat> texture_format(std::string_view bytes);

/// @throws Error (input) with the path: bytes that are neither PNG nor JPEG
void check_texture(const std::filesystem::path& path, std::string_view bytes);

/// By its first bytes alone. @throws Error (input) with the path: no file that can be read, or one of another format
void check_texture_file(const std::filesystem::path& path);

/// The bytes of a PNG or JPEG file. @throws Error (input) with the path: as read_file and check_texture do
std::string read_texture_file(const std::filesystem::path& path);

}  // namespace pliant
