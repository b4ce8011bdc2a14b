#include "pliant_io/scene/detail/json_node.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant_io/scene/detail/overlay.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant {

Node Node::operator[](std::size_t i) const {
  if (overlay_ != nullptr) {
    if (const auto found = overlay_->entries.find(i); found != overlay_->entries.end()) {
      const Overlay& over = found->second;
      if (over.value) return Node(*over.value->document_, *over.value->origin_, over.value->place_, &over);
      return Node(*document_, *origin_, document_->entry(place_, i), &over);
    }
  }
  return Node(*document_, *origin_, document_->entry(place_, i), nullptr);
}

std::optional<Node> Node::find_below(std::string_view key) const {
  for (std::size_t i = 0; i < document_->size(place_); ++i) {
    if (document_->text(document_->key(place_, i)) != key) continue;
    return Node(*document_, *origin_, document_->member(place_, i), nullptr);
  }
  return std::nullopt;
}

std::optional<Node> Node::find(std::string_view key) const {
  if (!is_object()) return std::nullopt;
  std::optional<Node> below = find_below(key);
  if (overlay_ == nullptr) return below;
  const auto found = overlay_->keys.find(key);
  if (found == overlay_->keys.end()) return below;
  const Overlay& over = found->second;
  if (over.value) below = over.value;
  if (!below) below = over.made;
  below->overlay_ = &over;
  return below;
}

Node Node::require(std::string_view key) const {
  require_object();
  std::optional<Node> found = find(key);
  if (!found) fail(fmt::format("the key '{}' is missing; add it", key));
  return *found;
}

std::vector<std::string_view> Node::keys() const {
  std::vector<std::string_view> keys;
  if (!is_object()) return keys;
  for (std::size_t i = 0; i < document_->size(place_); ++i) keys.push_back(document_->text(document_->key(place_, i)));
  if (overlay_ == nullptr) return keys;
  const std::size_t count = keys.size();
  for (const auto& [key, over] : overlay_->keys) {
    const auto end = keys.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(keys.begin(), end, key) == end) keys.push_back(key);
  }
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
  for (const std::string_view key : keys()) {
    if (std::ranges::find(known, key) != known.end()) continue;
    require(key).fail(fmt::format("unknown key; known here, the nearest first: {}", nearest_names_text(key, known)));
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
  if (found.empty()) fail(fmt::format("no key says which it is; give one of the keys {}", fmt::join(keys, ", ")));
  return found;
}

void Node::fail(std::string_view what) const {
  fail_at(origin_->name, document_->path_of(place_), what);
}

void Node::fail_type(std::string_view wanted) const {
  const std::string_view found = is_object()    ? "an object"
                                 : is_list()    ? "a list"
                                 : is_text()    ? "a string"
                                 : is_boolean() ? "a boolean"
                                 : is_null()    ? "null"
                                 : is_bytes()   ? "bytes"
                                                : "a number";
  fail(fmt::format("found {}; give {}", found, wanted));
}

}  // namespace pliant
