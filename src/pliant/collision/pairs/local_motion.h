#pragma once
// How much nearer to each other features have come at most, region by region of the surfaces. A cloth may go far as a
// whole and in waves, while what is near to each other in it hardly moves against each other.
//
// A point of a feature and one of another move against each other by no more than the largest |w_i − w_j| of a corner i
// of the one and a corner j of the other, with the ways w of the corners. So it is enough to know, of each region, a
// box of the ways of the vertices of its features, and, of two regions, how far apart they were.
#include <array>
#include <span>
#include <vector>

#include "pliant/collision/pairs/eight_boxes.h"
#include "pliant/collision/pairs/surface.h"
#include "pliant/core/aligned.h"
#include "pliant/core/types.h"

namespace pliant {

class LocalMotion {
 public:
  /// Surfaces at rest (m × 3) [m], and r of each vertex [m]. The surface must stay.
  void set_surface(const Surface& surface, const Positions& rest, std::span<const Real> radii);
  /// Features have gone on from elsewhere.
  void forget() { is_begun_ = false; }

  /// Of all pairs of features that were 2 r apart at the reference, or more.
  struct Kept {
    bool is_radius = false;  ///< they are r apart
    bool is_some = false;    ///< a tenth of their distance is left; on a straight way too if it is at both ends
  };
  /// Where all vertices went straight to q, none farther than `farthest` from what all have gone [m]; false where it is
  /// not known.
  Kept kept(const Positions& reference, const Positions& q, Real farthest);

 private:
  struct Box {
    std::array<Real, 3> low, high;
    void add(const Real* point);
    collision::FloatBox larger_by(Real pad) const;
  };
  /// Regions between which something may be near.
  struct Neighbors {
    std::size_t a, b;
    Real radius;    // the least [m]
    Real distance;  // of their boxes [m]
  };

  void split(std::span<Index> vertices, const Positions& rest);
  void add_corners(const Surface& surface);
  void begin(const Positions& reference);
  void set_groups();
  void add_neighbors(std::size_t group_a, std::size_t group_b);
  template <class Visit>
  void for_each_region(Visit&& visit) const;
  static Real distance(const Box& a, const Box& b);
  /// Of two ways, at most.
  static Real squared_difference(const Box& a, const Box& b);

  std::vector<Index> region_of_vertex_;
  std::vector<std::size_t> begin_;  // of each region in `corners_`
  std::vector<Index> corners_;      // of its features
  std::vector<Real> radii_;         // the least of each region [m]
  Real largest_radius_ = 0;
  std::size_t region_count_ = 0;
  bool is_begun_ = false;
  bool are_too_many_ = false;                            // neighbors
  std::vector<Neighbors> neighbors_;                     // at the reference
  std::vector<Box> boxes_;                               // there, and of ways
  AlignedVector<collision::EightBoxes> groups_, hulls_;  // of regions, larger by half of what is looked at; of groups
};

}  // namespace pliant
