#pragma once
// Which vertex is nearest to a place.
#include <algorithm>
#include <limits>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Finds nearest vertices by a tree of boxes around their vertices, each cut in halves across its longest side.
class NearestVertex {
 public:
  explicit NearestVertex(const Positions& x) : x_(x) {
    for (Index i = 0; i < x.rows(); ++i) order_.push_back(i);
    build(0, order_.size());
  }

  /// Of several at the same distance the first.
  Index operator()(const Vec3& place) const {
    Best best;
    search(0, place, best);
    return best.vertex;
  }

 private:
  static constexpr std::size_t largest_leaf = 8;

  struct Best {
    Real squared = std::numeric_limits<Real>::infinity();
    Index vertex = 0;
  };
  struct Box {
    Eigen::AlignedBox<Real, 3> bounds{};
    std::size_t begin;  // of its vertices in order_
    std::size_t end;
    Index first_vertex;      // the lowest of them
    std::size_t second = 0;  // its halves are the box that follows and this one; 0: a leaf
  };

  void build(std::size_t begin, std::size_t end) {
    const std::size_t here = boxes_.size();
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    boxes_.push_back({.begin = begin, .end = end, .first_vertex = *std::min_element(at(begin), at(end))});
    for (std::size_t i = begin; i < end; ++i) boxes_[here].bounds.extend(row(x_, order_[i]));
    if (end - begin <= largest_leaf) return;
    Index axis = 0;
    boxes_[here].bounds.sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    std::ranges::nth_element(at(begin), at(middle), at(end), {}, [&](Index i) { return x_(i, axis); });
    build(begin, middle);
    boxes_[here].second = boxes_.size();
    build(middle, end);
  }

  void search(std::size_t box, const Vec3& place, Best& best) const {
    const Box& here = boxes_[box];
    const Real squared_to_box = here.bounds.squaredExteriorDistance(place);
    if (squared_to_box > best.squared) return;
    if (squared_to_box == best.squared && here.first_vertex > best.vertex) return;  // so that many ties end soon
    if (here.second > 0) {
      const bool first_is_nearer = boxes_[box + 1].bounds.squaredExteriorDistance(place) <=
                                   boxes_[here.second].bounds.squaredExteriorDistance(place);
      search(first_is_nearer ? box + 1 : here.second, place, best);
      search(first_is_nearer ? here.second : box + 1, place, best);
      return;
    }
    for (std::size_t i = here.begin; i < here.end; ++i) {
      const Index vertex = order_[i];
      const Real squared = (row(x_, vertex) - place).squaredNorm();
      if (squared < best.squared || (squared == best.squared && vertex < best.vertex)) best = {squared, vertex};
    }
  }

  const Positions& x_;
  std::vector<Index> order_;
  std::vector<Box> boxes_;
};

}  // namespace pliant
