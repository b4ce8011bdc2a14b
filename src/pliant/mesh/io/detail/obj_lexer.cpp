#include "pliant/mesh/io/detail/obj_lexer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
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

ObjLexer::ObjLexer(std::string_view text, std::string_view name)
    : name_(name), position_(text.data()), end_(text.data() + text.size()) {
  if (text.starts_with(byte_order_mark)) position_ += byte_order_mark.size();
  if (const char* nul = std::find(position_, end_, '\0'); nul != end_) {
    while (position_ != nul) is_line_end() ? take_line_end() : void(++position_);
    fail("a NUL byte; this is no text file, export the mesh as OBJ in ASCII or UTF-8");
  }
}

bool ObjLexer::next_line() {
  while (position_ != end_) {
    skip_blanks();
    if (position_ == end_) return false;
    if (!is_line_end() && *position_ != '#') return true;
    skip_comment();
    if (position_ != end_) take_line_end();
  }
  return false;
}

void ObjLexer::skip_rest_of_line() {
  while (!next_word().empty()) {
  }
}

std::string_view ObjLexer::next_word() {
  skip_blanks();
  if (position_ != end_ && *position_ == '#') skip_comment();
  const char* start = position_;
  while (position_ != end_ && !is_blank(*position_) && !is_line_end() && !is_continuation()) ++position_;
  return {start, position_};
}

void ObjLexer::skip_blanks() {
  while (position_ != end_ && (is_blank(*position_) || is_continuation())) {
    if (*position_++ == '\\') take_line_end();
  }
}

// A backslash at the end of a comment continues nothing: it is most often the end of a path.
void ObjLexer::skip_comment() {
  while (position_ != end_ && !is_line_end()) ++position_;
}

bool ObjLexer::is_continuation() const {
  return *position_ == '\\' && end_ - position_ > 1 && (position_[1] == '\n' || position_[1] == '\r');
}

void ObjLexer::take_line_end() {
  const bool is_pair = *position_ == '\r' && end_ - position_ > 1 && position_[1] == '\n';
  position_ += is_pair ? 2 : 1;
  ++line_;
}

Real ObjLexer::number(std::string_view word) const {
  const std::string_view digits = without_plus(word);
  Real value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || stop != digits.data() + digits.size()) {
    fail(fmt::format("{} is not a number; write it like -1.25 or 1e-3", quoted(word)));
  }
  if (error == std::errc::result_out_of_range && is_too_small(digits)) return 0;
  if (error != std::errc() || !std::isfinite(value)) {
    fail(fmt::format("{} is not finite; give a number under 1.8e308", quoted(word)));
  }
  return value;
}

std::int64_t ObjLexer::integer(std::string_view word) const {
  const std::string_view digits = without_plus(word);
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || stop != digits.data() + digits.size()) {
    fail(fmt::format("{} is not an index; write a whole number", quoted(word)));
  }
  if (error != std::errc()) fail(fmt::format("index {} is out of range; no mesh has so many vertices", quoted(word)));
  return value;
}

std::string ObjLexer::quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
  return fmt::format("\"{}{}\"", text, word.size() > longest ? "..." : "");
}

void ObjLexer::fail_at(std::int64_t line, const std::string& message) const {
  fail_input(fmt::format("{}:{}: {}", name_, line, message));
}

}  // namespace pliant
