#include "pliant/solver/rigid_moments.h"

namespace pliant {
namespace {

/// Σ u × v of M = Σ u vᵀ.
Vec3 cross_sum(const Mat3& m) {
  return {m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0)};
}

Mat3 turn_by(const Vec3& angle) {
  const Real size = angle.stableNorm();
  return size > 0 ? Eigen::AngleAxis<Real>(size, angle / size).toRotationMatrix() : Mat3::Identity();
}

}  // namespace

RigidPlacement RigidPlacement::moved(const Eigen::Matrix<Real, 6, 1>& motion) const {
  const Mat3 by = turn_by(motion.tail<3>());
  return {motion.head<3>() + by * shift, by * turn};
}

RigidPlacement RigidPlacement::share(Real share) const {
  if (share == 1) return *this;
  const Eigen::AngleAxis<Real> whole(turn);
  return {share * shift, turn_by(share * whole.angle() * whole.axis())};
}

RigidMoments::RigidMoments(const Vec3& center, std::span<const Index> vertices, std::span<const Real> weights,
                           const WorkingState& work) {
  // columns of four, of which the last number is 0: two registers
  using Four = Eigen::Matrix<Real, 4, 1>;
  using FourByThree = Eigen::Matrix<Real, 4, 3>;
  Vec3 torque = Vec3::Zero();
  Four residuals = Four::Zero(), arms = Four::Zero(), ways = Four::Zero();
  FourByThree second = FourByThree::Zero(), crossed = FourByThree::Zero();
  Real sum_of_weights = 0, energy = 0;
  for (const Index v : vertices) {
    const Real w = weights[at(v)];
    const Vec3 x = row(work.positions, v);
    const Vec3 arm = x - center;
    const Vec3 way = row(work.prediction, v) - x;
    const Vec3 residual = row(work.residual, v);
    const Four weighted = w * Four(arm.x(), arm.y(), arm.z(), 0);
    residuals += Four(residual.x(), residual.y(), residual.z(), 0);
    torque += arm.cross(residual);
    sum_of_weights += w;
    energy += w / 2 * way.squaredNorm();
    arms += weighted;
    ways += w * Four(way.x(), way.y(), way.z(), 0);
    second += weighted * arm.transpose();
    crossed += weighted * way.transpose();
  }
  residual_ << residuals.head<3>(), torque;
  elastic_ << (residuals - ways).head<3>(), torque - cross_sum(crossed.topRows<3>());
  weight_ = sum_of_weights;
  energy_ = energy;
  arms_ = arms.head<3>();
  ways_ = ways.head<3>();
  second_ = second.topRows<3>();
  crossed_ = crossed.topRows<3>();
}

/// With the ways d = t + (R − 1) a: Σ w (b − d) and Σ w (a + d) × (b − d), and elastic forces turned.
RigidMoments::Force RigidMoments::force(const RigidPlacement& placement) const {
  const Vec3& t = placement.shift;
  const Mat3& turn = placement.turn;
  const Mat3 change = turn - Mat3::Identity();
  const Vec3 elastic = turn * elastic_.head<3>();
  Force sum;
  sum.head<3>() = ways_ - weight_ * t - change * arms_ + elastic;
  sum.tail<3>() = t.cross(ways_) + cross_sum(turn * crossed_) - arms_.cross(t) -
                  cross_sum(second_ * change.transpose()) + t.cross(elastic) + turn * elastic_.tail<3>();
  return sum;
}

/// Σ w/2 (|b − d|² − |b|²)
Real RigidMoments::rise(const RigidPlacement& placement) const {
  const Vec3& t = placement.shift;
  const Mat3 change = placement.turn - Mat3::Identity();
  const Real along = t.dot(ways_) + (change * crossed_).trace();
  const Real squared =
      weight_ * t.squaredNorm() + 2 * t.dot(change * arms_) + (change * second_ * change.transpose()).trace();
  return squared / 2 - along;
}

}  // namespace pliant
