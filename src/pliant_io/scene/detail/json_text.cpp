// nlohmann's parser reports what it meets; here that becomes a value, or a message that names its place.
#include "pliant_io/scene/detail/json_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/core/types.h"

namespace pliant {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

enum class TextFormat { json, cbor };

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

/// Takes the parser's reports; true is "go on". A container gets its entries when it closes, since then none of them
/// is copied while it grows.
class JsonBuilder {
 public:
  JsonBuilder(std::string_view source, std::string_view file, TextFormat format)
      : source_(source), file_(file), format_(format) {}

  SceneJson take() { return std::move(root_); }

  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(SceneJson::number_integer_t value) { return add(value); }
  bool number_unsigned(SceneJson::number_unsigned_t value) {
    constexpr auto largest = std::numeric_limits<std::int64_t>::max();
    if (value > largest) return add(static_cast<Real>(value));
    return add(static_cast<std::int64_t>(value));
  }
  bool number_float(Real value, const std::string&) {
    if (!std::isfinite(value)) fail_at(file_, place_of_next(), "the number is not finite; give a finite one");
    return add(value);
  }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(SceneJson::binary_t& value) { return add(std::move(value)); }
  bool key(std::string& name) {
    levels_.back().keys.push_back(std::move(name));
    return true;
  }
  bool start_object(std::size_t) { return enter(); }
  bool start_array(std::size_t) { return enter(); }
  bool end_array() {
    SceneJson::array_t list = std::move(levels_.back().values);
    levels_.pop_back();
    return add(std::move(list));
  }
  bool end_object();
  bool parse_error(std::size_t byte, const std::string& token, const nlohmann::json::exception& error);

 private:
  /// A container that is not closed yet.
  struct Level {
    std::vector<std::string> keys = {};  // of an object; the last may still want its value
    std::vector<SceneJson> values = {};
  };

  bool add(SceneJson value) {
    if (++count_ > max_json_values) {
      fail_at(file_, place_of_next(),
              fmt::format("more than {} values; put meshes and maps into files of their own", max_json_values));
    }
    (levels_.empty() ? root_ : levels_.back().values.emplace_back()) = std::move(value);
    return true;
  }
  bool enter() {
    if (levels_.size() >= max_json_depth) {
      fail_at(file_, place_of_next(),
              fmt::format("more than {} levels inside each other; flatten them", max_json_depth));
    }
    levels_.emplace_back();
    return true;
  }
  void refuse_double_keys() const;

  /// Where the container of level i stands, or, for i past the levels, a value that comes now.
  std::string place_of(std::size_t i) const;
  std::string place_of_next() const { return place_of(levels_.size()); }

  std::string_view source_;
  std::string_view file_;
  TextFormat format_;
  SceneJson root_;
  std::vector<Level> levels_;
  std::size_t count_ = 0;
};

std::string JsonBuilder::place_of(std::size_t i) const {
  std::string path;
  for (std::size_t outer = 0; outer < i; ++outer) {
    const Level& level = levels_[outer];
    path = level.keys.empty() ? fmt::format("{}[{}]", path, level.values.size()) : join_key(path, level.keys.back());
  }
  return path;
}

void JsonBuilder::refuse_double_keys() const {
  std::vector<std::string_view> keys(levels_.back().keys.begin(), levels_.back().keys.end());
  std::ranges::sort(keys);
  const auto twice = std::ranges::adjacent_find(keys);
  if (twice == keys.end()) return;
  fail_at(file_, place_of(levels_.size() - 1),
          fmt::format("the key '{}' stands here twice; remove one of the two", printable(*twice)));
}

bool JsonBuilder::end_object() {
  refuse_double_keys();
  Level level = std::move(levels_.back());
  levels_.pop_back();
  SceneJson::object_t object;
  object.reserve(level.keys.size());
  for (std::size_t i = 0; i < level.keys.size(); ++i) {
    object.emplace_back(std::move(level.keys[i]), std::move(level.values[i]));
  }
  return add(std::move(object));
}

bool JsonBuilder::parse_error(std::size_t byte, const std::string& token, const nlohmann::json::exception& error) {
  if (format_ == TextFormat::json && dynamic_cast<const nlohmann::json::out_of_range*>(&error) != nullptr) {
    fail_at(file_, place_of_next(),
            fmt::format("{} is beyond the range of numbers; write a smaller one", printable(token)));
  }
  std::string_view what = error.what();
  if (const std::size_t end_of_place = what.find(": "); end_of_place != what.npos) what.remove_prefix(end_of_place + 2);
  if (format_ == TextFormat::cbor) {
    fail_at(file_, "", fmt::format("byte {}: {}; the file is damaged", byte, printable(what)));
  }
  const std::size_t position = std::min(byte > 0 ? byte - 1 : 0, source_.size());
  fail_syntax(source_, file_, position, fmt::format("{}; fix the JSON", printable(what)));
}

}  // namespace

void check_json_size(std::uintmax_t bytes, std::string_view file) {
  if (bytes <= max_json_bytes) return;
  fail_at(file, "",
          fmt::format("is larger than {} MB; put meshes and maps into files of their own", max_json_bytes >> 20U));
}

SceneJson parse_json(std::string_view text, std::string_view file) {
  check_json_size(text.size(), file);
  if (const std::size_t nul = text.find('\0'); nul != text.npos) {
    fail_syntax(text, file, nul, "a byte of 0, which no JSON has; save the file as plain text in UTF-8");
  }
  JsonBuilder builder(text, file, TextFormat::json);
  SceneJson::sax_parse(text, &builder);
  return builder.take();
}

bool is_json(std::string_view text) {
  return text.find('\0') == text.npos && SceneJson::accept(text);
}

SceneJson parse_cbor(std::string_view bytes, std::string_view file) {
  if (bytes.size() > max_cbor_bytes) fail_at(file, "", "is larger than 1 GB; take another checkpoint");
  refuse_strings_in_pieces(bytes, file);
  JsonBuilder builder(bytes, file, TextFormat::cbor);
  SceneJson::sax_parse(bytes, &builder, SceneJson::input_format_t::cbor);
  return builder.take();
}

std::string join_key(std::string_view path, std::string_view key) {
  return path.empty() ? printable(key) : fmt::format("{}.{}", path, printable(key));
}

void fail_at(std::string_view file, std::string_view path, std::string_view what) {
  const std::string place = path.empty() ? "" : printable_place(path) + ": ";
  fail_input(fmt::format("{}: {}{}", printable_place(file), place, what));
}

}  // namespace pliant
