#pragma once
// A tree of boxes around vertices, edges or triangles that move.
//
// It has eight branches at each node and is complete but for its end: the boxes of level 0 are those of the items,
// eight in a group; box k of level l + 1 is the hull of group k of level l. So a level is an array, needs no pointers,
// and the children of box k are group k of the level below. Two trees of one height are searched against each other, or
// one against itself, by going down both at once.
//
//     level 2   [ 0 . . . . . . . ]
//     level 1   [ 0 1 2 3 4 5 6 7 ][ 8 . . .
//     level 0   [ 8 items ][ 8 items ] ...
//
// Items are put in order by halving: along the axis on which their middles lie farthest apart, at a multiple of the
// items that fill a branch. From step to step boxes are refitted and items keep their places until the groups of a
// level have grown to twice their size. A tree of a sheet that was built when it was flat is the better one when it
// lies in folds, since its groups are pieces of the sheet.
#include <span>

#include "pliant/collision/pairs/eight_boxes.h"
#include "pliant/core/aligned.h"
#include "pliant/core/thread_pool.h"

namespace pliant::collision {

class BoxTree {
 public:
  /// corners: of each item its vertices, corner_count of them (1 to 3), one item after another.
  BoxTree(std::vector<Index> corners, Index corner_count);

  /// Takes the boxes of the vertices: of an item the hull of those of its corners. Returns false where it would pay to
  /// build the tree, which is so at first, and else depends on the boxes of this call and those since the last build.
  bool refit(std::span<const FloatBox> vertex_boxes, ThreadPool& pool);
  /// Puts the items in order; refit() has to follow.
  void build(std::span<const FloatBox> vertex_boxes);

  Index corner_count() const { return corner_count_; }
  Index item_count() const { return item_count_; }
  /// Of levels; a tree may be given more, with one group each, to be searched against a higher one.
  Index height() const { return count_of(levels_); }
  void raise(Index height);

  std::span<const EightBoxes> level(Index l) const { return levels_[at(l)]; }
  /// In the groups of level 0, the item in each place, −1 for none.
  std::span<const Index> items() const { return places_; }
  /// Of the same groups: eight first corners, eight second ones and so on; −1 for none.
  const Index* corners_of_group(Index group) const {
    return &placed_corners_[boxes_side_by_side * at(corner_count_) * at(group)];
  }
  /// Of the item in a place of level 0.
  std::span<const Index> corners_of(Index place) const {
    return std::span(corners_).subspan(at(corner_count_ * places_[at(place)]), at(corner_count_));
  }
  std::int64_t build_count() const { return build_count_; }

 private:
  struct Middle {
    std::array<float, 3> point;
    Index item;
  };
  FloatBox box_of(const Index* corners, std::size_t stride, std::span<const FloatBox> vertex_boxes) const;
  void split(std::span<Middle> middles);
  void place_items();
  /// Whether the groups of a level have become large: their sides, summed, without those of an item each in the mean,
  /// so that pads and ways do not count.
  bool has_spread();

  std::vector<Index> corners_;
  Index corner_count_ = 0;
  Index item_count_ = 0;
  std::vector<Middle> middles_;
  std::vector<Index> places_;
  AlignedVector<Index> placed_corners_;
  std::vector<AlignedVector<EightBoxes>> levels_;
  std::vector<double> least_spread_;  // by level, since the last build [m]
  std::int64_t build_count_ = 0;
};

}  // namespace pliant::collision
