#include "pliant/scene/detail/json_node.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/scene/nearest_names.h"

namespace pliant {

std::optional<Node> Node::find(std::string_view key) const {
  if (!is_object()) return std::nullopt;
  for (std::size_t i = 0; i < document_->size(place_); ++i) {
    if (document_->text(document_->key(place_, i)) != key) continue;
    return Node(*document_, file_, document_->member(place_, i));
  }
  return std::nullopt;
}

Node Node::require(std::string_view key) const {
  require_object();
  std::optional<Node> found = find(key);
  if (!found) fail(fmt::format("the key '{}' is missing; add it", key));
  return *found;
}

std::vector<std::string_view> Node::keys() const {
  std::vector<std::string_view> keys;
  for (std::size_t i = 0; i < size(); ++i) keys.push_back(document_->text(document_->key(place_, i)));
  return keys;
}

void Node::require_object() const {
  if (!is_object()) fail_type("an object {...}");
}

void Node::require_list() const {
  if (!is_list()) fail_type("a list [...]");
}

void Node::require_list(std::size_t size, std::string_view entries) const {
  require_list();
  if (this->size() != size) {
    fail(fmt::format("the list has {} entries; give {} {}", this->size(), size, entries));
  }
}

void Node::check_keys(const std::vector<std::string_view>& known) const {
  require_object();
  for (std::size_t i = 0; i < document_->size(place_); ++i) {
    const std::string_view key = document_->text(document_->key(place_, i));
    if (std::ranges::find(known, key) != known.end()) continue;
    Node(*document_, file_, document_->member(place_, i))
        .fail(fmt::format("unknown key; known here, the nearest first: {}", nearest_names_text(key, known)));
  }
}

std::string_view Node::require_one_of(const std::vector<std::string_view>& keys) const {
  require_object();
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
  fail_at(file_, document_->path_of(place_), what);
}

void Node::fail_type(std::string_view wanted) const {
  const std::string_view found = is_object()    ? "an object"
                                 : is_list()    ? "a list"
                                 : is_text()    ? "a string"
                                 : is_boolean() ? "a boolean"
                                 : is_null()    ? "null"
                                 : is_bytes()   ? "bytes"
                                                : "a number";
  fail(fmt::format("{} is wanted here, not {}", wanted, found));
}

}  // namespace pliant
