#include "pliant_io/files/atomic_file.h"

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

/// More leftovers of killed runs than this in one folder are a sign of something else.
constexpr int max_attempts = 1000;

constexpr std::string_view temporary_mark = ".pliant.tmp-";

/// As many links in a row as Linux follows.
constexpr int max_links = 40;

/// The file itself behind links, whether it is there yet or not, so that a rename replaces none of them.
fs::path resolved(fs::path path, std::error_code& error) {
  std::error_code ignored;
  for (int links = 0; fs::is_symlink(path, ignored); ++links) {
    if (links == max_links) {
      error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
      return path;
    }
    const fs::path target = fs::read_symlink(path, error);
    if (error) return path;
    path = path.parent_path() / target;
  }
  return path;
}

/// Waits until the bytes are on the disk: a rename may get there before them, and a loss of power leave an empty file.
std::error_code sync(std::FILE* file) {
  while (fsync(fileno(file)) != 0) {
    if (errno == EINVAL) break;  // a file system that has no such thing
    if (errno != EINTR) return {errno, std::generic_category()};
  }
  return {};
}

/// Makes a temporary and locks it. @returns a descriptor, or -1 with the reason in errno
int create_locked(const fs::path& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) return -1;
  // A process that removes leftovers may have come between. Not all file systems know locks.
  const bool is_taken = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  struct stat status {};
  if (!is_taken && fstat(file, &status) == 0 && status.st_nlink > 0) return file;
  close(file);
  errno = EEXIST;
  return -1;
}

/// Removes a temporary that no process writes any longer. The lock is held meanwhile, so that the name stays that
/// file's.
bool remove_if_left(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  struct stat opened {};
  struct stat named {};
  const bool is_left = flock(file, LOCK_EX | LOCK_NB) == 0 && fstat(file, &opened) == 0 && S_ISREG(opened.st_mode) &&
                       lstat(path.c_str(), &named) == 0 && named.st_dev == opened.st_dev &&
                       named.st_ino == opened.st_ino && unlink(path.c_str()) == 0;
  close(file);
  return is_left;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  std::error_code error;
  const fs::path target = resolved(path, error);
  if (error) fail(error.value());
  path_ = target;
  std::error_code ignored;
  const fs::file_status status = fs::status(path_, ignored);
  if (fs::is_directory(status)) fail(EISDIR);
  // A rename would replace a device or a pipe, /dev/null for one, by a plain file.
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(EINVAL);
  open_temporary();
}

void AtomicFile::open_temporary() {
  for (int attempt = 0; attempt < max_attempts; ++attempt) {
    temporary_path_ = path_;
    temporary_path_ += fmt::format("{}{}", temporary_mark, attempt);
    int file = create_locked(temporary_path_);
    int error = errno;
    if (file < 0 && error == EEXIST && remove_if_left(temporary_path_)) {
      file = create_locked(temporary_path_);
      error = errno;
    }
    if (file >= 0) {
      file_ = fdopen(file, "wb");
      if (file_ != nullptr) return;
      close(file);
      fail(ENOMEM);
    }
    if (error != EEXIST) fail(error);
  }
  fail(EEXIST);
}

AtomicFile::~AtomicFile() {
  if (file_ == nullptr) return;
  std::error_code ignored;
  fs::remove(temporary_path_, ignored);
  std::fclose(file_);
}

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(errno);
}

void AtomicFile::commit() {
  // A full disk may show only when the last buffer is flushed or the file is closed.
  if (std::fflush(file_) != 0) fail(errno);
  std::FILE* file = std::exchange(file_, nullptr);
  std::error_code error = sync(file);
  const int lock = fcntl(fileno(file), F_DUPFD_CLOEXEC, 0);  // the temporary stays locked until it has its name
  if (std::fclose(file) != 0 && !error) error = std::error_code(errno, std::generic_category());
  if (!error) fs::rename(temporary_path_, path_, error);
  if (lock >= 0) close(lock);
  if (!error) return;
  std::error_code ignored;
  fs::remove(temporary_path_, ignored);
  fail(error.value());
}

void AtomicFile::fail(int error_number) const {
  throw Error(ErrorKind::output,
              fmt::format("{}: cannot be written: {}; choose another place or make room",
                          printable_place(path_.string()), std::generic_category().message(error_number)));
}

void write_file_atomically(const fs::path& path, std::string_view contents) {
  AtomicFile file(path);
  file.write(contents);
  file.commit();
}

void remove_leftovers(const fs::path& folder, const std::function<bool(std::string_view name)>& is_ours) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const std::size_t mark = name.rfind(temporary_mark);
    if (mark == name.npos || !is_ours(std::string_view(name).substr(0, mark))) continue;
    remove_if_left(entry->path());
  }
}

}  // namespace pliant
