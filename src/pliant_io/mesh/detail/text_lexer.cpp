#include "pliant_io/mesh/detail/text_lexer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/number_text.h"

namespace pliant {

namespace {

/// A word must fit in.
constexpr std::size_t lexer_block_size = 1 << 18;

enum CharacterClass : unsigned char { in_word, blank, line_end };

constexpr std::array<CharacterClass, 256> character_classes = [] {
  std::array<CharacterClass, 256> classes{};
  for (const char c : {' ', '\t', '\v', '\f'}) classes[static_cast<unsigned char>(c)] = blank;
  for (const char c : {'\n', '\r'}) classes[static_cast<unsigned char>(c)] = line_end;
  return classes;
}();

CharacterClass class_of(char c) {
  return character_classes[static_cast<unsigned char>(c)];
}

/// std::from_chars knows no plus sign.
std::string_view without_plus(std::string_view word) {
  const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return has_plus ? word.substr(1) : word;
}

/// Whether a well-formed number that no double can hold is too small, not too large: std::from_chars does not tell.
bool is_too_small(std::string_view word) {
  const auto exponent = word.find_first_of("eE");
  if (exponent != std::string_view::npos) return word.substr(exponent + 1).starts_with('-');
  const auto first_digit = word.find_first_not_of("+-");
  return word[first_digit] == '0' || word[first_digit] == '.';
}

}  // namespace

TextLexer::TextLexer(const ByteSource& source, TextSyntax syntax, std::uint64_t offset, std::int64_t line)
    : source_(source),
      syntax_(syntax),
      offset_(offset),
      buffer_(static_cast<std::size_t>(std::min<std::uint64_t>(lexer_block_size, source.size())) + 1, '\n'),
      position_(buffer_.data()),
      end_(position_),
      line_(line) {
  load_more(position_);
  const std::string_view start(position_, static_cast<std::size_t>(end_ - position_));
  if (offset == 0 && start.starts_with(byte_order_mark)) position_ += byte_order_mark.size();
}

/// Moves what lies from `keep` on to the start of the block and fills it up; false at the end of the source.
bool TextLexer::load_more(const char* keep) {
  if (offset_ >= source_.size()) return false;
  const auto kept = static_cast<std::size_t>(end_ - keep);
  if (kept + 1 == buffer_.size()) {
    fail(fmt::format("a word of more than {} characters; this is not text made of numbers and names, export it again",
                     kept));
  }
  std::memmove(buffer_.data(), keep, kept);
  position_ = buffer_.data() + (position_ - keep);
  char* const first = buffer_.data() + kept;
  const std::size_t count = source_.read(offset_, first, buffer_.size() - 1 - kept);
  offset_ += count;
  end_ = first + count;
  first[count] = '\n';
  refuse_nul(first);
  return true;
}

void TextLexer::refuse_nul(const char* first) const {
  const auto* nul = static_cast<const char*>(std::memchr(first, '\0', static_cast<std::size_t>(end_ - first)));
  if (nul == nullptr) return;
  std::int64_t line = line_;
  for (const char* c = position_; c < nul; ++c) {
    if (*c == '\n' || (*c == '\r' && c[1] != '\n')) ++line;
  }
  fail_at(line, "a NUL byte; this is not text, export it again in ASCII or UTF-8");
}

bool TextLexer::next_line() {
  for (;;) {
    skip_blanks();
    if (position_ == end_) return false;
    if (class_of(*position_) != line_end) {
      if (*position_ != syntax_.comment) return true;
      skip_comment();
      if (position_ == end_) return false;
    }
    take_line_end();
  }
}

void TextLexer::skip_rest_of_line() {
  while (!next_word().empty()) {
  }
}

std::string_view TextLexer::next_word() {
  skip_blanks();
  if (*position_ == syntax_.comment) skip_comment();
  const char* start = position_;
  for (;;) {
    while (class_of(*position_) == in_word) ++position_;
    if (position_ != end_ || !load_more(start)) break;
    start = buffer_.data();
  }
  const bool is_continued = position_ - start > 1 && position_[-1] == syntax_.continuation && position_ != end_ &&
                            class_of(*position_) == line_end;
  if (is_continued) --position_;
  return {start, static_cast<std::size_t>(position_ - start)};
}

/// Stops before a word, at a line end or at the end of the source; continuations are taken as blanks.
void TextLexer::skip_blanks() {
  for (;;) {
    while (class_of(*position_) == blank) ++position_;
    if (position_ == end_) {
      if (!load_more(position_)) return;
      continue;
    }
    if (*position_ != syntax_.continuation) return;
    if (position_ + 1 == end_ && !load_more(position_)) return;
    if (class_of(position_[1]) != line_end) return;
    ++position_;
    take_line_end();
  }
}

// A continuation at the end of a comment joins nothing: it is most often the end of a path.
void TextLexer::skip_comment() {
  do {
    while (class_of(*position_) != line_end) ++position_;
  } while (position_ == end_ && load_more(position_));
}

void TextLexer::take_line_end() {
  if (*position_ == '\r' && position_ + 1 == end_) load_more(position_);
  const bool is_pair = *position_ == '\r' && position_ + 1 != end_ && position_[1] == '\n';
  position_ += is_pair ? 2 : 1;
  ++line_;
}

std::string parse_number(std::string_view word, Real& value) {
  const std::string_view digits = without_plus(word);
  const auto [stop, error] = number_from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || stop != digits.data() + digits.size()) {
    return fmt::format("{} is not a number; write it like -1.25 or 1e-3", TextLexer::quoted(word));
  }
  if (error != std::errc()) value = is_too_small(digits) ? 0 : std::numeric_limits<Real>::infinity();
  return {};
}

std::string parse_integer(std::string_view word, std::int64_t& value) {
  const std::string_view digits = without_plus(word);
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || stop != digits.data() + digits.size()) {
    return fmt::format("{} is not an index; write a whole number", TextLexer::quoted(word));
  }
  if (error == std::errc()) return {};
  return fmt::format("index {} is out of range; no mesh has so many vertices", TextLexer::quoted(word));
}

Real TextLexer::number_or_nan(std::string_view word) const {
  Real value = 0;
  if (const std::string message = parse_number(word, value); !message.empty()) fail(message);
  return value;
}

Real TextLexer::number(std::string_view word) const {
  const Real value = number_or_nan(word);
  if (!std::isfinite(value)) fail(fmt::format("{} is not finite; give a number under 1.8e308", quoted(word)));
  return value;
}

std::int64_t TextLexer::integer(std::string_view word) const {
  std::int64_t value = 0;
  if (const std::string message = parse_integer(word, value); !message.empty()) fail(message);
  return value;
}

std::string TextLexer::quoted(std::string_view word) {
  return fmt::format("\"{}\"", printable(word, 40));
}

void TextLexer::fail_at(std::int64_t line, std::string_view message) const {
  fail_input(fmt::format("{}:{}: {}", printable_place(source_.name()), line, message));
}

}  // namespace pliant
