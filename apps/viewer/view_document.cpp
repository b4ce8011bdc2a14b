#include "viewer/view_document.h"

#include <algorithm>

#include "viewer/json_of.h"

namespace pliant_viewer {

void write_view(const pliant::ViewSettings& view, pliant::SceneDocument& document) {
  const Json changed = json_of(view);
  const Json all = all_options(view);
  for (const auto& [name, value] : all.items()) {
    const std::string path = "view." + name;
    if (value.is_null() || (value.is_object() && value.empty())) {
      document.remove(path);
    } else if (changed.contains(name) || !document.get(path).empty()) {
      document.set(path, value.dump());
    }
  }
}

bool leaves_place_open(const pliant::Camera& camera) {
  return !camera.position && camera.keyframes.empty() && camera.turn_rate == 0;
}

bool may_move_camera(const SceneChanges& changes) {
  const auto is_of_collider = [](const auto& value) {
    return std::holds_alternative<pliant::ColliderId>(value.second.parameter.handle.owner);
  };
  return !changes.added.empty() || !changes.switched_off.empty() || !changes.switched_on.empty() ||
         !changes.collider_poses.empty() || std::ranges::any_of(changes.values, is_of_collider);
}

}  // namespace pliant_viewer
