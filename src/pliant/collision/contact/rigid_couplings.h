#pragma once
// What contact between two components resists with when both move as rigid bodies.
#include <algorithm>
#include <span>
#include <vector>

#include "pliant/collision/contact/rigid_resistance.h"

namespace pliant {

/// m₁ᵀ C m₂ of the motions of two components [J].
struct RigidCoupling {
  std::size_t first = 0, second = 0;  ///< components, the first the smaller one
  Eigen::Matrix<Real, 6, 6> curvature = Eigen::Matrix<Real, 6, 6>::Zero();

  bool is_of_same(const RigidCoupling& other) const { return first == other.first && second == other.second; }
};

/// Those of all components that push each other, in order.
class RigidCouplings {
 public:
  void clear() { all_.clear(); }
  /// There is one between two components; finish() once all are known.
  void add(std::size_t a, std::size_t b) {
    const RigidCoupling coupling{.first = std::min(a, b), .second = std::max(a, b)};
    if (all_.empty() || !all_.back().is_of_same(coupling)) all_.push_back(coupling);
  }
  void finish();
  void set_zero() {
    for (RigidCoupling& each : all_) each.curvature.setZero();
  }
  /// Of a spring between the arms a and b of two components, K symmetric [N/m]: −J_aᵀ K J_b, J_a m = t + ω × a.
  void add_stiffness(std::size_t component_a, std::size_t component_b, const Vec3& a, const Vec3& b,
                     const Mat3& stiffness);
  std::span<const RigidCoupling> all() const { return all_; }

 private:
  RigidCoupling& find(std::size_t first, std::size_t second);

  std::vector<RigidCoupling> all_;
  std::size_t last_ = 0;  // that was found
};

}  // namespace pliant
