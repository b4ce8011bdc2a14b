#pragma once
// Forces as scene files have them: the options of one built-in type, and the body that they are for.
#include <optional>
#include <variant>
#include <vector>

#include "pliant/forces/builtin.h"
#include "pliant/simulation/simulation.h"
#include "pliant_io/scene/detail/constraint_options.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

struct SceneReader;

using ForceOptions = VariantOf<BuiltinForces>::Type;

struct ForceEntry {
  std::optional<BodyId> body{};  ///< none: all
  ForceOptions options{};
};

/// Gravity has a key of its own at the top; every other type stands in the list of forces.
template <class Options>
inline constexpr bool is_listed_force = !std::is_same_v<Options, Gravity>;

/// Whether that is the type of a force.
bool is_force_type(std::string_view type);
/// The force of the type that the key "type" names; "name" and `more_keys` are known besides its own keys.
ForceEntry read_force_options(const Node& node, std::vector<std::string_view> more_keys, const SceneReader& scene);
/// Takes the options that the object has into those there are.
void read_changed_force(const Node& node, std::vector<std::string_view> more_keys, const SceneReader& scene,
                        ForceEntry& entry);
std::string_view type_of(const ForceEntry& entry);
ForceId add(Simulation& simulation, const ForceEntry& entry, const std::string& name);
void replace(Simulation& simulation, ForceId force, const ForceEntry& entry);

}  // namespace pliant
