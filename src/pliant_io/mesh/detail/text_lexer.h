#pragma once
// The words and numbers of a text file, and the place an error message points to. Private to the readers.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/core/types.h"
#include "pliant_io/files/detail/byte_source.h"

namespace pliant {

/// Of UTF-8; some editors put it at the start of a text.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// What has a meaning beyond words and line ends; '\0' where nothing has.
struct TextSyntax {
  char comment = '\0';       ///< a word that starts with it ends the line early
  char continuation = '\0';  ///< as the last character of a line, joins the next one to it
};

/// Takes a word as a number, whatever the locale; one that is too small for a double is 0, one that is too large
/// infinite. What is wrong with it, as an error message without its place, or nothing.
std::string parse_number(std::string_view word, Real& value);
/// The same as an integer.
std::string parse_integer(std::string_view word, std::int64_t& value);

/// Walks through a text word by word, a block of the source in memory at a time. A line ends at LF, CRLF or CR.
class TextLexer {
 public:
  /// From `offset` on, which is in line number `line`. The source must outlive the lexer.
  TextLexer(const ByteSource& source, TextSyntax syntax, std::uint64_t offset = 0, std::int64_t line = 1);

  /// Moves to the next word that is not on the current line; false at the end of the text. To be called at the end of a
  /// line: before the first word, after an empty one or after skip_rest_of_line().
  bool next_line();

  void skip_rest_of_line();

  /// The next word of the current line, empty at its end. It is valid until another member moves on.
  std::string_view next_word();

  /// Number of the line that the last word stands in, from 1.
  std::int64_t line() const { return line_; }

  /// The most bytes that are still to come, those of the last word included.
  std::uint64_t remaining() const { return source_.size() - offset_ + static_cast<std::uint64_t>(end_ - position_); }

  /// A finite number, whatever the locale. Written to be too small for a double, it is 0.
  Real number(std::string_view word) const;

  /// The same, and what is not finite as well.
  Real number_or_nan(std::string_view word) const;

  /// An integer as it stands in the file.
  std::int64_t integer(std::string_view word) const;

  /// The word as messages show it: in quotes, shortened, as printable() makes it.
  static std::string quoted(std::string_view word);

  /// Throws Error (input): `name:line: message`.
  [[noreturn]] void fail(std::string_view message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(std::int64_t line, std::string_view message) const;

 private:
  void skip_blanks();
  void skip_comment();
  void take_line_end();
  bool load_more(const char* keep);
  void refuse_nul(const char* first) const;

  const ByteSource& source_;
  TextSyntax syntax_;
  std::uint64_t offset_;      ///< of the source's first byte behind the block
  std::vector<char> buffer_;  ///< the block and a line end behind it, which stops every scan
  const char* position_;
  const char* end_;
  std::int64_t line_;
};

}  // namespace pliant
