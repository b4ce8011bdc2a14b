#pragma once
// Which vertex is nearest to a place, and which are in a box.
#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Finds vertices by a tree of boxes around them, each cut in halves across its longest side. Keeps a copy of the
/// places, in the order of the tree.
class NearestVertex {
 public:
  using Box = Eigen::AlignedBox<Real, 3>;

  explicit NearestVertex(const Positions& x) : order_(static_cast<std::size_t>(x.rows())) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) build(x, 0, order_.size());
    for (const Index vertex : order_) points_.push_back(row(x, vertex));
  }

  struct Found {
    Index vertex = -1;           ///< −1: there is none
    Real squared = 0;            ///< distance [m²]
    std::int64_t looked_at = 0;  ///< vertices on the way
  };

  /// Of several at the same distance the first; of the vertices below `end`.
  Index operator()(const Vec3& place, Index end = std::numeric_limits<Index>::max()) const {
    return std::max(find(place, end, std::numeric_limits<Real>::infinity(), {}).vertex, 0);
  }

  /// The same among the vertices below `end` of which `left_out`, if not empty, has a 0, up to a distance [m].
  Found find(const Vec3& place, Index end, Real distance, std::span<const char> left_out) const {
    Query query{place, end, left_out, {-1, distance * distance, 0}};
    if (!nodes_.empty()) search(query, 0);
    return query.best;
  }

  /// The vertices between two corners, which count, ascending.
  std::vector<Index> inside(const Vec3& min, const Vec3& max) const {
    std::vector<Index> found;
    if (!nodes_.empty()) collect(0, min, max, found);
    std::ranges::sort(found);
    return found;
  }

  /// Around all vertices.
  Box bounds() const { return nodes_.empty() ? Box() : nodes_[0].bounds; }

 private:
  static constexpr std::size_t largest_leaf = 8;

  struct Node {
    Box bounds{};
    std::size_t begin;  // of its vertices in order_ and points_
    std::size_t end;
    Index first_vertex;      // the lowest of them
    std::size_t second = 0;  // its halves are the node that follows and this one; 0: a leaf
  };
  struct Query {
    const Vec3& place;
    Index end;
    std::span<const char> left_out;
    Found best;
  };

  void build(const Positions& x, std::size_t begin, std::size_t end) {
    const std::size_t here = nodes_.size();
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    nodes_.push_back({.begin = begin, .end = end, .first_vertex = *std::min_element(at(begin), at(end))});
    for (std::size_t i = begin; i < end; ++i) nodes_[here].bounds.extend(row(x, order_[i]));
    if (end - begin <= largest_leaf) return;
    Index axis = 0;
    nodes_[here].bounds.sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    std::ranges::nth_element(at(begin), at(middle), at(end), {}, [&](Index i) { return x(i, axis); });
    build(x, begin, middle);
    nodes_[here].second = nodes_.size();
    build(x, middle, end);
  }

  void search(Query& query, std::size_t node) const {
    const Node& here = nodes_[node];
    Found& best = query.best;
    const Real squared_to_box = here.bounds.squaredExteriorDistance(query.place);
    if (squared_to_box > best.squared || here.first_vertex >= query.end) return;
    // So that many ties end soon.
    if (squared_to_box == best.squared && best.vertex >= 0 && here.first_vertex > best.vertex) return;
    if (here.second > 0) {
      const bool first_is_nearer = nodes_[node + 1].bounds.squaredExteriorDistance(query.place) <=
                                   nodes_[here.second].bounds.squaredExteriorDistance(query.place);
      search(query, first_is_nearer ? node + 1 : here.second);
      search(query, first_is_nearer ? here.second : node + 1);
      return;
    }
    for (std::size_t i = here.begin; i < here.end; ++i) {
      const Index vertex = order_[i];
      ++best.looked_at;
      if (vertex >= query.end) continue;
      if (!query.left_out.empty() && query.left_out[static_cast<std::size_t>(vertex)] != 0) continue;
      const Real squared = (points_[i] - query.place).squaredNorm();
      const bool is_first = best.vertex < 0 || vertex < best.vertex;
      if (squared < best.squared || (squared == best.squared && is_first)) {
        best.vertex = vertex;
        best.squared = squared;
      }
    }
  }

  void collect(std::size_t node, const Vec3& min, const Vec3& max, std::vector<Index>& found) const {
    const Node& here = nodes_[node];
    if ((here.bounds.max().array() < min.array()).any() || (here.bounds.min().array() > max.array()).any()) return;
    if (here.second > 0) {
      collect(node + 1, min, max, found);
      collect(here.second, min, max, found);
      return;
    }
    for (std::size_t i = here.begin; i < here.end; ++i) {
      const bool is_inside = (points_[i].array() >= min.array()).all() && (points_[i].array() <= max.array()).all();
      if (is_inside) found.push_back(order_[i]);
    }
  }

  std::vector<Index> order_;
  std::vector<Vec3> points_;
  std::vector<Node> nodes_;
};

}  // namespace pliant
