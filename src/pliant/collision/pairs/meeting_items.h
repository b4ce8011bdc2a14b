#pragma once
// Which items of two trees meet, or of one tree with itself: both are gone down at once, a group against a group.
#include <span>

#include "pliant/collision/pairs/box_tree.h"
#include "pliant/collision/pairs/far_pairs.h"
#include "pliant/collision/pairs/flat_sheets.h"
#include "pliant/collision/pairs/surface.h"

namespace pliant::collision {

/// Which parts of a surface the boxes of a tree belong to, so that boxes of which no pair is wanted are passed over.
class TreeOwners {
 public:
  /// body and is_held: of each item.
  void set(const BoxTree& tree, std::span<const Index> body, std::span<const char> is_held);
  /// Whether pairs of a box of the one tree and one of the other may be wanted, both of one level.
  static bool may_meet(const Surface& surface, const TreeOwners& a, Index box_a, const TreeOwners& b, Index box_b,
                       Index level);

 private:
  static constexpr Index several = -1;
  /// By level: twice the body, plus one where all vertices are held; `several` where that differs.
  std::vector<std::vector<Index>> owners_;
};

/// Where the boxes of a tree lie in flat sheets, so that boxes of which no pair can be near are passed over.
class TreePlaces {
 public:
  /// Corners of the tree are places in Surface::vertices.
  void set(const Surface& surface, const BoxTree& tree, const FlatSheets& sheets);
  /// Whether all pairs of a box of the one tree and one of the other are known to be far apart, both of one level from
  /// 1 on.
  static bool are_apart(const FlatSheets& sheets, const TreePlaces& a, Index box_a, const TreePlaces& b, Index box_b,
                        Index level) {
    return sheets.are_apart(a.boxes_[at(level)][at(box_a)], b.boxes_[at(level)][at(box_b)]);
  }

 private:
  std::vector<std::vector<FlatSheets::Box>> boxes_;  // by level
};

/// A tree of vertices, edges or triangles, and who owns them; `owners` is null where all pairs are wanted, `places`
/// where nothing is known of flat sheets.
struct OwnedTree {
  const BoxTree* tree = nullptr;
  const TreeOwners* owners = nullptr;
  const TreePlaces* places = nullptr;
  const FlatSheets* sheets = nullptr;
};

class MeetingItems {
 public:
  /// Finds the pairs of items that meet, share no corner and are wanted, each once: of edges with edges, or of vertices
  /// with edges or triangles, in trees of one height or one tree with itself. Returns false, and has not all of them,
  /// if there are more than `most`.
  bool find(const Surface& surface, const OwnedTree& a, const OwnedTree& b, std::int64_t most, ThreadPool& pool);
  /// After find() has returned false: the item of `a` that is in most pairs among the first, which are no more than
  /// `most` and one group's.
  static Index crowded_item(const Surface& surface, const OwnedTree& a, const OwnedTree& b, std::int64_t most);

  /// Leaves out pairs that are far apart.
  void drop_far(PairKind kind, const FarPairs& far, ThreadPool& pool);
  /// Leaves out pairs that are sewn together.
  void drop_joined(PairKind kind, const Surface& surface, ThreadPool& pool);
  /// Puts the pairs in order: first those of item 0 of a, in the order of the items of b, then those of item 1 and so
  /// on. Of one tree the smaller item is the first.
  void sort(Index first_count, ThreadPool& pool);
  std::int64_t count() const;
  /// After sort(): item i of a is in pairs [begin(i), begin(i + 1)), with the items second(k).
  Index begin(Index i) const { return begin_[at(i)]; }
  Index second(Index k) const { return seconds_[at(k)]; }

 private:
  using Hit = FarPairs::Items;
  struct Nodes {
    Index a, b;
  };
  /// What a thread finds at once; where tasks begin and end is left to the trees alone.
  struct alignas(64) Task {
    std::vector<Hit> hits;  // the first `count` of these
    std::size_t count = 0;
  };
  std::vector<Nodes> nodes_, next_nodes_;
  std::vector<Task> tasks_;
  std::vector<Index> begin_, seconds_;
  std::vector<Index> places_;  // of each part of the tasks, and in it of each item: where its next pair goes
};

}  // namespace pliant::collision
