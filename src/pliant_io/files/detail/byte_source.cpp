#include "pliant_io/files/detail/byte_source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant {

namespace {

std::string reason(int error_number) {
  return std::generic_category().message(error_number);
}

/// Before a file is opened: opening alone may wait, or set a device going.
void refuse_other_than_files(const ByteSource& source) {
  struct stat status {};
  if (stat(source.name().c_str(), &status) != 0) {
    const bool is_missing = errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG;
    if (is_missing) source.fail("no such file; check the path");
    source.fail(fmt::format("cannot be read: {}; check its permissions", reason(errno)));
  }
  if (S_ISDIR(status.st_mode)) source.fail("is a directory; give the path of a file in it");
  if (!S_ISREG(status.st_mode)) source.fail("is not a regular file; copy its contents to one");
}

}  // namespace

ByteSource::ByteSource(const std::filesystem::path& path) : name_(path.string()) {
  refuse_other_than_files(*this);
  file_ = open(name_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file_ < 0) fail("cannot be opened; check its permissions");
  struct stat status {};
  if (fstat(file_, &status) == 0 && S_ISREG(status.st_mode)) {
    size_ = static_cast<std::uint64_t>(status.st_size);
    return;
  }
  close(file_);
  fail("is not a regular file; copy its contents to one");
}

ByteSource::~ByteSource() {
  if (file_ >= 0) close(file_);
}

std::size_t ByteSource::read(std::uint64_t offset, char* into, std::size_t count) const {
  if (offset >= size_) return 0;
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset));
  if (file_ < 0) {
    std::memcpy(into, bytes_.data() + offset, wanted);
    return wanted;
  }
  std::size_t done = 0;
  while (done < wanted) {
    const ssize_t step = pread(file_, into + done, wanted - done, static_cast<off_t>(offset + done));
    if (step < 0 && errno == EINTR) continue;
    if (step < 0) fail(fmt::format("cannot be read: {}; copy the file to another place", reason(errno)));
    if (step == 0) fail("cannot be read to its end; try again when nothing writes to it");
    done += static_cast<std::size_t>(step);
  }
  return done;
}

void ByteSource::fail(std::string_view message) const {
  fail_input(fmt::format("{}: {}", printable_place(name_), message));
}

}  // namespace pliant
