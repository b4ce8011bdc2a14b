#pragma once
// One writer a folder.
#include <filesystem>

namespace pliant_system {

/// Keeps other writers out of a folder, until this object and all processes that were started meanwhile are gone. The
/// lock is the system's and ends with its processes, however they end; `.pliant-lock` in the folder only tells the
/// others who has it. File systems without locks keep nobody out.
class FolderLock {
 public:
  /// @throws pliant::Error (output): the folder cannot be opened, or another process has it, which the message names by
  ///   its number and command; nothing was written then
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int folder_ = -1;
};

}  // namespace pliant_system
