#pragma once
// Which boxes of one list overlap which of another.
#include <functional>
#include <span>

#include "pliant/core/types.h"

namespace pliant::collision {

struct Box {
  Vec3 low;
  Vec3 high;

  bool contains(const Vec3& x) const { return (low.array() <= x.array()).all() && (x.array() <= high.array()).all(); }
  bool overlaps(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// Calls `visit` with each pair of a box of `queries` and one of `boxes` that overlap or touch, each pair once. Ends
/// early, and returns false, past an effort of `most`: 1 for two boxes that are compared, 32 for a call of `visit`.
bool visit_overlaps(std::span<const Box> queries, std::span<const Box> boxes, std::int64_t most,
                    const std::function<void(Index query, Index box)>& visit);

}  // namespace pliant::collision
