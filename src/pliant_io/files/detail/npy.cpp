#include "pliant_io/files/detail/npy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/printable.h"

namespace pliant {

namespace {

static_assert(std::endian::native == std::endian::little,
              "the header's length is read and written as it lies in memory");

/// The dictionary, of which numpy.save always writes the same three keys.
class NpyDictionary {
 public:
  NpyDictionary(const ByteSource& source, std::string text) : source_(source), text_(std::move(text)) {}

  std::string type() const {
    const std::string_view text = value("descr");
    const std::size_t end = text.find(text.empty() ? '\'' : text.front(), 1);
    if (!(text.starts_with('\'') || text.starts_with('"')) || end == text.npos) {
      fail(fmt::format("'descr' is {}, which is not one type of number; save the array as float64", shown(text)));
    }
    return std::string(text.substr(1, end - 1));
  }

  bool is_fortran_order() const {
    const std::string_view text = value("fortran_order");
    if (text.starts_with("True")) return true;
    if (text.starts_with("False")) return false;
    fail(fmt::format("'fortran_order' is {}, neither True nor False; write the file by numpy.save", shown(text)));
  }

  std::vector<std::int64_t> shape() const {
    const std::string_view text = value("shape");
    std::string_view rest = text;
    std::vector<std::int64_t> counts;
    bool is_shape = take(rest, '(');
    while (is_shape && !take(rest, ')')) {
      std::int64_t count = 0;
      const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), count);
      rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
      counts.push_back(count);
      is_shape = error == std::errc() && count >= 0 && (take(rest, ',') || skip_blanks(rest).starts_with(')'));
    }
    if (is_shape) return counts;
    fail(fmt::format("'shape' is {}, not counts in brackets; write the file by numpy.save", shown(text)));
  }

 private:
  static std::string_view skip_blanks(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(' '), text.size()));
  }

  /// Whether the character comes next, behind blanks; it and the blanks around it are then taken.
  static bool take(std::string_view& text, char character) {
    const std::string_view rest = skip_blanks(text);
    if (!rest.starts_with(character)) return false;
    text = skip_blanks(rest.substr(1));
    return true;
  }

  /// What stands behind `'key':`.
  std::string_view value(std::string_view key) const {
    const std::string quoted = fmt::format("'{}'", key);
    const std::size_t place = text_.find(quoted);
    if (place == text_.npos) fail(fmt::format("has no {}; write the file by numpy.save", quoted));
    std::string_view rest = std::string_view(text_).substr(place + quoted.size());
    if (!take(rest, ':')) fail(fmt::format("no value of {}; write the file by numpy.save", quoted));
    return rest;
  }

  /// The start of it, in quotes.
  static std::string shown(std::string_view text) {
    constexpr std::size_t longest = 24;
    return fmt::format("\"{}\"", printable(text.substr(0, std::min(text.find('\n'), longest))));
  }

  [[noreturn]] void fail(std::string_view what) const { source_.fail(fmt::format("header: {}", what)); }

  const ByteSource& source_;
  std::string text_;
};

}  // namespace

NpyHeader read_npy_header(const ByteSource& source) {
  constexpr std::uint32_t longest = 1 << 16;
  constexpr std::size_t version_at = npy_magic.size();
  constexpr std::size_t length_at = version_at + 2;
  std::array<char, length_at + 4> start{};
  const bool has_start = source.read(0, start.data(), start.size()) == start.size();
  if (!std::string_view(start.data(), start.size()).starts_with(npy_magic)) {
    source.fail("does not begin with \\x93NUMPY and a version; give a file of the format that its name says");
  }
  // The first version has two bytes for the length, later ones have four.
  const std::size_t length_size = start[version_at] == 1 ? 2 : 4;
  std::uint32_t length = 0;
  std::memcpy(&length, start.data() + length_at, length_size);
  const std::uint64_t begin = length_at + length_size;
  if (!has_start || length > longest || begin + length > source.size()) {
    source.fail("header: is cut off; write the file again");
  }
  std::string text(length, '\0');
  source.read(begin, text.data(), text.size());
  const NpyDictionary dictionary(source, std::move(text));
  return {dictionary.type(), dictionary.is_fortran_order(), dictionary.shape(), begin + length};
}

std::string npy_header(std::string_view type, std::span<const std::int64_t> shape) {
  constexpr std::size_t least_size = 128;
  constexpr std::size_t alignment = 64;
  std::string counts = fmt::format("{}", fmt::join(shape, ", "));
  if (shape.size() == 1) counts += ',';
  const std::string dictionary =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, counts);
  std::string header(npy_magic);
  header += {'\x01', '\x00'};
  const std::size_t begin = header.size() + 2;
  // At least one blank or line end behind the dictionary.
  const std::size_t size = std::max(least_size, (begin + dictionary.size()) / alignment * alignment + alignment);
  const auto length = static_cast<std::uint16_t>(size - begin);
  header.append(reinterpret_cast<const char*>(&length), sizeof length);
  header += dictionary;
  header.resize(size - 1, ' ');
  header += '\n';
  return header;
}

}  // namespace pliant
