#pragma once
// The parts of USD as text (OpenUSD, usda 1.0) that all prims are written with.
#include <set>
#include <string>
#include <string_view>

#include "pliant_io/files/atomic_file.h"

namespace pliant {

/// Text with an indentation, handed to the file in blocks.
class UsdText {
 public:
  explicit UsdText(AtomicFile& file) : file_(file) {}

  void line(std::string_view text);
  void open(std::string_view head, std::string_view bracket = "{");
  void close(std::string_view bracket = "}");
  void flush();

 private:
  AtomicFile& file_;
  std::string buffer_;
  std::size_t depth_ = 0;
};

/// In quotes, on one line, as valid UTF-8.
std::string usd_string(std::string text);

/// Names of prims: a letter or _, then letters, digits and _, each once among its siblings.
class PrimNames {
 public:
  std::string name(std::string_view text);

 private:
  std::set<std::string> used_;
};

}  // namespace pliant
