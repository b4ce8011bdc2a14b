#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "pliant_io/files/detail/file_system.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

std::error_code last_error() {
  return {errno, std::generic_category()};
}

/// Waits until the bytes are on the disk: a rename may get there before them, and a loss of power leave an empty file.
std::error_code sync(std::FILE* file) {
  while (fsync(fileno(file)) != 0) {
    if (errno == EINVAL) break;  // a file system that has no such thing
    if (errno != EINTR) return last_error();
  }
  return {};
}

/// Whether another process has the lock. Not all file systems know locks.
bool is_locked_elsewhere(int file) {
  return flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace

std::error_code InputFile::open(const fs::path& path) {
  close();
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return last_error();
  handle_ = file;
  struct stat status {};
  const bool is_regular = fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  size_ = is_regular ? static_cast<std::uint64_t>(status.st_size) : 0;
  if (is_regular) return {};
  close();
  return std::make_error_code(std::errc::not_supported);
}

std::size_t InputFile::read(std::uint64_t offset, char* into, std::size_t count, std::error_code& error) const {
  ssize_t size = -1;
  do {
    size = pread(static_cast<int>(handle_), into, count, static_cast<off_t>(offset));
  } while (size < 0 && errno == EINTR);
  error = size < 0 ? last_error() : std::error_code();
  return size < 0 ? 0 : static_cast<std::size_t>(size);
}

void InputFile::close() {
  if (is_open()) ::close(static_cast<int>(std::exchange(handle_, none)));
}

std::FILE* open_stream(const fs::path& path, const char* mode) {
  return std::fopen(path.c_str(), mode);
}

std::error_code create_locked_file(const fs::path& path, std::FILE*& file) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0) return last_error();
  // A process that removes leftovers may have come between.
  struct stat status {};
  if (is_locked_elsewhere(descriptor) || fstat(descriptor, &status) != 0 || status.st_nlink == 0) {
    close(descriptor);
    return std::make_error_code(std::errc::file_exists);
  }
  file = fdopen(descriptor, "wb");
  if (file != nullptr) return {};
  close(descriptor);
  return std::make_error_code(std::errc::not_enough_memory);
}

void close_and_remove(std::FILE* file, const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
  std::fclose(file);
}

std::error_code close_and_rename(std::FILE* file, const fs::path& from, const fs::path& to) {
  std::error_code error = sync(file);
  const int lock = fcntl(fileno(file), F_DUPFD_CLOEXEC, 0);
  if (std::fclose(file) != 0 && !error) error = last_error();
  if (!error) fs::rename(from, to, error);
  std::error_code ignored;
  if (error) fs::remove(from, ignored);
  if (lock >= 0) close(lock);
  return error;
}

bool remove_unlocked_file(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  // The lock is held meanwhile, so that the name stays that file's.
  struct stat opened {};
  struct stat named {};
  const bool is_left = flock(file, LOCK_EX | LOCK_NB) == 0 && fstat(file, &opened) == 0 && S_ISREG(opened.st_mode) &&
                       lstat(path.c_str(), &named) == 0 && named.st_dev == opened.st_dev &&
                       named.st_ino == opened.st_ino && unlink(path.c_str()) == 0;
  close(file);
  return is_left;
}

bool LockedFolder::lock(const fs::path& folder) {
  release();
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return false;
  if (is_locked_elsewhere(descriptor)) {
    close(descriptor);
    return false;
  }
  folder_ = folder;
  handle_ = descriptor;
  return true;
}

std::error_code LockedFolder::rename(const fs::path& to) {
  std::error_code error;
  fs::rename(folder_, to, error);
  if (!error) release();
  return error;
}

void LockedFolder::remove() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  release();
}

void LockedFolder::release() {
  if (is_locked()) close(static_cast<int>(std::exchange(handle_, none)));
}

}  // namespace pliant
