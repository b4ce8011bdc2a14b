// nlohmann's parser reports what it meets; here that becomes a document.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/scene/document.h"

namespace pliant {

using Json = nlohmann::json;

namespace {

enum class Format { json, cbor };

/// Where in the text the characters stand that the parser got.
class SourcePositions {
 public:
  void add_gap(std::size_t given, std::size_t position) { gaps_.push_back({given, position}); }
  /// The position of the character that was given as number `given`, from 0.
  std::size_t of(std::size_t given) const {
    const auto next = std::ranges::upper_bound(gaps_, given, {}, &Gap::given);
    if (next == gaps_.begin()) return given;
    const Gap& gap = *std::prev(next);
    return gap.position + (given - gap.given);
  }

 private:
  struct Gap {
    std::size_t given;  // the first character behind the gap
    std::size_t position;
  };
  std::vector<Gap> gaps_;
};

/// Gives the parser a text without the rest of long runs of blanks. It keeps all blanks for its message, each line end
/// as eight characters.
class BlankSkipper {
 public:
  // NOLINTBEGIN(readability-identifier-naming): names of the standard library
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;
  // NOLINTEND(readability-identifier-naming)

  BlankSkipper(std::string_view text, std::size_t position, SourcePositions& positions)
      : text_(text), position_(position), positions_(&positions) {}

  char operator*() const { return text_[position_]; }
  BlankSkipper& operator++() {
    const char c = text_[position_++];
    ++given_;
    if (is_in_string_) {
      is_in_string_ = c != '"' || is_escaped_;
      is_escaped_ = c == '\\' && !is_escaped_;
      return *this;
    }
    is_in_string_ = c == '"';
    blanks_ = is_blank(c) ? blanks_ + 1 : 0;
    if (blanks_ >= kept_blanks) skip_blanks();
    return *this;
  }
  bool operator==(const BlankSkipper& other) const { return position_ == other.position_; }

 private:
  static constexpr std::size_t kept_blanks = 1000;
  static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  void skip_blanks() {
    while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
    positions_->add_gap(given_, position_);
  }

  std::string_view text_;
  std::size_t position_;
  SourcePositions* positions_;
  std::size_t given_ = 0;
  std::size_t blanks_ = 0;
  bool is_in_string_ = false;
  bool is_escaped_ = false;
};

}  // namespace

class DocumentBuilder {
 public:
  DocumentBuilder(std::string_view source, std::string_view file, Format format)
      : source_(source), file_(file), format_(format) {}

  SourcePositions& positions() { return positions_; }

  Document take() {
    pending_.move_tail(0, document_.words_);  // the root
    return std::move(document_);
  }

  // The parser's interface: true is "go on".
  bool null() { return place(Document::word_of(Document::Kind::null, 0, 0)); }
  bool boolean(bool value) { return place(Word{value} << Document::kind_bits | Word(Document::Kind::boolean)); }
  bool number_integer(Json::number_integer_t value) {
    constexpr auto largest = std::int64_t{1} << (63 - Document::kind_bits);
    if (value < -largest || value >= largest) return place_wide(Document::Kind::wide_integer, Word(value));
    return place(Word(value) << Document::kind_bits | Word(Document::Kind::integer));
  }
  bool number_unsigned(Json::number_unsigned_t value) {
    if (value > std::numeric_limits<std::int64_t>::max()) return number_float(static_cast<Real>(value), {});
    return number_integer(static_cast<Json::number_integer_t>(value));
  }
  bool number_float(Real value, const std::string&) {
    if (!std::isfinite(value)) fail_at(file_, place_of_next(), "the number is not finite; give a finite one");
    return place_wide(Document::Kind::real, std::bit_cast<Word>(value));
  }
  bool string(std::string& value) { return place(text_word(Document::Kind::text, value)); }
  bool binary(Json::binary_t& value) {
    return place(
        text_word(Document::Kind::bytes, {reinterpret_cast<const char*>(value.data()), value.size()}));  // NOLINT
  }
  bool key(std::string& name) { return place(text_word(Document::Kind::text, name)); }
  bool start_object(std::size_t) { return enter(Document::Kind::object); }
  bool start_array(std::size_t) { return enter(Document::Kind::list); }
  bool end_array() { return leave(1); }
  bool end_object() {
    refuse_double_keys();
    return leave(2);
  }
  bool parse_error(std::size_t byte, const std::string& token, const Json::exception& error);

 private:
  using Word = Document::Word;

  /// A container that is not closed yet.
  struct Level {
    Document::Kind kind;
    std::size_t begin;  // of its words in pending_
  };

  bool place(Word word) {
    pending_.push_back(word);
    return true;
  }
  bool place_wide(Document::Kind kind, Word value) {
    document_.words_.push_back(value);
    return place(Document::word_of(kind, 0, document_.words_.size() - 1));
  }
  Word text_word(Document::Kind kind, std::string_view text) {
    return Document::word_of(kind, text.size(), text.empty() ? 0 : document_.texts_.add(text));
  }
  bool enter(Document::Kind kind) {
    if (levels_.size() >= max_document_depth) {
      fail_at(file_, place_of_next(),
              fmt::format("more than {} levels inside each other; flatten them", max_document_depth));
    }
    levels_.push_back({kind, pending_.size()});
    return true;
  }
  bool leave(std::size_t words_per_entry) {
    const Level level = levels_.back();
    levels_.pop_back();
    const std::size_t count = (pending_.size() - level.begin) / words_per_entry;
    const std::size_t first = document_.words_.size();
    pending_.move_tail(level.begin, document_.words_);
    return place(Document::word_of(level.kind, count, count == 0 ? 0 : first));
  }
  void refuse_double_keys() const;

  /// Where the container of level i stands, or, for i past the levels, a value that comes now.
  std::string place_of(std::size_t i) const;
  std::string place_of_next() const { return place_of(levels_.size()); }

  std::string_view source_;
  std::string_view file_;
  Format format_;
  SourcePositions positions_;
  Document document_;
  WordStore pending_;  // the values of all open containers
  std::vector<Level> levels_;
};

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// "3:11", lines and characters counted from 1; lines end with LF, CR LF or CR.
std::string line_and_column(std::string_view before) {
  if (before.starts_with(byte_order_mark)) before.remove_prefix(byte_order_mark.size());
  std::size_t line = 1;
  std::size_t column = 1;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const char c = before[i];
    if (c == '\n' || (c == '\r' && (i + 1 == before.size() || before[i + 1] != '\n'))) {
      ++line;
      column = 1;
    } else if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {  // a character begins
      ++column;
    }
  }
  return fmt::format("{}:{}", line, column);
}

[[noreturn]] void fail_syntax(std::string_view source, std::string_view file, std::size_t place,
                              std::string_view what) {
  fail_input(fmt::format("{}:{}: {}", printable_place(file), line_and_column(source.substr(0, place)), what));
}

void check_size(std::string_view source, std::string_view file) {
  if (source.size() <= max_document_bytes) return;
  fail_at(file, "", "is larger than 1 GB; put meshes and maps into files of their own");
}

/// The parser reads strings in pieces by calling itself, so that pieces in pieces in pieces would end the stack.
/// Walks the items (RFC 8949, Sec. 3) and refuses such strings; other slips are left to the parser.
void refuse_strings_in_pieces(std::string_view bytes, std::string_view file) {
  for (std::size_t i = 0; i < bytes.size();) {
    const auto initial = static_cast<unsigned char>(bytes[i]);
    const unsigned major = initial >> 5U;
    const unsigned additional = initial & 31U;
    const bool is_string = major == 2 || major == 3;
    if (is_string && additional == 31)
      fail_at(file, "", fmt::format("byte {}: a string in pieces; write it in one", i));
    ++i;
    const std::size_t argument_bytes = additional >= 24 && additional <= 27 ? std::size_t{1} << (additional - 24) : 0;
    if (argument_bytes > bytes.size() - i) return;
    std::uint64_t argument = additional < 24 ? additional : 0;
    for (std::size_t k = 0; k < argument_bytes; ++k) {
      argument = argument << 8U | static_cast<unsigned char>(bytes[i + k]);
    }
    i += argument_bytes;
    if (!is_string) continue;
    if (argument > bytes.size() - i) return;
    i += argument;
  }
}

}  // namespace

std::string DocumentBuilder::place_of(std::size_t i) const {
  std::string path;
  for (std::size_t outer = 0; outer < i; ++outer) {
    const Level& level = levels_[outer];
    const std::size_t end = outer + 1 < levels_.size() ? levels_[outer + 1].begin : pending_.size();
    if (level.kind == Document::Kind::list) {
      path += fmt::format("[{}]", end - level.begin);
    } else if (end > level.begin) {
      path = join_key(path, document_.text_of(pending_[end - 1]));
    }
  }
  return path;
}

void DocumentBuilder::refuse_double_keys() const {
  const std::size_t begin = levels_.back().begin;
  std::vector<std::string_view> keys;
  keys.reserve((pending_.size() - begin) / 2);
  for (std::size_t i = begin; i < pending_.size(); i += 2) keys.push_back(document_.text_of(pending_[i]));
  std::ranges::sort(keys);
  const auto twice = std::ranges::adjacent_find(keys);
  if (twice == keys.end()) return;
  fail_at(file_, place_of(levels_.size() - 1),
          fmt::format("the key '{}' stands here twice; remove one of the two", printable(*twice)));
}

bool DocumentBuilder::parse_error(std::size_t byte, const std::string& token, const Json::exception& error) {
  if (format_ == Format::json && dynamic_cast<const Json::out_of_range*>(&error) != nullptr) {
    fail_at(file_, place_of_next(),
            fmt::format("{} is beyond the range of numbers; write a smaller one", printable(token)));
  }
  std::string_view what = error.what();
  if (const std::size_t end_of_place = what.find(": "); end_of_place != what.npos) what.remove_prefix(end_of_place + 2);
  if (format_ == Format::cbor)
    fail_at(file_, "", fmt::format("byte {}: {}; the file is damaged", byte, printable(what)));
  const std::size_t position = std::min(positions_.of(byte > 0 ? byte - 1 : 0), source_.size());
  fail_syntax(source_, file_, position, fmt::format("{}; mend the JSON", printable(what)));
}

Document parse_json(std::string_view text, std::string_view file) {
  check_size(text, file);
  if (const std::size_t nul = text.find('\0'); nul != text.npos) {
    fail_syntax(text, file, nul, "a byte of 0, which no JSON has; save the file as plain text in UTF-8");
  }
  DocumentBuilder builder(text, file, Format::json);
  const BlankSkipper begin(text, 0, builder.positions());
  const BlankSkipper end(text, text.size(), builder.positions());
  Json::sax_parse(begin, end, &builder);
  return builder.take();
}

bool is_json(std::string_view text) {
  return text.find('\0') == text.npos && Json::accept(text);
}

Document text_document(std::string_view text) {
  check_size(text, "");
  DocumentBuilder builder(text, "", Format::json);
  std::string copy(text);
  builder.string(copy);
  return builder.take();
}

Document parse_cbor(std::string_view bytes, std::string_view file) {
  check_size(bytes, file);
  refuse_strings_in_pieces(bytes, file);
  DocumentBuilder builder(bytes, file, Format::cbor);
  Json::sax_parse(bytes, &builder, Json::input_format_t::cbor);
  return builder.take();
}

}  // namespace pliant
