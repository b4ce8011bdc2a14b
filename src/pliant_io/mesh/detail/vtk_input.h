#pragma once
// A legacy .vtk file from its beginning to its end: words, and numbers as text or as bytes between them.
#include <string>
#include <string_view>

#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/mesh/detail/vtk_numbers.h"

namespace pliant {

class VtkInput {
 public:
  enum class Form { ascii, binary };

  /// The source must outlive it. Text until set_form().
  explicit VtkInput(const ByteSource& source);

  void set_form(Form form) { form_ = form; }

  /// The next word, on whatever line; empty at the end of the file.
  std::string next_word();
  /// What is left of the line; moves behind its end.
  std::string rest_of_line();
  /// Moves behind the next line without a word, or to the end of the file.
  void skip_to_empty_line();

  /// To be called before numbers: bytes begin right behind the line.
  void begin_numbers();
  /// Whether the word stands next, with nothing but blanks in front.
  bool comes_next(std::string_view word);

  /// The next number.
  Real real(VtkType type);
  std::int64_t integer(VtkType type);
  /// Passes over numbers.
  void skip(std::uint64_t count, VtkType type);

  /// A count of things of at least `numbers` numbers each. @throws Error (input): more than the file has room for.
  std::uint64_t count(std::uint64_t numbers, VtkType type);
  void check_count(std::uint64_t count, std::uint64_t numbers, VtkType type) const;

  /// Throws Error (input): `name:line: message`, of a binary file `name: byte N: message`.
  [[noreturn]] void fail(std::string_view message) const;

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

  bool is_at_end();
  char peek();  ///< '\0' at the end
  void advance();
  void fill();
  const char* take(std::size_t count);
  std::uint64_t remaining() const { return source_.size() - offset_ + (block_.size() - position_); }

  const ByteSource& source_;
  Form form_ = Form::ascii;
  std::string block_{};
  std::size_t position_ = 0;  ///< in the block
  std::uint64_t offset_ = 0;  ///< of the source's first byte behind the block
  std::int64_t line_ = 1;
  std::int64_t word_line_ = 1;  ///< of the last word
};

}  // namespace pliant
