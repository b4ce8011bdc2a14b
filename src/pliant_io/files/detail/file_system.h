#pragma once
// What reading and writing files asks of the operating system beyond the standard library: files at any place, locks
// that end with their process, bytes that are on the disk. file_system_posix.cpp and file_system_windows.cpp have it;
// nothing else here knows the system.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace pliant {

/// A regular file, open for reading.
class InputFile {
 public:
  InputFile() = default;
  ~InputFile() { close(); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Does not wait for what may never come. @returns why not; std::errc::not_supported: it is no regular file
  std::error_code open(const std::filesystem::path& path);
  bool is_open() const { return handle_ != none; }

  /// Of the file when it was opened; what is appended later does not count.
  std::uint64_t size() const { return size_; }

  /// Bytes from a place on; 0 at the end of the file, fewer than `count` at any time.
  std::size_t read(std::uint64_t offset, char* into, std::size_t count, std::error_code& error) const;

 private:
  static constexpr std::intptr_t none = -1;
  void close();

  std::intptr_t handle_ = none;
  std::uint64_t size_ = 0;
};

/// std::fopen for any letters that names may have. @returns null, with the reason in errno
std::FILE* open_stream(const std::filesystem::path& path, const char* mode);

/// Makes a file that was not there and locks it until it is closed. @returns why not; std::errc::file_exists: the name
/// is taken
std::error_code create_locked_file(const std::filesystem::path& path, std::FILE*& file);

/// Closes a file of create_locked_file and removes it.
void close_and_remove(std::FILE* file, const std::filesystem::path& path);

/// Closes a file of create_locked_file when its bytes are on the disk, and gives it another name, replacing what stood
/// there. It stays locked until it has that name. On an error it is removed.
std::error_code close_and_rename(std::FILE* file, const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes a file that no process has locked. @returns whether it did; links, folders and devices it leaves alone
bool remove_unlocked_file(const std::filesystem::path& path);

/// The lock of a folder: one process at a time has it. Where a file system has no locks, any process gets it.
class LockedFolder {
 public:
  LockedFolder() = default;
  ~LockedFolder() { release(); }
  LockedFolder(const LockedFolder&) = delete;
  LockedFolder& operator=(const LockedFolder&) = delete;

  /// @returns false: another process has it, or there is no such folder
  bool lock(const std::filesystem::path& folder);
  bool is_locked() const { return handle_ != none; }

  /// Gives the folder another name and the lock up; on an error neither.
  std::error_code rename(const std::filesystem::path& to);
  /// Removes the folder and all in it, and gives the lock up.
  void remove();
  void release();

 private:
  static constexpr std::intptr_t none = -1;

  std::filesystem::path folder_;
  std::intptr_t handle_ = none;
};

}  // namespace pliant
