#pragma once
// Which boxes of one list overlap which of another.
#include <functional>
#include <span>

#include "pliant/core/types.h"

namespace pliant::collision {

struct Box {
  Vec3 low;
  Vec3 high;

  bool overlaps(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// Calls `visit` with each pair of a box of `queries` and one of `boxes` that overlap or touch, each pair once.
void visit_overlaps(std::span<const Box> queries, std::span<const Box> boxes,
                    const std::function<void(Index query, Index box)>& visit);

}  // namespace pliant::collision
