#include "pliant_io/mesh/detail/ply_rows.h"

#include <algorithm>

#include <fmt/format.h>

namespace pliant {

namespace {

constexpr std::size_t block_size = 1 << 18;

}  // namespace

void PlyTextRows::begin_row(std::uint64_t row) {
  if (lexer_.next_line()) return;
  lexer_.fail(fmt::format("the file ends after {} of {} rows of element {}; it may be cut short", row, element_->count,
                          TextLexer::quoted(element_->name)));
}

std::string_view PlyTextRows::next_word() {
  const std::string_view word = lexer_.next_word();
  if (word.empty()) {
    lexer_.fail(fmt::format("a row of element {} that ends too early; give every property of the header",
                            TextLexer::quoted(element_->name)));
  }
  return word;
}

void PlyTextRows::end_row() {
  const std::string_view word = lexer_.next_word();
  if (word.empty()) return;
  lexer_.fail(fmt::format("{} follows the last property of element {}; remove it, or add its property to the header",
                          TextLexer::quoted(word), TextLexer::quoted(element_->name)));
}

void PlyTextRows::skip(const PlyProperty& property) {
  std::int64_t count = 1;
  if (property.count_type) count = lexer_.integer(next_word());
  for (; count > 0; --count) next_word();
}

void PlyTextRows::finish() {
  if (lexer_.next_line()) lexer_.fail("more rows than the header counts; correct its numbers");
}

PlyBinaryRows::PlyBinaryRows(const ByteSource& source, const PlyHeader& header)
    : source_(source),
      is_swapped_((header.encoding == PlyEncoding::little_endian) != (std::endian::native == std::endian::little)),
      offset_(header.end),
      buffer_(static_cast<std::size_t>(std::min<std::uint64_t>(block_size, source.size() - header.end))),
      position_(buffer_.data()),
      end_(position_) {}

const char* PlyBinaryRows::next_bytes(std::size_t count) {
  if (static_cast<std::size_t>(end_ - position_) < count) {
    if (remaining() < count) fail("the file ends in it; it may be cut short");
    const auto kept = static_cast<std::size_t>(end_ - position_);
    std::memmove(buffer_.data(), position_, kept);
    const std::size_t loaded = source_.read(offset_, buffer_.data() + kept, buffer_.size() - kept);
    offset_ += loaded;
    position_ = buffer_.data();
    end_ = position_ + kept + loaded;
  }
  const char* bytes = position_;
  position_ += count;
  return bytes;
}

void PlyBinaryRows::skip_bytes(std::uint64_t count) {
  if (remaining() < count) fail("the file ends in it; it may be cut short");
  const auto buffered = static_cast<std::uint64_t>(end_ - position_);
  if (count <= buffered) {
    position_ += count;
  } else {
    offset_ += count - buffered;
    position_ = end_;
  }
}

Real PlyBinaryRows::take(PlyType type) {
  switch (type) {
    case PlyType::int8:
      return take_as<std::int8_t>();
    case PlyType::uint8:
      return take_as<std::uint8_t>();
    case PlyType::int16:
      return take_as<std::int16_t>();
    case PlyType::uint16:
      return take_as<std::uint16_t>();
    case PlyType::int32:
      return take_as<std::int32_t>();
    case PlyType::uint32:
      return take_as<std::uint32_t>();
    case PlyType::float32:
      return take_as<float>();
    case PlyType::float64:
      return take_as<double>();
  }
  fail("a type that is not known; correct the header");
}

void PlyBinaryRows::skip(const PlyProperty& property) {
  Real count = 1;
  if (property.count_type) count = take(*property.count_type);
  if (count > 0) skip_bytes(static_cast<std::uint64_t>(count) * byte_count(property.type));
}

void PlyBinaryRows::fail(std::string_view message) const {
  source_.fail(fmt::format("row {} of element {}: {}", row_, TextLexer::quoted(element_->name), message));
}

// Some programs write a line end behind the data.
void PlyBinaryRows::finish() {
  constexpr std::uint64_t line_ends = 2;
  if (remaining() > line_ends) {
    source_.fail(fmt::format("{} bytes follow the rows that the header counts; correct its numbers", remaining()));
  }
}

}  // namespace pliant
