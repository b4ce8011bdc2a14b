#include "pliant/scene/detail/json_node.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/scene/nearest_names.h"

namespace pliant {
namespace {

[[noreturn]] void fail_at(std::string_view file, std::string_view path, std::string_view what) {
  fail_input(path.empty() ? fmt::format("{}: {}", file, what) : fmt::format("{}: {}: {}", file, path, what));
}

std::string join_key(std::string_view path, std::string_view key) {
  return path.empty() ? printable(key) : fmt::format("{}.{}", path, printable(key));
}

/// Builds the tree from the parser's events. nlohmann's own builder takes the last of two equal keys in silence.
class TreeBuilder {
 public:
  TreeBuilder(std::string_view text, std::string_view file) : text_(text), file_(file) {}

  Json take_root() { return std::move(root_); }

  // The parser's interface: true is "go on".
  bool null() { return place(nullptr); }
  bool boolean(bool value) { return place(value); }
  bool number_integer(Json::number_integer_t value) { return place(value); }
  bool number_unsigned(Json::number_unsigned_t value) { return place(value); }
  bool number_float(Json::number_float_t value, const std::string&) { return place(value); }
  bool string(std::string& value) { return place(std::move(value)); }
  bool binary(Json::binary_t& value) { return place(std::move(value)); }
  bool start_object(std::size_t) { return enter(Json::object()); }
  bool start_array(std::size_t) { return enter(Json::array()); }
  bool end_object() { return leave(); }
  bool end_array() { return leave(); }

  bool key(std::string& name) {
    Level& level = levels_.back();
    if (level.container->contains(name)) {
      fail_at(file_, path(), fmt::format("the key '{}' stands here twice; remove one of the two", printable(name)));
    }
    level.key = name;
    return true;
  }

  bool parse_error(std::size_t byte, const std::string& token, const Json::exception& error) {
    if (dynamic_cast<const Json::out_of_range*>(&error) != nullptr) {
      fail_at(file_, place_of_next(), fmt::format("{} is beyond the range of numbers; write a smaller one", token));
    }
    const std::string_view before = text_.substr(0, byte > 0 ? byte - 1 : 0);
    const auto line = 1 + std::ranges::count(before, '\n');
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    std::string_view what = error.what();
    if (const std::size_t end_of_place = what.find(": "); end_of_place != what.npos)
      what.remove_prefix(end_of_place + 2);
    fail_input(
        fmt::format("{}:{}:{}: {}; mend the JSON", file_, line, before.size() - line_start + 1, printable(what)));
  }

 private:
  struct Level {
    Json* container;
    std::string key;  // of an object: the one whose value comes next
  };

  Json* add(Json&& value) {
    if (levels_.empty()) return &(root_ = std::move(value));
    const Level& level = levels_.back();
    if (level.container->is_object()) return &((*level.container)[level.key] = std::move(value));
    level.container->push_back(std::move(value));
    return &level.container->back();
  }

  bool place(Json&& value) {
    add(std::move(value));
    return true;
  }

  bool enter(Json&& container) {
    if (levels_.size() >= max_json_depth) {
      fail_at(file_, path(), fmt::format("more than {} levels inside each other; flatten them", max_json_depth));
    }
    levels_.push_back({add(std::move(container)), {}});
    return true;
  }

  bool leave() {
    levels_.pop_back();
    return true;
  }

  /// Where the innermost open container stands.
  std::string path() const {
    std::string text;
    for (std::size_t i = 0; i + 1 < levels_.size(); ++i) append_step(text, levels_[i], 1);
    return text;
  }

  /// Where a value would stand that comes now.
  std::string place_of_next() const {
    std::string text = path();
    if (!levels_.empty()) append_step(text, levels_.back(), 0);
    return text;
  }

  /// `entered`: how many entries of a list have come that are not before the one meant.
  static void append_step(std::string& text, const Level& level, std::size_t entered) {
    if (level.container->is_object()) {
      text = join_key(text, level.key);
    } else {
      text += fmt::format("[{}]", level.container->size() - entered);
    }
  }

  std::string_view text_;
  std::string_view file_;
  Json root_;
  std::vector<Level> levels_;
};

}  // namespace

Json parse_json(std::string_view text, std::string_view file) {
  TreeBuilder builder(text, file);
  Json::sax_parse(text, &builder);
  return builder.take_root();
}

std::string printable(std::string_view text) {
  std::size_t length = std::min(text.size(), std::size_t{160});
  if (length < text.size()) {
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;  // inside a character
  }
  std::string result(text.substr(0, length));
  std::ranges::replace_if(
      result, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, ' ');
  if (length < text.size()) result += "...";
  return result;
}

Node Node::operator[](std::size_t i) const {
  return Node(file_, (*value_)[i], fmt::format("{}[{}]", path_, i));
}

std::optional<Node> Node::find(std::string_view key) const {
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return Node(file_, *found, join_key(path_, key));
}

Node Node::require(std::string_view key) const {
  require_object();
  std::optional<Node> found = find(key);
  if (!found) fail(fmt::format("the key '{}' is missing; add it", key));
  return *std::move(found);
}

void Node::require_object() const {
  if (!value_->is_object()) fail_type("an object {...}");
}

void Node::require_list() const {
  if (!value_->is_array()) fail_type("a list [...]");
}

void Node::require_list(std::size_t size, std::string_view entries) const {
  require_list();
  if (value_->size() != size) {
    fail(fmt::format("the list has {} entries; give {} {}", value_->size(), size, entries));
  }
}

void Node::check_keys(const std::vector<std::string_view>& known) const {
  require_object();
  for (const auto& [key, value] : value_->items()) {
    if (std::ranges::find(known, std::string_view(key)) != known.end()) continue;
    fail_at(file_, join_key(path_, key),
            fmt::format("unknown key; known here, the nearest first: {}", nearest_names_text(key, known)));
  }
}

std::string_view Node::require_one_of(const std::vector<std::string_view>& keys) const {
  std::string_view found;
  for (const std::string_view key : keys) {
    if (!has(key)) continue;
    if (!found.empty()) fail(fmt::format("has both '{}' and '{}'; keep one", found, key));
    found = key;
  }
  if (found.empty()) fail(fmt::format("give one of the keys {}", fmt::join(keys, ", ")));
  return found;
}

void Node::fail(std::string_view what) const {
  fail_at(file_, path_, what);
}

void Node::fail_type(std::string_view wanted) const {
  const std::string_view found = value_->is_array() ? "list" : value_->type_name();
  fail(fmt::format("{} is wanted here, not {}{}", wanted, value_->is_object() ? "an " : "a ", found));
}

}  // namespace pliant
