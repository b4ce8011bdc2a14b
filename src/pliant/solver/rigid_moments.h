#pragma once
// What a component that is moved as a rigid body feels of its inertia and elasticity, from sums over its vertices that
// are made once.
#include <span>

#include "pliant/solver/working_state.h"

namespace pliant {

/// Turned about a center and shifted.
struct RigidPlacement {
  Vec3 shift = Vec3::Zero();  ///< [m]
  Mat3 turn = Mat3::Identity();

  Vec3 place(const Vec3& center, const Vec3& x) const { return center + shift + turn * (x - center); }
  /// After it, a small motion: a translation and a rotation about the same center.
  RigidPlacement moved(const Eigen::Matrix<Real, 6, 1>& motion) const;
  /// Such a share of it.
  RigidPlacement share(Real share) const;
};

/// Of vertices with inertia E = Σ w/2 |s − x|² and elastic forces that turn with the component.
class RigidMoments {
 public:
  using Force = Eigen::Matrix<Real, 6, 1>;

  RigidMoments() = default;
  /// Of vertices with the arms a = x − c, the ways b = s − x to their predictions and the residuals r of all forces.
  RigidMoments(const Vec3& center, std::span<const Index> vertices, std::span<const Real> weights,
               const WorkingState& work);
  /// Of the residuals, what contact has added.
  void subtract_contact(const Force& force) { elastic_ -= force; }

  /// Force and torque about the center of inertia and elasticity there [N, N m].
  Force force(const RigidPlacement& placement) const;
  /// By how much the energy of inertia is larger there [J].
  Real rise(const RigidPlacement& placement) const;
  /// Where the component is: Σ r and its torque, and the energy of inertia [J].
  const Force& residual() const { return residual_; }
  Real energy() const { return energy_; }

 private:
  Force residual_ = Force::Zero();
  Force elastic_ = Force::Zero();
  Real weight_ = 0;              // Σ w [N/m]
  Real energy_ = 0;              // Σ w/2 |b|² [J]
  Vec3 arms_ = Vec3::Zero();     // Σ w a [N]
  Vec3 ways_ = Vec3::Zero();     // Σ w b [N]
  Mat3 second_ = Mat3::Zero();   // Σ w a aᵀ [N m]
  Mat3 crossed_ = Mat3::Zero();  // Σ w a bᵀ [N m]
};

}  // namespace pliant
