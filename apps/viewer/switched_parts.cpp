// What is switched off, and what was added, in the text of a scene.
#include <fmt/format.h>

#include "viewer/collider_entry.h"
#include "viewer/json_of.h"
#include "viewer/scene_changes.h"

namespace pliant_viewer {

void UnchangedScene::read_disabled(const pliant::Scene& scene) {
  for (const auto& [name, part] : scene.disabled) {
    SwitchedOff off{.type = part.type,
                    .is_collider = part.is_collider,
                    .pinned = part.pinned,
                    .goes_with_material = part.goes_with_material};
    if (part.body) {
      BodyPart& body = bodies_.at(static_cast<std::size_t>(*part.body));
      off.body = body.name;
      const auto place = scene.places.find(name);
      if (part.goes_with_material && place != scene.places.end()) body.replaced.push_back(place->second);
      if (!part.factors.empty()) factors_[name] = {body.name, part.factors};
    }
    for (std::size_t i = 0; i < part.pinned.size(); ++i) pin_numbers_[name].insert(static_cast<Index>(i));
    off_.emplace(name, std::move(off));
  }
}

std::map<std::string, SwitchedOff> UnchangedScene::switched_off(const SceneChanges& changes) const {
  std::map<std::string, SwitchedOff> off = changes.switched_off;
  for (const auto& [name, part] : off_) {
    if (!changes.switched_on.contains(name)) off.emplace(name, part);
  }
  return off;
}

bool UnchangedScene::can_switch_off(const std::string& name, const SceneChanges& changes) const {
  if (!has_text_) return true;
  if (changes.added.contains(name)) return true;
  if (as_read_.later_places.contains(name)) return false;  // it would come back
  const auto place = as_read_.places.find(name);
  if (place != as_read_.places.end()) return !is_replaced(place->second, changes);
  return off_.contains(name) || is_of_material(name, changes);
}

std::set<std::string> UnchangedScene::removed_by_events(const SceneChanges& changes) const {
  std::set<std::string> groups;
  for (const auto& [name, off] : switched_off(changes)) {
    const bool has_place = as_read_.places.contains(name) || changes.added.contains(name);
    if (has_text_ && !has_place && !off.goes_with_material && is_of_material(name, changes)) groups.insert(name);
  }
  return groups;
}

/// Entries have it beside their options, bodies the names of the groups that their material makes.
void UnchangedScene::write_switches(const SceneChanges& changes, pliant::SceneDocument& document) const {
  const std::map<std::string, SwitchedOff> off = switched_off(changes);
  const auto place_of = [&](const std::string& name) {
    const auto found = as_read_.places.find(name);
    const bool is_there = found != as_read_.places.end() && !is_replaced(found->second, changes);
    return is_there ? found->second : std::string();
  };
  for (const auto& [name, part] : off) {
    const std::string place = place_of(name);
    if (place.empty()) continue;
    if (place == "gravity" && !document.get(place).starts_with('{')) {
      Json gravity = Json::object();
      if (const std::string given = document.get(place); !given.empty()) gravity["acceleration"] = Json::parse(given);
      document.set(place, gravity.dump());
    }
    document.set(place + ".enabled", "false");
  }
  for (const std::string& name : changes.switched_on) {
    const std::string place = place_of(name);
    if (!place.empty()) document.remove(place + ".enabled");
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const std::string& body = bodies_[i].name;
    Json names = Json::array();
    for (const auto& [name, part] : off) {
      const bool has_place = as_read_.places.contains(name) || changes.added.contains(name);
      const bool is_there = groups_.contains(name) || off_.contains(name) || changes.materials.contains(body);
      if (part.body == body && part.goes_with_material && !has_place && is_there) names.push_back(name);
    }
    const std::string list = fmt::format("bodies[{}].disabled_groups", i);
    if (names.empty()) {
      document.remove(list);
    } else {
      document.set(list, names.dump());
    }
  }
}

void UnchangedScene::write_added(const SceneChanges& changes, pliant::SceneDocument& document) const {
  for (const auto& [name, part] : changes.added) {
    Json entry = Json::parse(part.entry);
    const bool has_body = !entry.contains("body") || find_body(entry["body"].get<std::string>()).has_value();
    const bool is_taken = as_read_.places.contains(name) || as_read_.later_places.contains(name);
    if (!has_body || is_taken) continue;
    const auto moved = changes.collider_poses.find(name);
    if (moved != changes.collider_poses.end()) entry.update(pose_keys(entry, moved->second));
    for (const auto& [key, changed] : changes.values) {
      const pliant::ParameterOwner& owner = changed.parameter.handle.owner;
      const bool is_part =
          std::holds_alternative<pliant::ForceId>(owner) || std::holds_alternative<pliant::ColliderId>(owner);
      if (is_part && changed.parameter.name == name) {
        entry[changed.parameter.handle.option] = value_json(changed.parameter, changed.value);
      }
    }
    if (changes.switched_off.contains(name)) entry["enabled"] = false;
    document.append(part.list, entry.dump());
  }
}

}  // namespace pliant_viewer
