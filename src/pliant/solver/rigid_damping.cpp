#include "pliant/solver/rigid_damping.h"

#include <Eigen/Eigenvalues>

namespace pliant {
namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// ω of L = I ω, without a share in axes about which there is no inertia: those of a body on a line.
Vec3 angular_velocity(const Mat3& inertia, const Vec3& angular_momentum) {
  constexpr Real least_inertia = 1e-12;  // relative
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

}  // namespace

void RigidDamping::set_parts(ConnectedParts parts, std::vector<char> is_held) {
  parts_ = std::move(parts);
  is_held_ = std::move(is_held);
}

void RigidDamping::apply(const Positions& positions, std::span<const Real> masses, Real factor,
                         Positions& velocities) const {
  for (std::size_t i = 0; i < parts_.count(); ++i) apply_to(parts_.part(i), positions, masses, factor, velocities);
}

void RigidDamping::apply_to(std::span<const Index> part, const Positions& positions, std::span<const Real> masses,
                            Real factor, Positions& velocities) const {
  Real mass = 0;
  Vec3 center = Vec3::Zero();
  Vec3 momentum = Vec3::Zero();
  // Relative to the first vertex: far from the origin the digits of the shape would be lost.
  const Vec3 origin = row(positions, part.front());
  for (const Index v : part) {
    mass += masses[at(v)];
    center += masses[at(v)] * (row(positions, v) - origin);
    momentum += masses[at(v)] * row(velocities, v);
  }
  center = center / mass + origin;
  const Vec3 mean = momentum / mass;
  Mat3 inertia = Mat3::Zero();
  Vec3 angular_momentum = Vec3::Zero();
  for (const Index v : part) {
    const Vec3 r = row(positions, v) - center;
    inertia += masses[at(v)] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    angular_momentum += masses[at(v)] * r.cross(row(velocities, v) - mean);
  }
  if (!inertia.allFinite() || !angular_momentum.allFinite()) return;  // so far away that squares overflow
  const Vec3 turning = angular_velocity(inertia, angular_momentum);
  for (const Index v : part) {
    if (is_held_[at(v)]) continue;
    const Vec3 rigid = mean + turning.cross(row(positions, v) - center);
    velocities.row(v) = (rigid + factor * (row(velocities, v) - rigid)).transpose();
  }
}

}  // namespace pliant
