#pragma once
#include <filesystem>
#include <string_view>

namespace pliant_system {

/// A folder of this process among the system's temporary ones, which goes with this object and all in it.
class TemporaryFolder {
 public:
  /// "name-" and the process' number
  explicit TemporaryFolder(std::string_view name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace pliant_system
