#include "pliant/collision/contact/rigid_couplings.h"

#include <tuple>

namespace pliant {
namespace {

bool is_before(const RigidCoupling& a, const RigidCoupling& b) {
  return std::tie(a.first, a.second) < std::tie(b.first, b.second);
}

}  // namespace

void RigidCouplings::finish() {
  std::ranges::sort(all_, is_before);
  const auto is_same = [](const RigidCoupling& a, const RigidCoupling& b) { return a.is_of_same(b); };
  all_.erase(std::unique(all_.begin(), all_.end(), is_same), all_.end());
  last_ = 0;
}

/// Pairs of the same components follow each other.
RigidCoupling& RigidCouplings::find(std::size_t first, std::size_t second) {
  const RigidCoupling wanted{.first = first, .second = second};
  if (!all_[last_].is_of_same(wanted)) {
    last_ = static_cast<std::size_t>(std::ranges::lower_bound(all_, wanted, is_before) - all_.begin());
  }
  return all_[last_];
}

/// With A b = a × b: −K, K B, −A K and A K B.
void RigidCouplings::add_stiffness(std::size_t component_a, std::size_t component_b, const Vec3& a, const Vec3& b,
                                   const Mat3& stiffness) {
  const bool is_in_order = component_a < component_b;
  const Vec3& arm = is_in_order ? a : b;
  const Vec3& other_arm = is_in_order ? b : a;
  RigidCoupling& sum = find(std::min(component_a, component_b), std::max(component_a, component_b));
  Mat3 turning;  // A K
  Mat3 turned;   // K B, the transpose of −B K
  for (int i = 0; i < 3; ++i) {
    turning.col(i) = arm.cross(stiffness.col(i));
    turned.row(i) = -other_arm.cross(stiffness.col(i)).transpose();
  }
  sum.curvature.topLeftCorner<3, 3>() -= stiffness;
  sum.curvature.bottomLeftCorner<3, 3>() -= turning;
  sum.curvature.topRightCorner<3, 3>() += turned;
  // (A K) B has the rows −b × (A K)ᵢ.
  for (int i = 0; i < 3; ++i) {
    sum.curvature.bottomRightCorner<3, 3>().row(i) -= other_arm.cross(turning.row(i).transpose()).transpose();
  }
}

}  // namespace pliant
