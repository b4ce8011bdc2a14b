#include "pliant_io/scene/detail/overlay.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "pliant_io/scene/nearest_names.h"

namespace pliant {
namespace {

/// One step of a path: a key of an object, or an entry of a list by index or by name.
struct PathStep {
  bool is_key;
  std::string_view text;
};

constexpr std::string_view path_example = "write it like bodies[0].constraints[bend].stiffness";

std::vector<PathStep> split_path(std::string_view path, const Node& value) {
  std::vector<PathStep> steps;
  const auto fail = [&] { value.fail(fmt::format("'{}' is no path; {}", printable(path), path_example)); };
  while (!path.empty()) {
    const bool is_key = path.front() != '[';
    if (is_key != (steps.empty() || path.front() == '.')) fail();
    if (!is_key || !steps.empty()) path.remove_prefix(1);
    const std::size_t end = is_key ? std::min(path.find_first_of(".["), path.size()) : path.find(']');
    if (end == 0 || end == path.npos) fail();
    steps.push_back({is_key, path.substr(0, end)});
    path.remove_prefix(is_key ? end : end + 1);
  }
  if (steps.empty() || steps.size() > max_document_depth) fail();
  return steps;
}

std::optional<std::size_t> to_index(std::string_view text) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return index;
}

bool has_text(const Node& entry, std::string_view key, std::string_view text) {
  const auto value = entry.find(key);
  return value && value->is_text() && value->text() == text;
}

/// The index of the entry that a step means, out of `count` entries; entry(i) is one of them.
std::size_t entry_of(std::size_t count, auto&& entry, std::string_view step, const Node& value) {
  if (const auto index = to_index(step)) {
    if (*index < count) return *index;
    value.fail(count == 0 ? "the list has no entries; write one in the scene file"
                          : fmt::format("[{}] is out of range; the list has entries 0 to {}", *index, count - 1));
  }
  for (const std::string_view key : {"name", "type"}) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < count; ++i) {
      if (!has_text(entry(i), key, step)) continue;
      if (found) {
        value.fail(fmt::format("[{}] and [{}] both have the {} '{}'; give an index", *found, i, key, printable(step)));
      }
      found = i;
    }
    if (found) return *found;
  }
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::string_view key : {"name", "type"}) {
      if (const auto name = entry(i).find(key); name && name->is_text()) names.push_back(name->text());
    }
  }
  value.fail(fmt::format("no entry is called '{}'; known, the nearest first: {}", printable(step),
                         nearest_names_text(step, names)));
}

Node empty_value(const Document& document, const Node& made_by) {
  return Node(document, made_by.origin());
}

const Document& empty_object() {
  static const Document document = parse_json("{}", "");
  return document;
}

const Document& empty_list() {
  static const Document document = parse_json("[]", "");
  return document;
}

/// How a path may go on from there.
std::string_view way_on(const Node& node) {
  if (node.is_list()) return "name one of its entries, as in bodies[0]";
  if (node.is_object()) return "name one of its keys, as in settings.time_step";
  return "end the path there";
}

/// Goes one step down, and makes the object that is missing there.
Node step_down(const Node& node, Overlay*& overlay, const PathStep& step, std::string_view place, const Node& value) {
  if (!step.is_key) {
    if (!node.is_list()) {
      value.fail(fmt::format("{} is no list, so [{}] leads nowhere; {}", place, printable(step.text), way_on(node)));
    }
    const auto entry = [&](std::size_t i) { return node[i]; };
    const std::size_t index = entry_of(node.size(), entry, step.text, value);
    overlay = &overlay->entries[index];
    return node[index];
  }
  if (!node.is_object()) {
    value.fail(
        fmt::format("{} is no object, so the key '{}' leads nowhere; {}", place, printable(step.text), way_on(node)));
  }
  const bool is_missing = !node.has(step.text);
  overlay = &overlay->keys[std::string(step.text)];
  if (is_missing) overlay->made = empty_value(empty_object(), value);
  return node.require(step.text);
}

/// Puts the value into one layer.
void put(SceneLayer& layer, std::span<const PathStep> steps, const Node& value) {
  Overlay* overlay = &layer.overlay;
  Node node = layer.root();
  std::string place = "the scene";
  for (const PathStep& step : steps) {
    node = step_down(node, overlay, step, place, value);
    place = fmt::format("'{}'", printable(step.text));
  }
  *overlay = Overlay{.value = value};
}

/// An entry of a list that goes on from layer to layer.
void put_entry(std::span<SceneLayer* const> layers, std::span<PathStep> steps, const Node& value) {
  std::vector<std::optional<Node>> lists;
  std::vector<std::size_t> ends;
  for (const SceneLayer* layer : layers) {
    lists.push_back(layer->root().find(steps[0].text));
    const bool is_list = lists.back() && lists.back()->is_list();
    ends.push_back((ends.empty() ? 0 : ends.back()) + (is_list ? lists.back()->size() : 0));
  }
  const auto place_of = [&](std::size_t index) {
    const auto layer = static_cast<std::size_t>(std::ranges::upper_bound(ends, index) - ends.begin());
    return std::pair(layer, index - (layer == 0 ? 0 : ends[layer - 1]));
  };
  const auto entry = [&](std::size_t index) {
    const auto place = place_of(index);
    return (*lists[place.first])[place.second];
  };
  const auto found = place_of(entry_of(ends.back(), entry, steps[1].text, value));
  const std::string local_index = std::to_string(found.second);
  steps[1].text = local_index;
  put(*layers[found.first], steps, value);
}

/// The last layer that has the list which the path goes into, if it goes into one; else the last.
SceneLayer& layer_of(std::span<SceneLayer* const> layers, std::span<const PathStep> steps) {
  const auto list_end = std::ranges::find(steps, false, &PathStep::is_key);
  if (list_end == steps.end()) return *layers.back();
  for (std::size_t i = layers.size(); i-- > 0;) {
    std::optional<Node> node = layers[i]->root();
    for (auto step = steps.begin(); node && step != list_end; ++step) node = node->find(step->text);
    if (node) return *layers[i];
  }
  return *layers.back();
}

}  // namespace

bool is_shared_list(std::string_view key) {
  constexpr std::array<std::string_view, 4> lists = {"bodies", "forces", "moves", "events"};
  return std::ranges::find(lists, key) != lists.end();
}

void set_value(std::span<SceneLayer* const> layers, std::string_view path, const Node& value) {
  std::vector<PathStep> steps = split_path(path, value);
  const std::string_view first = steps[0].text;
  if (first == "include") value.fail("what a scene includes cannot be set; write it into a scene of your own");
  if (!is_shared_list(first)) return put(layer_of(layers, steps), steps, value);
  if (steps.size() > 1 && !steps[1].is_key) return put_entry(layers, steps, value);
  if (steps.size() == 1) {  // the whole list: those of the included scenes go
    for (SceneLayer* layer : layers.first(layers.size() - 1)) {
      if (layer->root().has(first)) {
        layer->overlay.keys[std::string(first)] = Overlay{.value = empty_value(empty_list(), value)};
      }
    }
  }
  put(*layers.back(), steps, value);
}

}  // namespace pliant
