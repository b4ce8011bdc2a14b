#include "pliant_io/mesh/detail/vtk_input.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/mesh/detail/polygon_builder.h"
#include "pliant_io/mesh/detail/text_lexer.h"

namespace pliant {

namespace {

constexpr std::size_t vtk_block_size = 1 << 16;
/// Of words and lines.
constexpr std::size_t most_characters = 1 << 16;

}  // namespace

VtkInput::VtkInput(const ByteSource& source) : source_(source) {
  fill();
  if (block_.starts_with(byte_order_mark)) position_ = byte_order_mark.size();
}

/// Keeps what is left of the block.
void VtkInput::fill() {
  block_.erase(0, position_);
  position_ = 0;
  const std::size_t kept = block_.size();
  block_.resize(kept + vtk_block_size);
  const std::size_t count = source_.read(offset_, block_.data() + kept, vtk_block_size);
  block_.resize(kept + count);
  offset_ += count;
}

bool VtkInput::is_at_end() {
  if (position_ == block_.size() && offset_ < source_.size()) fill();
  return position_ == block_.size();
}

char VtkInput::peek() {
  return is_at_end() ? '\0' : block_[position_];
}

/// A line ends at LF, CRLF or CR.
void VtkInput::advance() {
  const char c = block_[position_++];
  if (c == '\n' || (c == '\r' && peek() != '\n')) ++line_;
}

std::string VtkInput::next_word() {
  while (!is_at_end() && (is_blank(peek()) || is_line_end(peek()))) advance();
  word_line_ = line_;
  std::string word;
  while (!is_at_end() && !is_blank(peek()) && !is_line_end(peek())) {
    if (peek() == '\0') fail("a NUL byte; this is not a file of VTK, save it anew");
    word += peek();
    advance();
    if (word.size() > most_characters) fail("a word of more than 65536 characters; this is not a file of VTK");
  }
  return word;
}

std::string VtkInput::rest_of_line() {
  word_line_ = line_;
  std::string text;
  while (!is_at_end() && !is_line_end(peek())) {
    if (peek() == '\0') fail("a NUL byte; this is not a file of VTK, save it anew");
    text += peek();
    advance();
    if (text.size() > most_characters) fail("a line of more than 65536 characters; this is not a file of VTK");
  }
  if (is_at_end()) return text;
  const bool is_return = peek() == '\r';
  advance();
  if (is_return && peek() == '\n') advance();
  return text;
}

void VtkInput::skip_to_empty_line() {
  rest_of_line();
  while (!is_at_end()) {
    const std::string line = rest_of_line();
    if (std::ranges::all_of(line, is_blank)) return;
  }
}

void VtkInput::begin_numbers() {
  if (form_ == Form::ascii) return;
  const std::string rest = rest_of_line();
  if (!std::ranges::all_of(rest, is_blank)) {
    fail(fmt::format("{} where the line should end; save the file anew", TextLexer::quoted(rest)));
  }
}

bool VtkInput::comes_next(std::string_view word) {
  while (!is_at_end() && (is_blank(peek()) || is_line_end(peek()))) {
    if (form_ == Form::binary) return false;
    advance();
  }
  if (block_.size() - position_ < word.size() && offset_ < source_.size()) fill();
  return std::string_view(block_).substr(position_).starts_with(word);
}

const char* VtkInput::take(std::size_t count) {
  if (block_.size() - position_ < count && offset_ < source_.size()) fill();
  if (block_.size() - position_ < count) fail("the file ends within its numbers; it may be cut short");
  position_ += count;
  return block_.data() + position_ - count;
}

Real VtkInput::real(VtkType type) {
  if (form_ == Form::binary) return vtk_real(type, take(byte_count(type)), VtkByteOrder::big);
  Real value = 0;
  if (const std::string message = parse_number(next_word(), value); !message.empty()) fail(message);
  return value;
}

std::int64_t VtkInput::integer(VtkType type) {
  if (form_ == Form::binary) return vtk_integer(type, take(byte_count(type)), VtkByteOrder::big);
  std::int64_t value = 0;
  if (const std::string message = parse_integer(next_word(), value); !message.empty()) fail(message);
  return value;
}

void VtkInput::skip(std::uint64_t count, VtkType type) {
  for (std::uint64_t i = 0; i < count; ++i) {
    if (form_ == Form::binary) {
      take(byte_count(type));
    } else if (next_word().empty()) {
      fail("the file ends within its numbers; it may be cut short");
    }
  }
}

std::uint64_t VtkInput::count(std::uint64_t numbers, VtkType type) {
  std::int64_t value = 0;
  if (const std::string message = parse_integer(next_word(), value); !message.empty()) fail(message);
  if (value < 0) fail(fmt::format("a count of {}; correct it", value));
  check_count(static_cast<std::uint64_t>(value), numbers, type);
  return static_cast<std::uint64_t>(value);
}

/// A number of a text takes two characters.
void VtkInput::check_count(std::uint64_t count, std::uint64_t numbers, VtkType type) const {
  const std::uint64_t each = numbers * (form_ == Form::binary ? byte_count(type) : 2);
  const std::uint64_t room = std::min(max_index_count, (remaining() + 1) / std::max<std::uint64_t>(1, each));
  if (count > room) {
    fail(fmt::format("a count of {}, where the file has room for at most {}; it may be cut short", count, room));
  }
}

void VtkInput::fail(std::string_view message) const {
  if (form_ == Form::ascii) {
    fail_input(fmt::format("{}:{}: {}", printable_place(source_.name()), word_line_, message));
  }
  source_.fail(fmt::format("byte {}: {}", source_.size() - remaining(), message));
}

}  // namespace pliant
