#pragma once
// Vertices of surfaces that are sewn together: features at them are neighbors, as those that share a vertex are, and do
// not push each other.
#include <array>
#include <span>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// A vertex, and one of what it is joined to.
struct Joint {
  Index a = 0;
  Index b = 0;
  bool is_alone = false;  ///< a is joined to nothing but b: both are one point, and are joined to what either is
};

class JoinedVertices {
 public:
  JoinedVertices() = default;
  JoinedVertices(std::span<const Joint> joints, Index vertex_count);

  bool is_empty() const { return points_.empty(); }
  /// Whether a vertex of the one side is joined to one of the other.
  bool are_joined(std::span<const Index> side_a, std::span<const Index> side_b) const;

 private:
  std::vector<Index> points_;  // of each vertex one that stands for all that it is one point with; −1: joined to none
  std::vector<std::array<Index, 2>> joints_;  // of points, the smaller first, sorted
};

}  // namespace pliant
