#pragma once
// A change of a scene that can be taken back, and where vertices are pinned.
#include <cstdint>
#include <map>
#include <string>

#include "pliant_io/scene/scene.h"
#include "render/vectors.h"
#include "viewer/scene_changes.h"

namespace pliant_viewer {

/// Where a vertex is pinned: the group, and which of its targets that is.
struct Pin {
  pliant::GroupId group{};
  Index target = 0;
};

/// A vertex that can be moved by its pin.
struct PinnedVertex {
  std::uint32_t vertex = 0;
  pliant_render::Vec3f target = {0, 0, 0};  ///< where it is held [m]
};

/// A change for undo().
struct Edit {
  std::string what;
  SceneChanges before{}, after{};
  std::map<std::string, pliant::Vec3> old_values{};  ///< of what `before` does not have
  std::map<Index, pliant::Vec3> held{};              ///< where the vertices are that it pins or lets go [m]
};

/// A text with changes, and the scene that it makes.
struct WrittenScene {
  pliant::Scene scene;
  std::vector<std::string> unwritten;  ///< changes that a scene file has no key for
  std::set<std::string> factors{};     ///< of stiffnesses, which the text has multiplied into its numbers
};

}  // namespace pliant_viewer
