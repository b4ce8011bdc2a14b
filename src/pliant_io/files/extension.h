#pragma once
#include <filesystem>
#include <string>

namespace pliant {

/// The extension in small letters (of A to Z alone), without the point; "" where there is none.
std::string small_extension(const std::filesystem::path& path);

}  // namespace pliant
