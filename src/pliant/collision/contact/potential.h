#pragma once
// The energies of a contact of stiffness k, each with its derivative and a curvature that bounds its own from above.
#include <cmath>

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

struct Friction {
  Real energy = 0;            ///< [J]
  Vec3 force = Vec3::Zero();  ///< [N]
  Real curvature = 0;         ///< [N/m]

  /// Of the energy, what friction of stiffness k [N/m] > 0 gives back when the load is gone; the rest has slid away.
  Real stored_energy(Real stiffness) const { return force.squaredNorm() / (2 * stiffness); }
};

/// Huber's function of a slide u [m]: k/2 ‖u‖² while k ‖u‖ ≤ μλ, which is `limit` [N]; then μλ ‖u‖ − (μλ)²/2k.
inline Friction friction_potential(Real stiffness, Real limit, const Vec3& slide) {
  const Vec3 force = -stiffness * slide;
  const Real square = force.squaredNorm();
  if (square <= limit * limit) return {-force.dot(slide) / 2, force, stiffness};
  const Real length = std::sqrt(square) / stiffness;
  return {limit * length - limit * limit / (2 * stiffness), -limit / length * slide, limit / length};
}

}  // namespace pliant
