#include "system/system_file.h"

#include <cstdlib>
#include <fstream>

namespace pliant_system {

std::string value_of(const char* path, std::string_view name) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos || !line.starts_with(name)) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? std::string() : line.substr(begin);
  }
  return {};
}

std::int64_t kilobytes(const std::string& text) {
  return text.empty() ? 0 : 1024 * std::strtoll(text.c_str(), nullptr, 10);
}

}  // namespace pliant_system
