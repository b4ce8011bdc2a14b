#pragma once
// Colliders as scene files have them: the options of one built-in type.
#include <variant>

#include "pliant/collision/colliders/builtin.h"
#include "pliant_io/scene/detail/constraint_options.h"

namespace pliant {

using ColliderOptions = VariantOf<BuiltinColliders>::Type;

/// Whether that is the type of a collider.
bool is_collider_type(std::string_view type);
/// The options of the type that the key "type" names; "name", "appearance" and `more_keys` are known besides their own
/// keys.
ColliderOptions read_collider_options(const Node& node, std::vector<std::string_view> more_keys = {});
/// Takes the options that the object has into those there are; `more_keys` are known besides.
void read_changed_collider(const Node& node, std::vector<std::string_view> more_keys, ColliderOptions& options);

std::string_view type_of(const ColliderOptions& options);
ColliderId add(Simulation& simulation, const ColliderOptions& options, const std::string& name);
void replace(Simulation& simulation, ColliderId collider, const ColliderOptions& options);

}  // namespace pliant
