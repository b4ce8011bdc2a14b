#pragma once
// The numbers of a PLY file's rows, from text and from binary data through the same members:
//
//   begin_row(i), end_row()   around each row of an element
//   take(type)                the next number
//   skip(property)            the next number or list
//   room(numbers, bytes)      how many things of so many numbers, so many bytes in all, the rest of the file can hold
//   fail(message)             throws Error (input) with the place
#include <array>
#include <bit>
#include <cstring>
#include <string_view>
#include <vector>

#include "pliant_io/mesh/detail/ply_header.h"
#include "pliant_io/mesh/detail/text_lexer.h"

namespace pliant {

class PlyTextRows {
 public:
  PlyTextRows(const ByteSource& source, const PlyHeader& header) : lexer_(source, {}, header.end, header.line) {}

  void begin_element(const PlyElement& element) { element_ = &element; }
  void begin_row(std::uint64_t row);
  void end_row();
  Real take(PlyType) { return lexer_.number_or_nan(next_word()); }
  void skip(const PlyProperty& property);
  std::uint64_t room(std::size_t numbers, std::size_t) const { return lexer_.remaining() / (2 * numbers) + 1; }
  [[noreturn]] void fail(std::string_view message) const { lexer_.fail(message); }
  /// Refuses what follows the last row.
  void finish();

 private:
  std::string_view next_word();

  TextLexer lexer_;
  const PlyElement* element_ = nullptr;
};

class PlyBinaryRows {
 public:
  PlyBinaryRows(const ByteSource& source, const PlyHeader& header);

  void begin_element(const PlyElement& element) { element_ = &element; }
  void begin_row(std::uint64_t row) { row_ = row; }
  void end_row() {}
  Real take(PlyType type);
  void skip(const PlyProperty& property);
  std::uint64_t room(std::size_t, std::size_t bytes) const { return remaining() / bytes; }
  [[noreturn]] void fail(std::string_view message) const;
  void finish();

 private:
  std::uint64_t remaining() const { return source_.size() - offset_ + static_cast<std::uint64_t>(end_ - position_); }
  void skip_bytes(std::uint64_t count);
  const char* next_bytes(std::size_t count);

  template <class Number>
  Real take_as() {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), next_bytes(sizeof(Number)), sizeof(Number));
    if (is_swapped_) std::reverse(bytes.begin(), bytes.end());
    return static_cast<Real>(std::bit_cast<Number>(bytes));
  }

  const ByteSource& source_;
  bool is_swapped_;       ///< the file's order of bytes is not the machine's
  std::uint64_t offset_;  ///< of the source's first byte behind the block
  std::vector<char> buffer_;
  const char* position_;
  const char* end_;
  const PlyElement* element_ = nullptr;
  std::uint64_t row_ = 0;
};

}  // namespace pliant
