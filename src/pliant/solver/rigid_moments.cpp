#include "pliant/solver/rigid_moments.h"

#include <array>

#include "pliant/core/two_numbers.h"

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

/// Pairs of numbers side by side, in registers: x and y of a vector, and what goes with its z.
RigidMoments::RigidMoments(const Vec3& center, std::span<const Index> vertices, std::span<const Real> weights,
                           const WorkingState& work) {
  using Two = TwoNumbers;
  const auto twice = [](Real number) { return Two{number, number}; };
  const Two center_xy = two_numbers_at(center.data());
  Vec3 torque = Vec3::Zero();
  Two residuals{}, arms{}, ways{}, arms_and_ways_z{}, weight_and_energy{};
  Real residuals_z = 0;
  std::array<Two, 3> second{}, crossed{};                // x and y of each column
  Two second_z{}, crossed_z{}, second_and_crossed_zz{};  // z of the first two, and of the last ones
  for (const Index v : vertices) {
    const Real w = weights[at(v)];
    const Real* const x = work.positions.data() + 3 * v;
    const Real* const s = work.prediction.data() + 3 * v;
    const Real* const r = work.residual.data() + 3 * v;
    const Two arm = two_numbers_at(x) - center_xy, way = two_numbers_at(s) - two_numbers_at(x),
              residual = two_numbers_at(r);
    const Real arm_z = x[2] - center.z(), way_z = s[2] - x[2];
    residuals += residual;
    residuals_z += r[2];
    torque.x() += arm[1] * r[2] - arm_z * residual[1];
    torque.y() += arm_z * residual[0] - arm[0] * r[2];
    torque.z() += arm[0] * residual[1] - arm[1] * residual[0];
    weight_and_energy += Two{w, w / 2 * (way[0] * way[0] + (way[1] * way[1] + way_z * way_z))};
    const Two weighted = twice(w) * arm;
    const Real weighted_z = w * arm_z;
    arms += weighted;
    ways += twice(w) * way;
    arms_and_ways_z += Two{weighted_z, w * way_z};
    second[0] += weighted * twice(arm[0]), crossed[0] += weighted * twice(way[0]);
    second[1] += weighted * twice(arm[1]), crossed[1] += weighted * twice(way[1]);
    second[2] += weighted * twice(arm_z), crossed[2] += weighted * twice(way_z);
    second_z += twice(weighted_z) * arm;
    crossed_z += twice(weighted_z) * way;
    second_and_crossed_zz += twice(weighted_z) * Two{arm_z, way_z};
  }
  weight_ = weight_and_energy[0];
  energy_ = weight_and_energy[1];
  arms_ = {arms[0], arms[1], arms_and_ways_z[0]};
  ways_ = {ways[0], ways[1], arms_and_ways_z[1]};
  for (Index i = 0; i < 3; ++i) {
    second_.col(i) << second[at(i)][0], second[at(i)][1], i < 2 ? second_z[i] : second_and_crossed_zz[0];
    crossed_.col(i) << crossed[at(i)][0], crossed[at(i)][1], i < 2 ? crossed_z[i] : second_and_crossed_zz[1];
  }
  const Vec3 sum(residuals[0], residuals[1], residuals_z);
  residual_ << sum, torque;
  elastic_ << sum - ways_, torque - cross_sum(crossed_);
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
