#include "pliant/collision/pairs/pair_weights.h"

#include <algorithm>
#include <limits>

namespace pliant {
namespace {

/// Of r: by how much two edges must be nearer than their vertices' own pairs to push with all their stiffness, where
/// one of them lies in what is flat.
constexpr Real weight_width = 0.5;
/// The same where none does, or the depth if that is more: a vertex farther away than r carries nothing, so where edges
/// left it the load from much farther there would be a hole.
constexpr Real least_width = 0.01;
/// Of r: how far apart two places of a surface are that a vertex touches as if they were one.
constexpr Real one_place_width = 0.5;

Real smooth_step(Real t) {
  const Real s = std::clamp<Real>(t, 0, 1);
  return s * s * (3 - 2 * s);
}

bool is_of_edges(const Pair& pair) {
  return pair.kind == PairKind::edge_edge;
}

/// Where a vertex touches the other surface.
Vec3 place_of(const Positions& q, const Pair& pair, const Gap& gap) {
  Vec3 place = Vec3::Zero();
  for (std::size_t j = 1; j < 4; ++j) place -= gap.weights[j] * row(q, pair.vertices[j]);
  return place;
}

/// From 1 where the triangles at an edge lie across the normal, to 0 where one of them rises by 17° or more from there,
/// or the edge has none.
Real flatness(const Positions& q, const Surface& surface, Index edge, const Vec3& normal) {
  constexpr Real steepest_flat = 0.3;
  const auto& [a, b] = surface.edges[at(edge)];
  const Vec3 along = (row(q, b) - row(q, a)).normalized();
  const std::span<const Index> corners = surface.opposite(edge);
  Real steepest = corners.empty() ? 1 : 0;
  for (const Index corner : corners) {
    const Vec3 away = row(q, corner) - row(q, a);
    const Vec3 across = away - along.dot(away) * along;
    const Real length = across.norm();
    steepest = std::max(steepest, length > 0 ? std::abs(across.dot(normal)) / length : Real{1});
  }
  return smooth_step(1 - steepest / steepest_flat);
}

}  // namespace

/// Edges beyond r do nothing; distances of vertices matter to edges as far as their weights are wide.
void PairWeights::refresh(const PairList& list, const Surface& surface, const Positions& q, ThreadPool& threads) {
  const NearPairs near = list.near();
  own_gaps_.resize(near.size());
  for_each_chunk_of(near.size(), pairs_of_chunk, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Real reach = is_of_edges(near[i].pair) ? near[i].radius : (1 + weight_width) * near[i].radius;
      const Real bound = list.bound(near[i]);
      own_gaps_[i].distance = bound;
      own_gaps_[i].counts = false;
      if (!(bound < reach)) continue;
      own_gaps_[i] = measure(q, near[i].pair);
      weights_[i] = none;
    }
  });
  gaps_ = own_gaps_;
  weigh(near, surface, q, threads);
  remember(near);
}

void PairWeights::update(const PairList& list, const Surface& surface, const Positions& q, ThreadPool& threads) {
  const NearPairs near = list.near();
  gaps_ = list.gaps();
  weights_.assign(near.size(), none);
  auto old = weighed_.begin();
  bool has_new = false;
  for (std::size_t i = 0; i < near.size(); ++i) {
    while (old != weighed_.end() && old->pair < near[i].pair) ++old;
    if (old != weighed_.end() && old->pair == near[i].pair) {
      weights_[i] = old->weight;
    } else {
      has_new = true;
    }
  }
  if (has_new) weigh(near, surface, q, threads);
  remember(near);
}

void PairWeights::remember(NearPairs near) {
  weighed_.clear();
  for (std::size_t i = 0; i < near.size(); ++i) weighed_.push_back({near[i].pair, weights_[i]});
}

/// Those that have no weight yet.
void PairWeights::weigh(NearPairs near, const Surface& surface, const Positions& q, ThreadPool& threads) {
  is_counting_.resize(near.size());
  for_each_chunk_of(near.size(), pairs_of_chunk, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Gap& gap = gaps_[i];
      is_counting_[i] = gap.counts && is_nearest_there(q, surface, near[i].pair, gap) ? 1 : 0;
    }
  });
  vertex_gaps_.assign(at(static_cast<Index>(q.rows())), std::numeric_limits<Real>::infinity());
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (is_of_edges(near[i].pair)) continue;
    Real& least = vertex_gaps_[at(near[i].pair.vertices[0])];
    least = std::min(least, gaps_[i].distance);
  }
  for (std::size_t i = 0; i < near.size();) {
    if (is_of_edges(near[i].pair)) {
      weigh_edges(i, surface, near[i], q);
      ++i;
      continue;
    }
    const auto is_of_same = [&](const Pair& pair) {
      return pair.kind == near[i].pair.kind && pair.features[0] == near[i].pair.features[0];
    };
    std::size_t end = i + 1;
    while (end < near.size() && is_of_same(near[end].pair)) ++end;
    weigh_vertex(near, i, end, q);
    i = end;
  }
}

void PairWeights::weigh_edges(std::size_t i, const Surface& surface, const PairList::Near& near, const Positions& q) {
  if (weights_[i] >= 0) return;
  weights_[i] = 0;
  const Gap& gap = gaps_[i];
  Real least = std::numeric_limits<Real>::infinity();
  for (const Index v : near.pair.vertices) least = std::min(least, vertex_gaps_[at(v)]);
  if (is_counting_[i] == 0 || !(least > gap.distance)) return;
  const Real flat = std::max(flatness(q, surface, near.pair.features[0], gap.normal),
                             flatness(q, surface, near.pair.features[1], gap.normal));
  const Real depth = near.radius - gap.distance;
  const Real width = std::max(depth, std::max(least_width, flat * weight_width) * near.radius);
  weights_[i] = smooth_step((least - gap.distance) / width);
}

/// All pairs of one vertex. Where a valley becomes flat, the two sides of it become one place.
void PairWeights::weigh_vertex(NearPairs near, std::size_t begin, std::size_t end, const Positions& q) {
  for (std::size_t i = begin; i < end; ++i) {
    if (weights_[i] >= 0) continue;
    weights_[i] = 0;
    if (is_counting_[i] == 0) continue;
    const Vec3 place = place_of(q, near[i].pair, gaps_[i]);
    Real alike = 0;
    for (std::size_t j = begin; j < end; ++j) {
      if (is_counting_[j] == 0) continue;
      const Real apart = (place_of(q, near[j].pair, gaps_[j]) - place).norm();
      alike += smooth_step(1 - apart / (one_place_width * near[i].radius));
    }
    weights_[i] = 1 / alike;
  }
}

}  // namespace pliant
