#include "pliant_io/scene/detail/renamed_keys.h"

#include <array>

#include <fmt/format.h>

namespace pliant {
namespace {

/// A key of an object at the top of a scene.
struct RenamedKey {
  std::string_view object;
  std::string_view before;
  std::string_view now;
};
constexpr std::array renamed_keys = {
    RenamedKey{"view", "colour", "color"},
    RenamedKey{"view", "colour_range", "color_range"},
};

std::string rename_warning(std::string_view place, const RenamedKey& key) {
  return fmt::format("{}: '{}' is called '{}' now; rename it, since the next version refuses the old name",
                     printable_place(place), key.before, key.now);
}

/// The same object, in the same order.
void rename_key(SceneJson& object, const RenamedKey& key) {
  auto& entries = object.get_ref<SceneJson::object_t&>();
  SceneJson::object_t renamed;
  renamed.reserve(entries.size());
  for (auto& [name, value] : entries) {
    renamed.emplace_back(name == key.before ? std::string(key.now) : name, std::move(value));
  }
  entries.swap(renamed);
}

}  // namespace

void rename_old_keys(Document& document, std::vector<std::string>& warnings) {
  for (const RenamedKey& key : renamed_keys) {
    const auto object = Node(document).find(key.object);
    const auto old = object ? object->find(key.before) : std::nullopt;
    if (!old) continue;
    if (object->has(key.now)) {
      old->fail(fmt::format("'{}' is called '{}' now, and both stand here; keep '{}'", key.before, key.now, key.now));
    }
    const SourcePlace place = old->place();
    warnings.push_back(rename_warning(fmt::format("{}: {}", place.origin->name, place.path), key));
    rename_key(document.json[std::string(key.object)], key);
    auto& keys = document.origins.keys[std::string(key.object)].keys;
    OriginMap& origins = keys[std::string(key.now)];
    if (const auto found = keys.find(key.before); found != keys.end()) origins = std::move(found->second);
    if (!origins.place) origins.place = place;
  }
}

std::string rename_old_path(std::string_view path, std::string_view name, std::vector<std::string>& warnings) {
  for (const RenamedKey& key : renamed_keys) {
    const std::string before = fmt::format("{}.{}", key.object, key.before);
    if (!path.starts_with(before)) continue;
    const std::string_view rest = path.substr(before.size());
    if (!rest.empty() && rest[0] != '.' && rest[0] != '[') continue;
    warnings.push_back(rename_warning(name, key));
    return fmt::format("{}.{}{}", key.object, key.now, rest);
  }
  return std::string(path);
}

}  // namespace pliant
