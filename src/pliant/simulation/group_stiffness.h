#pragma once
// How stiff the constraints of a group are, to be shown.
#include <optional>
#include <string_view>

#include "pliant/simulation/simulation.h"

namespace pliant {

struct StiffnessRange {
  Real least = 0;         ///< [unit]
  Real most = 0;          ///< [unit]
  std::string_view unit;  ///< stiffness_unit()
  Real taut_factor = 1;   ///< how many times as stiff fibers are once they are taut (FibreStrain)
};

/// The unit of the stiffness of a group, as made: of fibers and ties it depends on other options. "" where the type has
/// no option `stiffness`, and where constraints were made elsewhere.
std::string_view stiffness_unit(const Group& group);

/// Between which stiffnesses those of the constraints of a group are by now, factors included; none of hard pins and
/// of groups without a constraint. Of constraints made elsewhere, the factor of their weights. Where constraints have a
/// list of stiffnesses of their own and factors of vertices besides, the range may be wider than theirs.
/// @throws Error (input) when there is no such group
std::optional<StiffnessRange> stiffness_range(const Simulation& simulation, GroupId id);

}  // namespace pliant
