#pragma once
// What contact keeps from step to step: a part of State.
#include "pliant/collision/colliders/collider.h"
#include "pliant/collision/contact/let_go_state.h"
#include "pliant/collision/pairs/pair.h"

namespace pliant {

/// Where a collider is.
struct ColliderState {
  Index collider = 0;            ///< its number (ColliderId)
  Pose pose{};                   ///< at tₙ
  std::optional<Pose> target{};  ///< where the next step takes it; none: as its velocities do
};

/// A vertex that touches a collider.
struct ContactMemory {
  Index vertex = 0;
  Index collider = 0;          ///< its number (ColliderId)
  Vec3 anchor = Vec3::Zero();  ///< where friction holds it, in the frame of the collider [m]
  Real load = 0;               ///< λ, the normal force that friction goes by [N]
};

/// A pair of surfaces that touch.
struct PairMemory {
  PairKind kind = PairKind::vertex_triangle;
  std::array<Index, 2> features{};  ///< as in Pair
  Vec3 slide = Vec3::Zero();        ///< ξ, by which friction has stretched [m]
};

struct ContactState {
  std::vector<ColliderState> colliders;  ///< by number
  std::vector<ContactMemory> memory;     ///< by vertex, then collider
  std::vector<PairMemory> pairs;         ///< in the order of pairs
  LetGoState let_go;
  /// κ of each vertex, from 1: by how much its contacts are stiffer than 50 m/h²; empty: 1 for all.
  std::vector<Real> stiffening;
  /// What the factor has of contact at each vertex, D [N/m], and for how many steps it would have done without; empty:
  /// nothing.
  std::vector<Real> in_factor;
  Index light_steps = 0;
  /// What contact may give back to each component, at one vertex of it, m numbers [J] (ContactEnergy); below 0 it is
  /// owed. Empty: nothing.
  std::vector<Real> energies;

  /// Whether a simulation without contact would have the same.
  bool is_empty() const {
    return colliders.empty() && memory.empty() && pairs.empty() && let_go.is_empty() && stiffening.empty() &&
           in_factor.empty() && energies.empty();
  }
};

}  // namespace pliant
