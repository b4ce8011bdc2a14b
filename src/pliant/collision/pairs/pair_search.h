#pragma once
// Which features of surfaces may come near each other on the way of a step.
#include <span>
#include <vector>

#include "pliant/collision/pairs/meeting_items.h"
#include "pliant/collision/pairs/pair.h"
#include "pliant/core/thread_pool.h"

namespace pliant {

/// Finds pairs of features that share no vertex and whose boxes meet: vertices and triangles, edges and edges, vertices
/// and loose edges. A feature's box is that of its vertices' ways, each with its pad, in single precision and rounded
/// outward: a pair is missed only if its features, anywhere on their straight ways, are farther apart along some axis
/// than the pads of a vertex of the one and of one of the other together.
///
/// Left out are pairs of one body with meets_itself false, of groups that ignore each other, those of which no vertex
/// moves freely, and those that are sewn together.
class PairSearch {
 public:
  /// 28 bytes each, and as much again for finding them and putting them in order.
  static constexpr std::int64_t default_most = 20'000'000;

  /// The surface has to outlive the search, and to keep what is in it. most: how many pairs are found before find()
  /// gives up, from 1 to 2e9.
  explicit PairSearch(const Surface& surface, std::int64_t most = default_most);

  /// Which vertices do not move freely, not 0 for those that do not, in the solver's order; empty: all move.
  void set_held(std::span<const char> is_held);

  /// begin, end: positions at both ends of the ways, m × 3, finite [m]. pads: of each vertex, ≥ 0 [m]. All in the
  /// solver's order. far, sheets: leave out most of these and of those, and nothing else; sheets must stay the same.
  /// Returns the pairs in their order, which hold
  /// until the next call. The same for any number of threads. Allocates nothing once there is memory for as many pairs.
  ///
  /// Throws Error(input) where there are more than `most`, naming the vertex where most of them are.
  std::span<const Pair> find(const Positions& begin, const Positions& end, std::span<const Real> pads, ThreadPool& pool,
                             const FarPairs* far = nullptr, const FlatSheets* sheets = nullptr);
  /// The same, but false where there are too many.
  bool try_find(const Positions& begin, const Positions& end, std::span<const Real> pads, ThreadPool& pool,
                const FarPairs* far = nullptr, const FlatSheets* sheets = nullptr);
  std::span<const Pair> pairs() const { return pairs_; }

  /// How often trees were put in order, for benchmarks.
  std::int64_t build_count() const;

 private:
  struct Items {
    collision::BoxTree tree;
    std::vector<Index> body;  // of each
    collision::TreeOwners owners;
    std::vector<char> is_held;
    std::int64_t owned_build = -1;  // the build that `owners` was made for
    collision::TreePlaces places{};
    std::int64_t placed_build = -1;  // the same of `places`
  };
  enum : std::size_t { triangles_place, edges_place, vertices_place, loose_edges_place, places };
  struct Kind {
    PairKind kind;
    std::size_t a, b;  // places of trees
  };
  static constexpr Kind kinds[] = {{PairKind::vertex_triangle, vertices_place, triangles_place},
                                   {PairKind::edge_edge, edges_place, edges_place},
                                   {PairKind::vertex_edge, vertices_place, loose_edges_place}};

  void set_boxes(const Positions& begin, const Positions& end, std::span<const Real> pads, ThreadPool& pool);
  void update_owners(Items& items);
  void update_places(Items& items, const FlatSheets& sheets);
  collision::OwnedTree owned(std::size_t place, const FlatSheets* sheets) const;
  Pair pair_of(PairKind kind, Index first, Index second) const;
  [[noreturn]] void fail(const Positions& end) const;

  const Surface* surface_;
  std::int64_t most_;
  std::vector<Items> items_;
  std::vector<collision::FloatBox> boxes_;  // of Surface::vertices
  std::array<collision::MeetingItems, 3> meeting_;
  std::vector<Pair> pairs_;
  std::size_t crowded_ = 0;  // of the kinds, the one of which there were too many
};

}  // namespace pliant
