#pragma once
// The energies of a contact of stiffness k, each with its derivative and a curvature that bounds its own from above.
#include "pliant/core/types.h"

namespace pliant {

struct Potential {
  Real energy = 0;     ///< [J]
  Real force = 0;      ///< [N], along what it pushes
  Real curvature = 0;  ///< [N/m]
};

/// k/2 (r − d)² of a vertex at the distance d < r from a surface, negative inside; 0 beyond. The force pushes outwards.
inline Potential normal_potential(Real stiffness, Real radius, Real distance) {
  const Real depth = radius - distance;
  if (!(depth > 0)) return {};
  return {stiffness / 2 * depth * depth, stiffness * depth, stiffness};
}

/// Huber's function of a slide [m]: k/2 u² while k u ≤ μλ, which is `limit`; then μλ u − (μλ)²/2k. The force pulls
/// back.
inline Potential friction_potential(Real stiffness, Real limit, Real slide) {
  const Real force = stiffness * slide;
  if (force <= limit) return {force * slide / 2, force, stiffness};
  return {limit * slide - limit * limit / (2 * stiffness), limit, limit / slide};
}

}  // namespace pliant
