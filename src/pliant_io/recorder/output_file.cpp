#include "pliant_io/recorder/output_file.h"

#include <cerrno>
#include <system_error>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/detail/file_system.h"

namespace pliant {

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)) {
  open("wb");
}

OutputFile::OutputFile(std::filesystem::path path, std::uintmax_t kept_bytes) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::resize_file(path_, kept_bytes, error);
  if (error) fail(error.value());
  open("r+b");
  if (std::fseek(file_.get(), 0, SEEK_END) != 0) fail(errno);
}

void OutputFile::open(const char* mode) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path_, ignored);
  if (std::filesystem::is_fifo(status)) fail(EINVAL);  // opening it would wait for a reader
  file_.reset(open_stream(path_, mode));
  if (!file_) fail(errno);
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail(errno);
}

void OutputFile::write_at_start(std::string_view bytes) {
  if (std::fseek(file_.get(), 0, SEEK_SET) != 0) fail(errno);
  write(bytes);
  if (std::fseek(file_.get(), 0, SEEK_END) != 0) fail(errno);
}

void OutputFile::flush() {
  if (std::fflush(file_.get()) != 0) fail(errno);
}

void OutputFile::fail(int error_number) const {
  throw Error(ErrorKind::output,
              fmt::format("{}: cannot be written: {}; choose another place or make room",
                          printable_place(path_.string()), std::generic_category().message(error_number)));
}

}  // namespace pliant
