#pragma once
// Folders of files that belong together and are there as a whole or not at all.
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

namespace pliant {

class LockedFolder;

/// A folder that takes its name only at commit(). Without it, it is removed and what stood under the name stays. While
/// it is filled it is locked: one without a lock was left by a process that was killed, and the next writer removes it.
class AtomicFolder {
 public:
  /// Makes the folder, `path` with ".pliant.tmp-0" (or the first free number) behind it. `is_ours` says which names
  /// files in it have; a folder that holds any other is never replaced.
  /// @throws Error (output) with the path and the reason, as do all members.
  AtomicFolder(const std::filesystem::path& path, std::function<bool(std::string_view name)> is_ours);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Where to write its files until commit().
  const std::filesystem::path& temporary_path() const { return temporary_path_; }

  /// Gives the folder its name, in place of one that stood there. To be called once, last.
  void commit();

 private:
  void make_temporary();
  void check_replaceable(const std::filesystem::path& folder) const;
  [[noreturn]] void fail(std::string_view reason) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_path_;
  std::function<bool(std::string_view)> is_ours_;
  std::unique_ptr<LockedFolder> lock_;  ///< of the folder under its temporary name
};

}  // namespace pliant
