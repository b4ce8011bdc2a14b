#pragma once
// The rigid motion nearest to how a connected component moves.
#include <span>

#include "pliant/core/thread_pool.h"
#include "pliant/core/types.h"

namespace pliant {

/// v_rigid = velocity + turning × (x − center), nearest to v in Σ m ‖·‖²: it has the component's momentum and angular
/// momentum.
struct RigidMotion {
  Real mass = 0;                         ///< [kg]
  Vec3 center = Vec3::Zero();            ///< of mass [m]
  Vec3 velocity = Vec3::Zero();          ///< of the center [m/s]
  Mat3 inertia = Mat3::Zero();           ///< about the center [kg m²]
  Vec3 angular_momentum = Vec3::Zero();  ///< about the center [kg m²/s]
  Vec3 turning = Vec3::Zero();           ///< [rad/s]; not finite so far away that squares overflow

  Vec3 velocity_at(const Vec3& position) const { return velocity + turning.cross(position - center); }
};

/// Of these vertices, at least one, with all masses > 0. A component on a line, or of one vertex, has no turning about
/// itself. threads: of the loops over the vertices; none: the caller's alone. Never allocates.
RigidMotion fit_rigid_motion(std::span<const Index> component, const Positions& positions, std::span<const Real> masses,
                             const Positions& velocities, ThreadPool* threads = nullptr);

/// ω of L = I ω, without a share in axes about which there is no inertia: those of a body on a line.
Vec3 angular_velocity(const Mat3& inertia, const Vec3& angular_momentum);

}  // namespace pliant
