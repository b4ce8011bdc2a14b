#pragma once
// What contact does to components that are moved as rigid bodies.
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
  Motion force = Motion::Zero();  ///< of contact, and its torque about the center [N, N m]
  Eigen::Matrix<Real, 6, 6> curvature = Eigen::Matrix<Real, 6, 6>::Zero();  ///< C of mᵀ C m / 2 [J]; its lower half
  Real energy = 0;                                                          ///< of contact [J]
  bool is_blocked = false;                                                  ///< a vertex is where no move may lead

  void add_force(const Vec3& x, const Vec3& f) {
    force.head<3>() += f;
    force.tail<3>() += (x - center).cross(f);
  }
  /// Of a spring at x, K symmetric [N/m]. With the arm a and A b = a × b: K, A K and A K Aᵀ.
  void add_stiffness(const Vec3& x, const Mat3& stiffness) {
    const Vec3 arm = x - center;
    Mat3 turning;
    for (int i = 0; i < 3; ++i) turning.col(i) = arm.cross(stiffness.col(i));
    for (int j = 0; j < 3; ++j) {
      for (int i = j; i < 3; ++i) curvature(i, j) += stiffness(i, j);
      for (int i = 0; i < 3; ++i) curvature(3 + i, j) += turning(i, j);
    }
    const auto turned = [&](int i, int from, int to) {
      return arm(from) * turning(i, to) - arm(to) * turning(i, from);
    };
    for (int i = 0; i < 3; ++i) curvature(3 + i, 3) += turned(i, 1, 2);
    for (int i = 1; i < 3; ++i) curvature(3 + i, 4) += turned(i, 2, 0);
    curvature(5, 5) += turned(2, 0, 1);
  }
};

}  // namespace pliant
