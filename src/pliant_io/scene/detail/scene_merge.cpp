#include "pliant_io/scene/detail/scene_merge.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

#include <fmt/format.h>

#include "pliant_io/scene/nearest_names.h"

namespace pliant {
namespace {

using SceneObject = SceneJson::object_t;

/// A value that is changed, with its origins.
struct Target {
  SceneJson* json;
  OriginMap* origins;
};

SceneJson* find_key(SceneJson& object, std::string_view key) {
  for (auto& [name, value] : object.get_ref<SceneObject&>()) {
    if (name == key) return &value;
  }
  return nullptr;
}

/// A new key at the end. The library's own growth would copy all values.
SceneJson& append_key(SceneJson& object, std::string_view key, SceneJson value) {
  auto& entries = object.get_ref<SceneObject&>();
  if (entries.size() == entries.capacity()) {
    SceneObject larger;
    larger.reserve(2 * entries.size() + 1);
    for (auto& [name, old] : entries) larger.emplace_back(name, std::move(old));
    entries.swap(larger);
  }
  return entries.emplace_back(std::string(key), std::move(value)).second;
}

/// Writes the places of all that a value holds beside each, since its own is about to change.
void spread_places(const SceneJson& json, OriginMap& origins, const SourcePlace& place) {
  const auto spread = [&](OriginMap& inner, auto&& path) {
    if (!inner.place) inner.place = SourcePlace{place.origin, path()};
  };
  if (json.is_object()) {
    for (const auto& entry : json.get_ref<const SceneObject&>()) {
      spread(origins.keys[entry.first], [&] { return join_key(place.path, entry.first); });
    }
  } else {
    for (std::size_t i = 0; i < json.size(); ++i) {
      spread(origins.entries[i], [&] { return fmt::format("{}[{}]", place.path, i); });
    }
  }
}

/// Puts one over the other; both are of the same kind, and have their places.
void merge(Target base, Target over, auto&& merge_key) {
  spread_places(*base.json, *base.origins, *base.origins->place);
  spread_places(*over.json, *over.origins, *over.origins->place);
  base.origins->place = over.origins->place;
  if (base.json->is_array()) {
    const std::size_t count = base.json->size();
    auto& list = base.json->get_ref<SceneJson::array_t&>();
    for (SceneJson& entry : over.json->get_ref<SceneJson::array_t&>()) list.push_back(std::move(entry));
    for (auto& [i, origins] : over.origins->entries) base.origins->entries[count + i] = std::move(origins);
    return;
  }
  for (auto& [key, value] : over.json->get_ref<SceneObject&>()) {
    OriginMap& origins = over.origins->keys.at(key);
    SceneJson* const old = find_key(*base.json, key);
    if (old != nullptr && merge_key(key, Target{old, &base.origins->keys.at(key)}, Target{&value, &origins})) continue;
    (old != nullptr ? *old : append_key(*base.json, key, nullptr)) = std::move(value);
    base.origins->keys[key] = std::move(origins);
  }
}

/// Objects in objects, as a camera is in a view.
bool merge_objects(std::string_view, Target base, Target over) {
  if (!base.json->is_object() || !over.json->is_object()) return false;
  merge(base, over, merge_objects);
  return true;
}

/// A list or an object at the top of a scene that goes on from the included scenes to the one that includes them.
bool merge_top_key(const Document& base_document, const Document& over_document, std::string_view key, Target base,
                   Target over) {
  constexpr std::array<std::string_view, 6> lists = {"bodies", "attachments", "forces", "colliders", "moves", "events"};
  constexpr std::array<std::string_view, 5> objects = {"settings", "contact", "output", "view", "materials"};
  for (const Document* document : {&base_document, &over_document}) {
    const Node node = Node(*document).require(key);
    if (std::ranges::find(lists, key) != lists.end()) node.require_list();
    if (std::ranges::find(objects, key) != objects.end()) node.require_object();
  }
  if (std::ranges::find(lists, key) != lists.end() || std::ranges::find(objects, key) != objects.end()) {
    merge(base, over, merge_objects);
    return true;
  }
  return false;
}

/// One step of a path: a key of an object, or an entry of a list by index or by name.
struct PathStep {
  bool is_key;
  std::string_view text;
};

constexpr std::string_view path_example = "write it like bodies[0].constraints[bend].stiffness";

std::vector<PathStep> split_path(std::string_view path, const Node& value) {
  std::vector<PathStep> steps;
  const auto fail = [&] { value.fail(fmt::format("'{}' is not a path; {}", printable(path), path_example)); };
  while (!path.empty()) {
    const bool is_key = path.front() != '[';
    if (is_key != (steps.empty() || path.front() == '.')) fail();
    if (!is_key || !steps.empty()) path.remove_prefix(1);
    const std::size_t end = is_key ? std::min(path.find_first_of(".["), path.size()) : path.find(']');
    if (end == 0 || end == path.npos) fail();
    steps.push_back({is_key, path.substr(0, end)});
    path.remove_prefix(is_key ? end : end + 1);
  }
  if (steps.empty() || steps.size() > max_json_depth) fail();
  return steps;
}

std::optional<std::size_t> to_index(std::string_view text) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return index;
}

bool has_text(const SceneJson& entry, std::string_view key, std::string_view text) {
  if (!entry.is_object()) return false;
  const auto value = entry.find(std::string(key));
  return value != entry.end() && value->is_string() && value->get_ref<const std::string&>() == text;
}

/// The index of the entry that a step means.
std::size_t entry_of(const SceneJson& list, std::string_view step, const Node& value) {
  if (const auto index = to_index(step)) {
    if (*index < list.size()) return *index;
    value.fail(list.empty()
                   ? "the list has no entries; write one in the scene file"
                   : fmt::format("[{}] is out of range; the list has entries 0 to {}", *index, list.size() - 1));
  }
  for (const std::string_view key : {"name", "type"}) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!has_text(list[i], key, step)) continue;
      if (found) {
        value.fail(fmt::format("[{}] and [{}] both have the {} '{}'; give an index", *found, i, key, printable(step)));
      }
      found = i;
    }
    if (found) return *found;
  }
  std::vector<std::string_view> names;
  for (const SceneJson& entry : list) {
    for (const char* key : {"name", "type"}) {
      if (!entry.is_object() || !entry.contains(key) || !entry.at(key).is_string()) continue;
      names.push_back(entry.at(key).get_ref<const std::string&>());
    }
  }
  value.fail(fmt::format("no entry is called '{}'; {}", printable(step), suggestion_text(step, names)));
}

/// How a path may go on from there.
std::string_view way_on(const SceneJson& json) {
  if (json.is_array()) return "name one of its entries, as in bodies[0]";
  if (json.is_object()) return "name one of its keys, as in settings.time_step";
  return "end the path there";
}

/// Goes one step down, and makes the object that is missing there.
Target step_down(Target from, const PathStep& step, std::string_view place, const Node& value) {
  if (!step.is_key) {
    if (!from.json->is_array()) {
      value.fail(
          fmt::format("{} is not a list, so [{}] leads nowhere; {}", place, printable(step.text), way_on(*from.json)));
    }
    const std::size_t index = entry_of(*from.json, step.text, value);
    return {&(*from.json)[index], &from.origins->entries[index]};
  }
  if (!from.json->is_object()) {
    value.fail(fmt::format("{} is not an object, so the key '{}' leads nowhere; {}", place, printable(step.text),
                           way_on(*from.json)));
  }
  OriginMap& origins = from.origins->keys[std::string(step.text)];
  if (SceneJson* const found = find_key(*from.json, step.text)) return {found, &origins};
  origins = OriginMap{.place = value.place()};
  return {&append_key(*from.json, step.text, SceneJson::object()), &origins};
}

}  // namespace

void merge_scene(Document& base, Document over) {
  merge({&base.json, &base.origins}, {&over.json, &over.origins},
        [&](std::string_view key, Target old, Target value) { return merge_top_key(base, over, key, old, value); });
}

void set_value(Document& document, std::string_view path, const Node& value) {
  const std::vector<PathStep> steps = split_path(path, value);
  if (steps[0].text == "include") {
    value.fail("what a scene includes cannot be set; write it into a scene of your own");
  }
  Target target = {&document.json, &document.origins};
  std::string place = "the scene";
  for (const PathStep& step : steps) {
    target = step_down(target, step, place, value);
    place = fmt::format("'{}'", printable(step.text));
  }
  *target.json = value.json();
  *target.origins = OriginMap{.place = value.place()};
}

SceneJson* find_value(SceneJson& json, std::string_view path) {
  SceneJson* found = &json;
  while (!path.empty() && found != nullptr) {
    const bool is_key = path.front() != '[';
    if (!is_key || path.front() == '.') path.remove_prefix(1);
    const std::size_t end = std::min(path.find_first_of(is_key ? ".[" : "]"), path.size());
    const std::string_view step = path.substr(0, end);
    path.remove_prefix(std::min(end + (is_key ? 0 : 1), path.size()));
    if (is_key) {
      found = found->is_object() ? find_key(*found, step) : nullptr;
      continue;
    }
    const auto index = to_index(step);
    found = index && found->is_array() && *index < found->size() ? &(*found)[*index] : nullptr;
  }
  return found;
}

}  // namespace pliant
