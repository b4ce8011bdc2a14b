#include "pliant/collision/pairs/joined_vertices.h"

#include <algorithm>

namespace pliant {
namespace {

/// The vertex that stands for all that a vertex is one point with.
Index root_of(std::vector<Index>& parents, Index vertex) {
  while (parents[at(vertex)] != vertex) {
    parents[at(vertex)] = parents[at(parents[at(vertex)])];
    vertex = parents[at(vertex)];
  }
  return vertex;
}

}  // namespace

JoinedVertices::JoinedVertices(std::span<const Joint> joints, Index vertex_count) {
  if (joints.empty()) return;
  points_.assign(at(vertex_count), -1);
  for (const Joint& joint : joints) {
    points_[at(joint.a)] = joint.a;
    points_[at(joint.b)] = joint.b;
  }
  for (const Joint& joint : joints) {
    if (!joint.is_alone) continue;
    const auto [low, high] = std::minmax({root_of(points_, joint.a), root_of(points_, joint.b)});
    points_[at(high)] = low;
  }
  for (Index v = 0; v < vertex_count; ++v) {
    if (points_[at(v)] >= 0) points_[at(v)] = root_of(points_, v);
  }
  for (const Joint& joint : joints) {
    const Index a = points_[at(joint.a)], b = points_[at(joint.b)];
    if (a != b) joints_.push_back({std::min(a, b), std::max(a, b)});
  }
  std::ranges::sort(joints_);
  joints_.erase(std::unique(joints_.begin(), joints_.end()), joints_.end());
}

bool JoinedVertices::are_joined(std::span<const Index> side_a, std::span<const Index> side_b) const {
  for (const Index vertex_a : side_a) {
    const Index a = points_[at(vertex_a)];
    if (a < 0) continue;
    for (const Index vertex_b : side_b) {
      const Index b = points_[at(vertex_b)];
      if (b < 0) continue;
      if (a == b || std::ranges::binary_search(joints_, std::array{std::min(a, b), std::max(a, b)})) return true;
    }
  }
  return false;
}

}  // namespace pliant
