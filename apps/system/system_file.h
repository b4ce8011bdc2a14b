#pragma once
// Files in which Linux tells about itself.
#include <cstdint>
#include <string>
#include <string_view>

namespace pliant_system {

/// What stands behind "name" and a colon in a file of lines like "name : value"; empty where there is none.
std::string value_of(const char* path, std::string_view name);

/// The bytes that a text such as "1234 kB" stands for; 0 if it holds no number.
std::int64_t kilobytes(const std::string& text);

}  // namespace pliant_system
