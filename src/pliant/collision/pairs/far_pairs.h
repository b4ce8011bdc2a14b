#pragma once
// Most pairs whose boxes meet are neighbors in a flat piece of a surface, and far apart by several times what matters.
// Their distances are found four at a time in single precision, so well that none is left out that matters.
#include <span>

#include "pliant/collision/pairs/pair.h"

namespace pliant {

class FarPairs {
 public:
  /// Features of one surface: their numbers, as in Pair, but loose edges from the first of them on.
  struct Items {
    Index first, second;
  };

  /// A pair is far if at q (m × 3, finite) [m] it is farther apart than `reach` of a vertex of one side, and of one of
  /// the other, together [m]. All must stay.
  FarPairs(const Surface& surface, const Positions& q, std::span<const Real> reach)
      : surface_(&surface), q_(&q), reach_(reach) {}

  /// Moves those that may not be far to the front, in the order in which they were, and returns how many they are.
  std::size_t drop(PairKind kind, std::span<Items> pairs) const;

 private:
  struct Four;
  template <PairKind kind>
  std::size_t drop_far(std::span<Items> pairs) const;

  const Surface* surface_;
  const Positions* q_;
  std::span<const Real> reach_;
};

}  // namespace pliant
