#pragma once
// Which pins an event lets go, and what is left of their group then.
#include <vector>

#include "pliant/constraints/position.h"
#include "pliant/simulation/simulation.h"
#include "pliant_io/scene/detail/selection.h"

namespace pliant {

// `pinned`: the vertices that a group of positions holds, with the indices of its body, in the order of its targets.

/// Which of these a selection holds; of a list, all of them must be there.
std::vector<Index> read_released(const Node& node, const SceneBody& body, const std::vector<Index>& pinned);

/// The same by the numbers of constraints.
std::vector<Index> read_released_numbers(const Node& node, const Group& group, const std::vector<Index>& pinned);

/// Positions without those of some vertices.
void leave_out(std::vector<Index> released, const std::vector<Index>& pinned, Position& options);

}  // namespace pliant
