#pragma once
// The energy of a pair of surface features at the distance d > 0, in two stages (and a third one for safety):
//
//     r/2 ≤ d < r       E = k/2 (r − d)²                                 as of colliders
//     r/1000 ≤ d < r/2  E = k r²/8 − k r²/4 ln(2d/r)                     ever stiffer: what is pressed stays apart
//     d < r/1000        the parabola with the value, slope and curvature that the logarithm has at r/1000
//
// Value, slope and curvature are continuous at r/2 and r/1000, value and slope at r. Energy and force are finite down
// to d = 0, where the force is 500 times that of a contact compressed by r: of the order of 1/d no step could be
// computed. Distances as small as that occur where bodies were placed so or a load is far beyond the stiffness.
//
// Source of the two stages: A. Chen et al., Offset Geometric Contact, ACM Transactions on Graphics 44 (2025).
#include <cmath>

#include "pliant/collision/contact/potential.h"

namespace pliant {

/// stiffness: k [N/m] > 0. radius: r [m], how far apart the surfaces rest. distance: d [m] ≥ 0. Zero for d ≥ r. The
/// force is that along the normal of the gap, on the first side.
inline Potential pair_potential(Real stiffness, Real radius, Real distance) {
  if (!(distance < radius / 2)) return normal_potential(stiffness, radius, distance);
  const Real least = 1e-3 * radius;
  const Real to = distance > least ? distance : least;
  const Real force = stiffness * radius / 4 * (radius / to);
  const Real curvature = force / to;
  const Real energy = stiffness * radius * radius / 4 * (0.5 - std::log(2 * (to / radius)));
  const Real below = to - distance;
  return {energy + below * (force + below * curvature / 2), force + below * curvature, curvature};
}

}  // namespace pliant
