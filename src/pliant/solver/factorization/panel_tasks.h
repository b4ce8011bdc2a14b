#pragma once
// Which panels of a factor can be swept at the same time: disjoint subtrees of the elimination tree.
#include <cstdint>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// What the division needs of a panel.
struct PanelShape {
  Index parent = -1;  ///< the panel that has its first row below; -1: none
  std::int64_t weight = 0;
};

/// Panels [begin, end): subtrees that follow each other. Their rows below that are not their own belong to the rest.
struct PanelTask {
  Index begin = 0;
  Index end = 0;
};

/// Divides the panels into tasks and a rest, which comes after them on the way forward and before them on the way back.
/// Depends on the factor alone, never on the number of threads. Where panels do not stand in postorder, there are no
/// tasks.
std::vector<PanelTask> divide(const std::vector<PanelShape>& panels);

}  // namespace pliant
