#include "pliant_io/mesh/vertex_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/printable.h"
#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/files/detail/npy.h"
#include "pliant_io/mesh/detail/text_lexer.h"

namespace pliant {

namespace {

std::vector<Real> read_map_text(const ByteSource& source) {
  TextLexer lexer(source, {.comment = '#'});
  std::vector<Real> values;
  while (lexer.next_line()) {
    values.push_back(lexer.number(lexer.next_word()));
    if (const auto word = lexer.next_word(); !word.empty()) {
      lexer.fail(
          fmt::format("{} behind the number of the line; give one number for each vertex", TextLexer::quoted(word)));
    }
  }
  if (values.empty()) source.fail("no numbers; give one a line");
  return values;
}

template <class Number>
Real map_number_at(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<Real>(number);
}

struct NpyType {
  std::string_view name;
  std::size_t size;
  Real (*read)(const char*);
};
static_assert(std::endian::native == std::endian::little, "the types are read as they lie in the file");
constexpr std::array<NpyType, 11> npy_types{{
    {"<f8", 8, map_number_at<double>},
    {"<f4", 4, map_number_at<float>},
    {"<i8", 8, map_number_at<std::int64_t>},
    {"<i4", 4, map_number_at<std::int32_t>},
    {"<i2", 2, map_number_at<std::int16_t>},
    {"|i1", 1, map_number_at<std::int8_t>},
    {"<u8", 8, map_number_at<std::uint64_t>},
    {"<u4", 4, map_number_at<std::uint32_t>},
    {"<u2", 2, map_number_at<std::uint16_t>},
    {"|u1", 1, map_number_at<std::uint8_t>},
    {"|b1", 1, map_number_at<std::uint8_t>},
}};

std::vector<Real> read_map_array(const ByteSource& source) {
  const NpyHeader header = read_npy_header(source);
  const auto* const type = std::ranges::find(npy_types, header.type, &NpyType::name);
  if (type == npy_types.end()) {
    source.fail(fmt::format("an array of type '{}'; save it as float64, little end first", printable(header.type, 40)));
  }
  if (header.shape.size() != 1) {
    source.fail(fmt::format("an array of shape ({}); save one of one dimension", fmt::join(header.shape, ", ")));
  }
  const auto count = static_cast<std::uint64_t>(header.shape.front());
  const std::uint64_t bytes = source.size() - header.first_byte;
  if (count == 0 || count != bytes / type->size || bytes % type->size != 0) {
    source.fail(fmt::format("an array of {} numbers, but the data of {}; save it again", count, bytes / type->size));
  }
  constexpr std::size_t numbers_at_once = 1 << 13;
  std::array<char, 8 * numbers_at_once> block;
  std::vector<Real> values(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t in_block = i % numbers_at_once;
    if (in_block == 0) source.read(header.first_byte + i * type->size, block.data(), numbers_at_once * type->size);
    values[i] = type->read(block.data() + in_block * type->size);
    if (!std::isfinite(values[i])) source.fail(fmt::format("number {} is not finite; give another", i));
  }
  return values;
}

std::vector<Real> read_map(const ByteSource& source) {
  std::array<char, npy_magic.size()> start{};
  source.read(0, start.data(), start.size());
  return std::string_view(start.data(), start.size()) == npy_magic ? read_map_array(source) : read_map_text(source);
}

}  // namespace

std::vector<Real> parse_vertex_map(std::string_view bytes, std::string_view name) {
  return read_map(ByteSource(bytes, name));
}

std::vector<Real> read_vertex_map(const std::filesystem::path& path) {
  return read_map(ByteSource(path));
}

}  // namespace pliant
