#include "pliant_io/files/atomic_file.h"

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

/// More leftovers of killed runs than this in one folder are a sign of something else.
constexpr int max_attempts = 1000;

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
  for (int attempt = 0; file_ == nullptr && attempt < max_attempts; ++attempt) {
    temporary_path_ = path_;
    temporary_path_ += fmt::format(".tmp-{}", attempt);
    file_ = std::fopen(temporary_path_.string().c_str(), "wbx");
    if (file_ == nullptr && errno != EEXIST) fail(errno);
  }
  if (file_ == nullptr) fail(EEXIST);
}

AtomicFile::~AtomicFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::error_code ignored;
  fs::remove(temporary_path_, ignored);
}

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(errno);
}

void AtomicFile::commit() {
  // A full disk may show only when the last buffer is flushed or the file is closed.
  if (std::fflush(file_) != 0) fail(errno);
  std::FILE* file = std::exchange(file_, nullptr);
  std::error_code error = sync(file);
  if (std::fclose(file) != 0 && !error) error = std::error_code(errno, std::generic_category());
  if (!error) fs::rename(temporary_path_, path_, error);
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

}  // namespace pliant
