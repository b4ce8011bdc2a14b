#include "system/temporary_folder.h"

#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace pliant_system {

TemporaryFolder::TemporaryFolder(std::string_view name)
    : path_(std::filesystem::temp_directory_path() / fmt::format("{}-{}", name, getpid())) {
  std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace pliant_system
