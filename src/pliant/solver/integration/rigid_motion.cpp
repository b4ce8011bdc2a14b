#include "pliant/solver/integration/rigid_motion.h"

#include <limits>

#include <Eigen/Eigenvalues>

namespace pliant {

Vec3 angular_velocity(const Mat3& inertia, const Vec3& angular_momentum) {
  constexpr Real least_inertia = 1e-12;  // relative
  if (!inertia.allFinite() || !angular_momentum.allFinite()) {
    return Vec3::Constant(std::numeric_limits<Real>::quiet_NaN());
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(inertia);
  const Real most = axes.eigenvalues()[2];
  Vec3 velocity = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Real moment = axes.eigenvalues()[i];
    if (!(moment > least_inertia * most)) continue;
    const Vec3 axis = axes.eigenvectors().col(i);
    velocity += axis.dot(angular_momentum) / moment * axis;
  }
  return velocity;
}

RigidMotion fit_rigid_motion(std::span<const Index> component, const Positions& positions, std::span<const Real> masses,
                             const Positions& velocities) {
  RigidMotion motion;
  Vec3 momentum = Vec3::Zero();
  // Relative to the first vertex: far from the origin the digits of the shape would be lost.
  const Vec3 origin = row(positions, component.front());
  for (const Index v : component) {
    const Real mass = masses[static_cast<std::size_t>(v)];
    motion.mass += mass;
    motion.center += mass * (row(positions, v) - origin);
    momentum += mass * row(velocities, v);
  }
  motion.center = motion.center / motion.mass + origin;
  motion.velocity = momentum / motion.mass;
  for (const Index v : component) {
    const Real mass = masses[static_cast<std::size_t>(v)];
    const Vec3 r = row(positions, v) - motion.center;
    motion.inertia += mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    motion.angular_momentum += mass * r.cross(row(velocities, v) - motion.velocity);
  }
  motion.turning = angular_velocity(motion.inertia, motion.angular_momentum);
  return motion;
}

}  // namespace pliant
