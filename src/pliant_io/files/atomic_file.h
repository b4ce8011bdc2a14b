#pragma once
// Files that are whole or absent, even after a loss of power: written under a temporary name in the same folder,
// renamed when complete and on the disk.
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>

namespace pliant {

/// An output file that takes its name only at commit(). Without it, the temporary is removed and what stood under the
/// name stays. Links are followed; a name that stands for anything but a regular file is refused. A temporary is locked
/// while it is written: one without a lock was left by a process that was killed, and the next writer of the same file
/// removes it.
class AtomicFile {
 public:
  /// Opens the temporary, `path` with ".pliant.tmp-0" (or the first free number) behind it.
  /// @throws Error (output) with the path and the system's reason, as do all members.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes.
  void write(std::string_view bytes);

  /// Closes the file and gives it its name, replacing what stood there. To be called once, last.
  void commit();

 private:
  [[noreturn]] void fail(const std::error_code& error) const;
  void open_temporary();

  std::filesystem::path path_;
  std::filesystem::path temporary_path_;
  std::FILE* file_ = nullptr;
};

/// Writes a file in one go.
/// @throws Error (output) with the path and the system's reason.
void write_file_atomically(const std::filesystem::path& path, std::string_view contents);

/// Removes the temporaries in a folder that killed processes left of files whose names `is_ours`; what another process
/// writes stays. Does not throw.
void remove_leftovers(const std::filesystem::path& folder, const std::function<bool(std::string_view name)>& is_ours);

}  // namespace pliant
