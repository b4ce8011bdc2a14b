#pragma once
// The closest points of the two features of a pair.
//
// Each contact counts once, though a point of a surface lies on several features of it: what is closest to an edge or a
// corner counts with the triangle that owns it alone, and only where no triangle around it is nearer in its interior
// (is_nearest_there). Both questions are answered with the same products of the same numbers, whatever the order of a
// triangle's corners, and what lies over a ten-millionth of an edge or a triangle at its border counts as on the
// border: so rounding lets nothing count twice or not at all where a vertex lies exactly over an edge or over another
// vertex.
//
// Source of the conditions: A. Chen et al., Offset Geometric Contact, ACM Transactions on Graphics 44 (2025).
#include "pliant/collision/pairs/pair.h"

namespace pliant {

struct Gap {
  /// Of `place`: not on an edge or a corner of the second feature.
  static constexpr std::uint8_t interior = 6;

  Real distance = 0;            ///< [m]
  Vec3 normal = Vec3::UnitZ();  ///< from the second side to the first: the gradient of the distance is weights × normal
  std::array<Real, 4>
      weights{};        ///< of the vertices in the closest points: 1 in all on the first side, −1 on the second
  bool counts = false;  ///< as Pair::owned has it; of two edges: both points are in their interiors
  std::uint8_t place = interior;  ///< of the point on the second feature: its bit in Pair::owned, or interior
};

/// q: finite. Whatever the shape, all numbers are finite and the distance is right within rounding of the coordinates.
/// At a distance of 0 the normal is that of the triangle or of both edges; without one, some direction across the
/// longest edge. Of parallel edges an end is taken, so they do not count: its vertex does.
Gap measure(const Positions& q, const Pair& pair);

/// Whether a point that is closest on an edge or a corner is so among all that the surface has around there. gap: that
/// of the pair at q.
bool is_nearest_there(const Positions& q, const Surface& surface, const Pair& pair, const Gap& gap);

/// The same, and more: two edges count, and no triangle at one of them comes nearer to the other; no edge of a vertex
/// leads steeply, by 30° or more, towards what it is near. Then the distance between both surfaces has a minimum there,
/// or almost.
bool is_minimum_there(const Positions& q, const Surface& surface, const Pair& pair, const Gap& gap);

}  // namespace pliant
