#include "pliant_io/files/atomic_file.h"

#include <cerrno>
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

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  std::error_code error;
  const fs::path target = resolved(path, error);
  if (error) fail(error);
  path_ = target;
  std::error_code ignored;
  const fs::file_status status = fs::status(path_, ignored);
  if (fs::is_directory(status)) fail(std::make_error_code(std::errc::is_a_directory));
  // A rename would replace a device or a pipe, /dev/null for one, by a plain file.
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(std::make_error_code(std::errc::invalid_argument));
  open_temporary();
}

void AtomicFile::open_temporary() {
  for (int attempt = 0; attempt < max_attempts; ++attempt) {
    temporary_path_ = path_;
    temporary_path_ += fmt::format("{}{}", temporary_mark, attempt);
    std::error_code error = create_locked_file(temporary_path_, file_);
    if (error == std::errc::file_exists && remove_unlocked_file(temporary_path_)) {
      error = create_locked_file(temporary_path_, file_);
    }
    if (!error) return;
    if (error != std::errc::file_exists) fail(error);
  }
  fail(std::make_error_code(std::errc::file_exists));
}

AtomicFile::~AtomicFile() {
  if (file_ != nullptr) close_and_remove(file_, temporary_path_);
}

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail({errno, std::generic_category()});
}

void AtomicFile::commit() {
  // A full disk may show only when the last buffer is flushed or the file is closed.
  if (std::fflush(file_) != 0) fail({errno, std::generic_category()});
  const std::error_code error = close_and_rename(std::exchange(file_, nullptr), temporary_path_, path_);
  if (error) fail(error);
}

void AtomicFile::fail(const std::error_code& error) const {
  throw Error(ErrorKind::output, fmt::format("{}: cannot be written: {}; choose another place or make room",
                                             printable_place(path_.string()), error.message()));
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
    remove_unlocked_file(entry->path());
  }
}

}  // namespace pliant
