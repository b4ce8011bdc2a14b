#include "pliant_io/files/atomic_folder.h"

#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/detail/file_system.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

constexpr int max_folder_attempts = 1000;

fs::path with_mark(const fs::path& path, std::string_view mark) {
  fs::path marked = path;
  marked += fmt::format(".pliant.tmp-{}", mark);
  return marked;
}

}  // namespace

AtomicFolder::AtomicFolder(const fs::path& path, std::function<bool(std::string_view)> is_ours)
    : path_(path), is_ours_(std::move(is_ours)), lock_(std::make_unique<LockedFolder>()) {
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
      if (!lock_->lock(temporary_path_)) continue;
      check_replaceable(temporary_path_);
      lock_->remove();
      if (!fs::create_directory(temporary_path_, error)) continue;
    }
    if (lock_->lock(temporary_path_)) return;
  }
  fail("too many folders of this name are being written");
}

AtomicFolder::~AtomicFolder() {
  if (lock_->is_locked()) lock_->remove();
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
  error = lock_->rename(path_);
  if (error) {
    std::error_code ignored;
    if (is_there) fs::rename(aside, path_, ignored);
    fail(error.message());
  }
  if (is_there) fs::remove_all(aside, error);
}

void AtomicFolder::fail(std::string_view reason) const {
  throw Error(ErrorKind::output, fmt::format("{}: this folder cannot be written: {}; choose another place or make room",
                                             printable_place(path_.string()), reason));
}

}  // namespace pliant
