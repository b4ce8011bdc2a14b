#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <system_error>

#include "system/descriptor.h"

namespace pliant_system {

/// A file without a name on the disk of another: it is gone with the last process that has it open, however that ends.
class NamelessFile {
 public:
  /// On the disk of `target`, whose folder is there. @throws std::system_error
  explicit NamelessFile(const std::filesystem::path& target);

  /// Its number here, for ChildOptions::file.
  int number() const { return file_.number(); }

  /// Bytes from a place on; 0 at the end. @throws std::system_error
  std::size_t read(std::uint64_t place, std::span<char> into) const;

 private:
  Descriptor file_;
};

}  // namespace pliant_system
