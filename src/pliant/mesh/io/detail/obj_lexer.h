#pragma once
// The words and numbers of an OBJ text, and the place an error message points to. Private to the OBJ reader.
#include <cstdint>
#include <string>
#include <string_view>

#include "pliant/core/types.h"

namespace pliant {

/// Walks through a text word by word. A line ends at LF, CRLF or CR; a backslash there continues it, a word that starts
/// with # ends it early.
class ObjLexer {
 public:
  /// `name` is what messages call the text. Both must outlive the lexer.
  ObjLexer(std::string_view text, std::string_view name);

  /// Moves to the next word that is not on the current line; false at the end of the text. To be called at the end of a
  /// line: before the first word, after an empty one or after skip_rest_of_line().
  bool next_line();

  void skip_rest_of_line();

  /// The next word of the current line, empty at its end.
  std::string_view next_word();

  /// Number of the line that the last word stands in, from 1.
  std::int64_t line() const { return line_; }

  /// A finite number, whatever the locale. Written to be too small for a double, it is 0.
  Real number(std::string_view word) const;

  /// An integer as it stands in the file.
  std::int64_t integer(std::string_view word) const;

  /// The word as messages show it: in quotes, shortened, without control characters.
  static std::string quoted(std::string_view word);

  /// Throws Error (input): `name:line: message`.
  [[noreturn]] void fail(const std::string& message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(std::int64_t line, const std::string& message) const;

 private:
  void skip_blanks();
  void skip_comment();
  void take_line_end();
  bool is_continuation() const;
  bool is_line_end() const { return *position_ == '\n' || *position_ == '\r'; }

  std::string_view name_;
  const char* position_;
  const char* end_;
  std::int64_t line_ = 1;
};

}  // namespace pliant
