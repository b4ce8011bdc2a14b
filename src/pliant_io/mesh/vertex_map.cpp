#include "pliant_io/mesh/vertex_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include <fmt/format.h>

#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/mesh/detail/text_lexer.h"

namespace pliant {

namespace {

constexpr std::string_view npy_magic = "\x93NUMPY";

std::vector<Real> read_text(const ByteSource& source) {
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

// ---- NumPy's own format: magic, version, length of the header, header, data

template <class Number>
Real number_at(const char* bytes) {
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
    {"<f8", 8, number_at<double>},
    {"<f4", 4, number_at<float>},
    {"<i8", 8, number_at<std::int64_t>},
    {"<i4", 4, number_at<std::int32_t>},
    {"<i2", 2, number_at<std::int16_t>},
    {"|i1", 1, number_at<std::int8_t>},
    {"<u8", 8, number_at<std::uint64_t>},
    {"<u4", 4, number_at<std::uint32_t>},
    {"<u2", 2, number_at<std::uint16_t>},
    {"|u1", 1, number_at<std::uint8_t>},
    {"|b1", 1, number_at<std::uint8_t>},
}};

struct NpyHeader {
  std::string text;
  std::uint64_t end = 0;
};

NpyHeader read_npy_header(const ByteSource& source) {
  constexpr std::uint32_t longest = 1 << 16;
  std::array<char, 12> start{};
  const bool has_start = source.read(0, start.data(), start.size()) == start.size();
  // The first version has two bytes for the length, later ones have four.
  const bool is_short = start[6] == 1;
  std::uint32_t length = 0;
  std::memcpy(&length, start.data() + 8, is_short ? 2 : 4);
  const std::uint64_t begin = is_short ? 10 : 12;
  if (!has_start || length > longest || begin + length > source.size()) {
    source.fail("the header of the array is cut short; save it again");
  }
  NpyHeader header{std::string(length, '\0'), begin + length};
  source.read(begin, header.text.data(), header.text.size());
  return header;
}

/// What follows `'key':` in the header, a Python dictionary that numpy.save always writes the same way.
std::string_view npy_entry(const std::string& header, std::string_view key) {
  const std::size_t at = header.find(fmt::format("'{}':", key));
  if (at == std::string::npos) return {};
  std::string_view rest = std::string_view(header).substr(at + key.size() + 3);
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  return rest;
}

std::vector<Real> read_npy(const ByteSource& source) {
  const NpyHeader header = read_npy_header(source);
  const std::string_view type_name = npy_entry(header.text, "descr");
  const auto* type = std::ranges::find_if(
      npy_types, [&](const NpyType& known) { return type_name.size() > 5 && type_name.substr(1, 3) == known.name; });
  if (type == npy_types.end()) {
    source.fail(fmt::format("an array of type {}; save it as float64, little end first",
                            TextLexer::quoted(type_name.substr(0, type_name.find(',')))));
  }
  const std::string_view shape = npy_entry(header.text, "shape");
  std::uint64_t count = 0;
  const char* const shape_end = shape.data() + shape.size();
  const auto [stop, error] = std::from_chars(shape.data() + std::min<std::size_t>(shape.size(), 1), shape_end, count);
  const std::string_view rest(stop, static_cast<std::size_t>(shape_end - stop));
  if (error != std::errc() || !shape.starts_with('(') || !rest.starts_with(",)")) {
    source.fail(fmt::format("an array of shape {}; save one of one dimension",
                            TextLexer::quoted(shape.substr(0, shape.find(')') + 1))));
  }
  const std::uint64_t room = (source.size() - header.end) / type->size;
  if (count == 0 || count != room || (source.size() - header.end) % type->size != 0) {
    source.fail(fmt::format("an array of {} numbers, but the data of {}; save it again", count, room));
  }
  constexpr std::size_t numbers_at_once = 1 << 13;
  std::array<char, 8 * numbers_at_once> block;
  std::vector<Real> values(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t in_block = i % numbers_at_once;
    if (in_block == 0) source.read(header.end + i * type->size, block.data(), numbers_at_once * type->size);
    values[i] = type->read(block.data() + in_block * type->size);
    if (!std::isfinite(values[i])) source.fail(fmt::format("number {} is not finite; give another", i));
  }
  return values;
}

std::vector<Real> read(const ByteSource& source) {
  std::array<char, npy_magic.size()> start{};
  source.read(0, start.data(), start.size());
  return std::string_view(start.data(), start.size()) == npy_magic ? read_npy(source) : read_text(source);
}

}  // namespace

std::vector<Real> parse_vertex_map(std::string_view bytes, std::string_view name) {
  return read(ByteSource(bytes, name));
}

std::vector<Real> read_vertex_map(const std::filesystem::path& path) {
  return read(ByteSource(path));
}

}  // namespace pliant
