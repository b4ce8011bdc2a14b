#pragma once
// Boxes in which vertices stay on their ways.
#include <algorithm>
#include <cmath>

#include "pliant/core/types.h"

namespace pliant {

struct WayBoxes {
  Positions low, high;  ///< corners of the box of each vertex [m]

  /// How much of a way from `begin`, which lies in the box, stays there: from 0 to 1.
  Real share_within(const Positions& begin, Index vertex, const Vec3& way) const {
    Real share = 1;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Real room =
          way[axis] > 0 ? high(vertex, axis) - begin(vertex, axis) : begin(vertex, axis) - low(vertex, axis);
      const Real length = std::abs(way[axis]);
      if (length > room) share = std::min(share, std::max<Real>(0, room) / length);
    }
    return share;
  }
};

}  // namespace pliant
