#include "pliant_io/files/atomic_folder.h"

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

constexpr int max_folder_attempts = 1000;

fs::path with_mark(const fs::path& path, std::string_view mark) {
  fs::path marked = path;
  marked += fmt::format(".pliant.tmp-{}", mark);
  return marked;
}

/// A descriptor that holds the lock of a folder, or -1 when another process has it. Not all file systems know locks.
int lock_folder(const fs::path& folder) {
  const int lock = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock < 0 || flock(lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return lock;
  close(lock);
  return -1;
}

}  // namespace

AtomicFolder::AtomicFolder(const fs::path& path, std::function<bool(std::string_view)> is_ours)
    : path_(path), is_ours_(std::move(is_ours)) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(path_, ignored))) check_replaceable(path_);
  make_temporary();
}

void AtomicFolder::make_temporary() {
  for (int attempt = 0; attempt < max_folder_attempts; ++attempt) {
    temporary_path_ = with_mark(path_, std::to_string(attempt));
    std::error_code error;
    if (!fs::create_directory(temporary_path_, error)) {
      if (error) fail(error.message());
      const int left = lock_folder(temporary_path_);
      if (left < 0) continue;
      check_replaceable(temporary_path_);
      fs::remove_all(temporary_path_, error);
      close(left);
      if (!fs::create_directory(temporary_path_, error)) continue;
    }
    lock_ = lock_folder(temporary_path_);
    if (lock_ >= 0) return;
  }
  fail("too many folders of this name are being written");
}

AtomicFolder::~AtomicFolder() {
  if (lock_ < 0) return;
  std::error_code ignored;
  fs::remove_all(temporary_path_, ignored);
  close(lock_);
}

void AtomicFolder::check_replaceable(const fs::path& folder) const {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) fail("a file of this name is there");
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    // A temporary of a file of ours is ours.
    if (!is_ours_(std::string_view(name).substr(0, name.find(".pliant.tmp-"))) || entry->is_directory(error)) {
      fail(fmt::format("it holds other files, {} for one", printable_place(name)));
    }
  }
  if (error) fail(error.message());
}

void AtomicFolder::commit() {
  const fs::path aside = with_mark(path_, "old");
  std::error_code error;
  const bool is_there = fs::exists(fs::symlink_status(path_, error));
  if (is_there) {
    check_replaceable(path_);
    fs::remove_all(aside, error);
    fs::rename(path_, aside, error);
    if (error) fail(error.message());
  }
  fs::rename(temporary_path_, path_, error);
  if (error) {
    std::error_code ignored;
    if (is_there) fs::rename(aside, path_, ignored);
    fail(error.message());
  }
  close(std::exchange(lock_, -1));
  if (is_there) fs::remove_all(aside, error);
}

void AtomicFolder::fail(std::string_view reason) const {
  throw Error(ErrorKind::output, fmt::format("{}: this folder cannot be written: {}; choose another place or make room",
                                             printable_place(path_.string()), reason));
}

}  // namespace pliant
