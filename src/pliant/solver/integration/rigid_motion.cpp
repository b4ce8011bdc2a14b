#include "pliant/solver/integration/rigid_motion.h"

#include <limits>

#include <Eigen/Eigenvalues>

#include "pliant/solver/component_loops.h"

namespace pliant {
namespace {

struct Moments {
  Real mass = 0;
  Vec3 position = Vec3::Zero();
  Vec3 momentum = Vec3::Zero();
  Moments& operator+=(const Moments& other) {
    mass += other.mass;
    position += other.position;
    momentum += other.momentum;
    return *this;
  }
};

struct TurningMoments {
  Mat3 inertia = Mat3::Zero();
  Vec3 angular_momentum = Vec3::Zero();
  TurningMoments& operator+=(const TurningMoments& other) {
    inertia += other.inertia;
    angular_momentum += other.angular_momentum;
    return *this;
  }
};

}  // namespace

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
                             const Positions& velocities, ThreadPool* threads) {
  // Relative to the first vertex: far from the origin the digits of the shape would be lost.
  const Vec3 origin = row(positions, component.front());
  const auto moments = sum_over<Moments>(component, threads, [&](Moments& sum, Index v) {
    const Real mass = masses[at(v)];
    sum.mass += mass;
    sum.position += mass * (row(positions, v) - origin);
    sum.momentum += mass * row(velocities, v);
  });
  RigidMotion motion;
  motion.mass = moments.mass;
  motion.center = moments.position / moments.mass + origin;
  motion.velocity = moments.momentum / moments.mass;
  const auto turning = sum_over<TurningMoments>(component, threads, [&](TurningMoments& sum, Index v) {
    const Real mass = masses[at(v)];
    const Vec3 r = row(positions, v) - motion.center;
    sum.inertia += mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    sum.angular_momentum += mass * r.cross(row(velocities, v) - motion.velocity);
  });
  motion.inertia = turning.inertia;
  motion.angular_momentum = turning.angular_momentum;
  motion.turning = angular_velocity(motion.inertia, motion.angular_momentum);
  return motion;
}

}  // namespace pliant
