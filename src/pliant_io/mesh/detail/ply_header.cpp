#include "pliant_io/mesh/detail/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "pliant_io/mesh/detail/text_lexer.h"

namespace pliant {

namespace {

constexpr std::size_t max_header_size = 1 << 20;
constexpr std::size_t max_elements = 100;
constexpr std::size_t max_properties = 1000;

constexpr std::array<std::pair<std::string_view, PlyType>, 16> type_names{{
    {"char", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"short", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"int", PlyType::int32},
    {"uint", PlyType::uint32},
    {"float", PlyType::float32},
    {"double", PlyType::float64},
    {"int8", PlyType::int8},
    {"uint8", PlyType::uint8},
    {"int16", PlyType::int16},
    {"uint16", PlyType::uint16},
    {"int32", PlyType::int32},
    {"uint32", PlyType::uint32},
    {"float32", PlyType::float32},
    {"float64", PlyType::float64},
}};

constexpr std::array<std::pair<std::string_view, PlyEncoding>, 3> encoding_names{{
    {"ascii", PlyEncoding::ascii},
    {"binary_little_endian", PlyEncoding::little_endian},
    {"binary_big_endian", PlyEncoding::big_endian},
}};

bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}

/// The text of the header up to the line end behind `end_header`. How the first line ends decides whether a line feed
/// behind a last carriage return belongs to it or is the first byte of binary data.
std::string header_text(const ByteSource& source) {
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(max_header_size, source.size())), '\0');
  source.read(0, text.data(), text.size());
  const std::string_view mark = "\xEF\xBB\xBF";
  const std::size_t start = text.starts_with(mark) ? mark.size() : 0;
  if (text.compare(start, 3, "ply") != 0) source.fail("does not start with \"ply\"; give a PLY file, or rename it");

  const std::size_t first_end = text.find_first_of("\r\n");
  const bool has_pairs = first_end != std::string::npos && text.compare(first_end, 2, "\r\n") == 0;
  const std::string_view last_line = "end_header";
  for (std::size_t at = text.find(last_line); at != std::string::npos; at = text.find(last_line, at + 1)) {
    const std::size_t end = text.find_first_not_of(" \t", at + last_line.size());
    if (!is_line_end(text[at - 1]) || (end != std::string::npos && !is_line_end(text[end]))) continue;
    if (end != std::string::npos) text.resize(end + (has_pairs && text.compare(end, 2, "\r\n") == 0 ? 2 : 1));
    return text;
  }
  source.fail("the header has no line \"end_header\"; the file may be cut short");
}

class HeaderReader {
 public:
  explicit HeaderReader(const ByteSource& text) : lexer_(text, {}) {}

  PlyHeader read() {
    while (lexer_.next_line()) {
      const std::string keyword(lexer_.next_word());
      if (keyword == "format") {
        read_format();
      } else if (keyword == "element") {
        read_element();
      } else if (keyword == "property") {
        read_property();
      } else if (keyword == "ply" || keyword == "comment" || keyword == "obj_info" || keyword == "end_header") {
        lexer_.skip_rest_of_line();
        continue;
      } else {
        lexer_.fail(fmt::format("unknown statement {} in a PLY header; remove the line", TextLexer::quoted(keyword)));
      }
      if (const auto word = lexer_.next_word(); !word.empty()) {
        lexer_.fail(fmt::format("{} too much in a header line; remove it", TextLexer::quoted(word)));
      }
    }
    if (!has_format_) lexer_.fail("the header has no line \"format\"; add \"format ascii 1.0\" if the rest is text");
    header_.line = lexer_.line();
    return std::move(header_);
  }

 private:
  void read_format() {
    const std::string_view word = lexer_.next_word();
    const auto* entry = std::ranges::find(encoding_names, word, &decltype(encoding_names)::value_type::first);
    if (entry == encoding_names.end()) {
      lexer_.fail(
          fmt::format("format {}; known: ascii, binary_little_endian, binary_big_endian", TextLexer::quoted(word)));
    }
    header_.encoding = entry->second;
    has_format_ = true;
    lexer_.next_word();  // the version, which has always been 1.0
  }

  void read_element() {
    PlyElement element;
    element.name = lexer_.next_word();
    const std::int64_t count = lexer_.integer(lexer_.next_word());
    if (count < 0) lexer_.fail(fmt::format("element {} counts {}; give 0 or more", quoted(element.name), count));
    element.count = static_cast<std::uint64_t>(count);
    if (std::ranges::find(header_.elements, element.name, &PlyElement::name) != header_.elements.end()) {
      lexer_.fail(fmt::format("element {} twice; join the two", quoted(element.name)));
    }
    if (header_.elements.size() == max_elements)
      lexer_.fail(fmt::format("more than {} elements; leave out those that are not of the mesh", max_elements));
    header_.elements.push_back(std::move(element));
  }

  void read_property() {
    if (header_.elements.empty()) lexer_.fail("a property before the first element; put it behind one");
    PlyProperty property;
    std::string_view word = lexer_.next_word();
    if (word == "list") {
      property.count_type = read_type(lexer_.next_word());
      if (is_float(*property.count_type)) lexer_.fail("a list that counts in fractions; count it by uchar or int");
      word = lexer_.next_word();
    }
    property.type = read_type(word);
    property.name = lexer_.next_word();
    if (property.name.empty()) lexer_.fail("a property without a name; give it one");
    auto& properties = header_.elements.back().properties;
    if (std::ranges::find(properties, property.name, &PlyProperty::name) != properties.end()) {
      lexer_.fail(fmt::format("property {} twice in an element; rename one", quoted(property.name)));
    }
    if (properties.size() == max_properties) {
      lexer_.fail(fmt::format("more than {} properties in an element; remove some", max_properties));
    }
    properties.push_back(std::move(property));
  }

  PlyType read_type(std::string_view word) const {
    const auto* entry = std::ranges::find(type_names, word, &decltype(type_names)::value_type::first);
    if (entry == type_names.end()) {
      lexer_.fail(
          fmt::format("unknown type {} of a property; known: char, uchar, short, ushort, int, uint, float, double",
                      TextLexer::quoted(word)));
    }
    return entry->second;
  }

  static std::string quoted(std::string_view word) { return TextLexer::quoted(word); }

  TextLexer lexer_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

std::size_t byte_count(PlyType type) {
  constexpr std::array<std::size_t, 8> counts = {1, 1, 2, 2, 4, 4, 4, 8};
  return counts[static_cast<std::size_t>(type)];
}

bool is_float(PlyType type) {
  return type == PlyType::float32 || type == PlyType::float64;
}

PlyHeader read_ply_header(const ByteSource& source) {
  const std::string text = header_text(source);
  const ByteSource text_source(text, source.name());
  PlyHeader header = HeaderReader(text_source).read();
  header.end = text.size();
  return header;
}

}  // namespace pliant
