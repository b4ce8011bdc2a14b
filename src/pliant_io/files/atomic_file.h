#pragma once
// Files that are whole or absent, even after a loss of power: written under a temporary name in the same folder,
// renamed when complete and on the disk.
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace pliant {

/// An output file that takes its name only at commit(). Without it, the temporary is removed and what stood under the
/// name stays. Links are followed; a name that stands for anything but a regular file is refused.
class AtomicFile {
 public:
  /// Opens the temporary, `path` with ".tmp-0" (or the first free number) behind it.
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
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_path_;
  std::FILE* file_ = nullptr;
};

/// Writes a file in one go.
/// @throws Error (output) with the path and the system's reason.
void write_file_atomically(const std::filesystem::path& path, std::string_view contents);

}  // namespace pliant
