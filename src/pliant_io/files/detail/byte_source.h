#pragma once
// The bytes of a file or of memory, read by their place. Private to the readers: they read in blocks, so that a large
// file is never in memory beside the mesh that it becomes.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "pliant_io/files/detail/file_system.h"

namespace pliant {

class ByteSource {
 public:
  /// Bytes in memory, which must outlive the source. `name` is what messages call them.
  ByteSource(std::string_view bytes, std::string_view name) : name_(name), bytes_(bytes), size_(bytes.size()) {}
  /// A regular file. Anything else is refused, since a pipe or a device may never end.
  /// @throws Error (input) with the path: missing, a directory, not a regular file, not readable.
  explicit ByteSource(const std::filesystem::path& path);
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  const std::string& name() const { return name_; }

  /// Of the file when it was opened; what is appended later does not count.
  std::uint64_t size() const { return size_; }

  /// Copies the bytes from `offset` on; fewer than `count` only at the end.
  std::size_t read(std::uint64_t offset, char* into, std::size_t count) const;

  /// Throws Error (input): `name: message`.
  [[noreturn]] void fail(std::string_view message) const;

 private:
  std::string name_;
  std::string_view bytes_;
  std::uint64_t size_ = 0;
  InputFile file_;  ///< not open for bytes in memory
};

}  // namespace pliant
