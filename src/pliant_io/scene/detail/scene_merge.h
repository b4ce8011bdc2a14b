#pragma once
// What makes one document of several: a scene goes on from those that it includes, and values are set by their paths.
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// Puts `over` over `base`: lists of bodies, forces, moves and events go on, settings, output and view are merged key
/// by key, of all else the later counts.
/// @throws Error(input) where one of these lists or objects is none.
void merge_scene(Document& base, Document over);

/// Puts `value` at a path such as `bodies[0].mass.total` or `bodies[sheet].constraints[bend].stiffness`: entries of a
/// list go by their index or by their name ("name", or "type" where only one has it). Objects that are missing on the
/// way are made.
/// @throws Error(input) with the place of the value, where the path leads nowhere.
void set_value(Document& document, std::string_view path, const Node& value);

/// The value at such a path whose lists are gone into by index; null where there is none.
SceneJson* find_value(SceneJson& json, std::string_view path);

}  // namespace pliant
