#pragma once
// What contact is told of a substep.
#include <span>

#include "pliant/collision/colliders/collider.h"

namespace pliant {

/// A collider in a substep.
struct ContactCollider {
  Index number = 0;
  const ColliderShape* shape = nullptr;
  Vec3 surface_velocity = Vec3::Zero();  ///< in its frame [m/s]
  Real friction = 0;                     ///< μ
  bool has_own_friction = false;         ///< else a body's own goes before it
  Pose begin{}, end{};                   ///< of the substep

  bool is_still() const { return begin == end && surface_velocity.isZero(0); }
};

/// What contact is told of a substep. Must outlive it.
struct ContactStep {
  const Positions& begin;             ///< qₙ [m]
  std::span<const Real> masses;       ///< [kg]
  std::span<const Real> radii;        ///< r of each vertex [m], > 0
  std::span<const char> is_pinned;    ///< pinned vertices touch nothing
  std::span<const Index> vertices;    ///< of the simulation; empty: the same
  Real time_step = 0;                 ///< h of the substep [s]
  std::span<const Real> frictions{};  ///< μ of each vertex' body, below 0 for none of its own; empty: none has
  std::span<const char> is_inner{};   ///< by number in the simulation: it is no part of a surface, and touches nothing
};

}  // namespace pliant
