#pragma once
// Where parallel lines pass through a closed surface: the winding number along them changes by one there.
//
// The winding number tells what is inside of surfaces that touch, overlap or pass through themselves. Coordinates
// across the lines are rounded to a fine grid between whose places the lines lie, so that on which side of an edge a
// line passes is decided exactly, and for both triangles of the edge alike: no line slips through.
#include <span>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

struct WindingCrossing {
  Real x = 0;
  Index change = 0;  ///< of the winding number, for one who goes on towards +x: 1 inward, −1 outward
};

/// Lines along x at y = origin.y + (i + ½)·step, 0 ≤ i < rows, and z = origin.z + (j + ½)·step, 0 ≤ j < columns.
class WindingLines {
 public:
  /// x: the vertices of a closed surface turned outward, within the lines.
  WindingLines(const Positions& x, std::span<const Triangle> triangles, const Vec3& origin, Real step, Index rows,
               Index columns);

  /// By rising x.
  std::span<const WindingCrossing> at(Index row, Index column) const {
    const std::size_t line =
        static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(row);
    return std::span(crossings_).subspan(begins_[line], begins_[line + 1] - begins_[line]);
  }

 private:
  template <class Visit>
  void visit_crossings(const Positions& x, std::span<const Triangle> triangles, const Visit& visit) const;

  Vec3 origin_;
  Real step_;
  Index rows_;
  Index columns_;
  std::vector<std::size_t> begins_;
  std::vector<WindingCrossing> crossings_;
};

}  // namespace pliant
