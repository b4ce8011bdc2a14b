#pragma once
// What contact resists the rigid motions of a component with.
#include "pliant/core/types.h"

namespace pliant {

/// Friction that slides resists along its way with nothing, where it is; in a parabola that lies above its energy
/// everywhere, as much as across.
enum class SlidingFriction { as_it_is, bounded };

/// Of a component against a rigid motion m: a translation and a rotation about the center.
struct RigidResistance {
  using Motion = Eigen::Matrix<Real, 6, 1>;

  Vec3 center = Vec3::Zero();  ///< [m]
  SlidingFriction sliding = SlidingFriction::as_it_is;
  Eigen::Matrix<Real, 6, 6> curvature = Eigen::Matrix<Real, 6, 6>::Zero();  ///< C of mᵀ C m / 2 [J]; its lower half
  Real energy = 0;                                                          ///< of contact [J]

  /// Of a spring of k [N/m] at x along a direction of length 1.
  void add_spring(const Vec3& x, const Vec3& along, Real k) {
    Motion motion;
    motion << along, (x - center).cross(along);
    curvature.selfadjointView<Eigen::Lower>().rankUpdate(motion, k);
  }
};

}  // namespace pliant
