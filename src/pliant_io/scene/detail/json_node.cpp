#include "pliant_io/scene/detail/json_node.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant_io/scene/nearest_names.h"

namespace pliant {

namespace {

/// The way from a value to one inside it, ".bodies[0].mesh"; false: it is not inside.
bool find_way(const SceneJson& from, const SceneJson& to, std::string& way) {
  if (&from == &to) return true;
  if (from.is_array()) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (find_way(from[i], to, way)) return way.insert(0, fmt::format("[{}]", i)), true;
    }
  } else if (from.is_object()) {
    for (const auto& [key, value] : from.get_ref<const SceneJson::object_t&>()) {
      if (find_way(value, to, way)) return way.insert(0, "." + printable(key)), true;
    }
  }
  return false;
}

}  // namespace

SourcePlace Node::place() const {
  std::string way;
  find_way(*placed_, *value_, way);
  if (place_->path.empty() && way.starts_with('.')) way.erase(0, 1);
  return {place_->origin, place_->path + way};
}

std::string_view Node::bytes() const {
  const SceneJson::binary_t& bytes = value_->get_binary();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};  // NOLINT
}

Node Node::inner(const SceneJson& value, const OriginMap* origins) const {
  Node node = *this;
  node.value_ = &value;
  node.origins_ = origins;
  if (origins == nullptr || !origins->place) return node;
  node.place_ = &*origins->place;
  node.placed_ = &value;
  return node;
}

Node Node::operator[](std::size_t i) const {
  const OriginMap* origins = nullptr;
  if (origins_ != nullptr) {
    if (const auto found = origins_->entries.find(i); found != origins_->entries.end()) origins = &found->second;
  }
  return inner((*value_)[i], origins);
}

std::optional<Node> Node::find(std::string_view key) const {
  if (!is_object()) return std::nullopt;
  const auto& object = value_->get_ref<const SceneJson::object_t&>();
  const auto entry = std::ranges::find_if(object, [&](const auto& each) { return each.first == key; });
  if (entry == object.end()) return std::nullopt;
  const OriginMap* origins = nullptr;
  if (origins_ != nullptr) {
    if (const auto found = origins_->keys.find(key); found != origins_->keys.end()) origins = &found->second;
  }
  return inner(entry->second, origins);
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
  for (const auto& [key, value] : value_->get_ref<const SceneJson::object_t&>()) keys.push_back(key);
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
    require(key).fail(fmt::format("unknown key; {}", suggestion_text(key, known)));
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

std::string Node::at(std::string_view what) const {
  const SourcePlace place = this->place();
  const std::string path = place.path.empty() ? std::string() : place.path + ": ";  // a --set is its own place
  return fmt::format("{}: {}{}", printable_place(place.origin->name), path, what);
}

void Node::fail(std::string_view what) const {
  const SourcePlace place = this->place();
  fail_at(place.origin->name, place.path, what);
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
