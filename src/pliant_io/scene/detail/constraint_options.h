#pragma once
// Constraints as scene files have them: the options of one built-in type.
#include <variant>

#include "pliant/constraints/builtin.h"
#include "pliant/simulation/simulation.h"
#include "pliant_io/scene/detail/option_reader.h"

namespace pliant {

template <class List, class... More>
struct VariantOf;
template <class... Types, class... More>
struct VariantOf<std::tuple<Types...>, More...> {
  using Type = std::variant<Types..., More...>;
};
using ConstraintOptions = VariantOf<BuiltinConstraints, Attachment>::Type;

/// The options of the type that the key "type" names. Other keys than theirs and `more_keys` are refused.
ConstraintOptions read_constraint_options(const Node& node, std::vector<std::string_view> more_keys,
                                          const SceneBody& body);

/// Takes the options that the object has into those there are. Stencils and selection replace each other; with either,
/// targets and origins that are not there as well are left open.
void read_changed_options(const Node& node, std::vector<std::string_view> more_keys, const SceneBody& body,
                          ConstraintOptions& options);

std::string_view type_of(const ConstraintOptions& options);
const Values& stiffness_of(const ConstraintOptions& options);

/// Adds a group to a simulation.
GroupId add(Simulation& simulation, BodyId body, const ConstraintOptions& options, const std::string& name);
void replace(Simulation& simulation, GroupId group, const ConstraintOptions& options, Anchors anchors);

}  // namespace pliant
