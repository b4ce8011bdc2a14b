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

/// Panels [begin, end).
struct PanelRange {
  Index begin = 0;
  Index end = 0;
};

/// Subtrees that follow each other, panels [begin, end) in all, without what tasks of earlier stages have of them. Rows
/// below that are not in the subtrees belong to later stages and to the rest.
struct PanelTask {
  Index begin = 0;
  Index end = 0;
  std::vector<PanelRange> ranges;
};

/// Tasks that can be swept at the same time.
using PanelStage = std::vector<PanelTask>;

/// Divides the panels into stages and a rest. In forward substitution each stage comes after the one before it, and the
/// rest after them all; in backward substitution the order is reversed. Depends on the factor alone, never on the
/// number of threads. Where panels do not stand in postorder, there are no stages.
std::vector<PanelStage> divide(const std::vector<PanelShape>& panels);

}  // namespace pliant
