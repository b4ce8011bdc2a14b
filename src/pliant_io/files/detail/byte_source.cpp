#include "pliant_io/files/detail/byte_source.h"

#include <algorithm>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

/// Before a file is opened: opening alone may wait, or set a device going.
void refuse_other_than_files(const ByteSource& source, const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const bool is_missing = status.type() == fs::file_type::not_found || error == std::errc::filename_too_long;
  if (is_missing) source.fail("no such file; check the path");
  if (error) source.fail(fmt::format("cannot be read: {}; check its permissions", error.message()));
  if (fs::is_directory(status)) source.fail("is a directory; give the path of a file in it");
  if (!fs::is_regular_file(status)) source.fail("is not a regular file; copy its contents to one");
}

}  // namespace

ByteSource::ByteSource(const fs::path& path) : name_(path.string()) {
  refuse_other_than_files(*this, path);
  const std::error_code error = file_.open(path);
  if (error == std::errc::not_supported) fail("is not a regular file; copy its contents to one");
  if (error) fail("cannot be opened; check its permissions");
  size_ = file_.size();
}

std::size_t ByteSource::read(std::uint64_t offset, char* into, std::size_t count) const {
  if (offset >= size_) return 0;
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset));
  if (!file_.is_open()) {
    std::memcpy(into, bytes_.data() + offset, wanted);
    return wanted;
  }
  for (std::size_t done = 0; done < wanted;) {
    std::error_code error;
    const std::size_t step = file_.read(offset + done, into + done, wanted - done, error);
    if (error) fail(fmt::format("cannot be read: {}; copy the file to another place", error.message()));
    if (step == 0) fail("cannot be read to its end; try again when nothing writes to it");
    done += step;
  }
  return wanted;
}

void ByteSource::fail(std::string_view message) const {
  fail_input(fmt::format("{}: {}", printable_place(name_), message));
}

}  // namespace pliant
