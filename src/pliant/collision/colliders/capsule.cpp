#include "pliant/collision/colliders/capsule.h"

#include <algorithm>

#include "pliant/collision/colliders/surface.h"

namespace pliant {
namespace {

/// In its frame the axis lies along z, with the origin in the middle.
class CapsuleShape final : public ColliderShape {
 public:
  CapsuleShape(Real half_length, Real radius) : half_length_(half_length), radius_(radius) {}

  std::string_view type() const override { return CapsuleCollider::info.name; }
  SignedDistance distance(const Vec3& point) const override {
    Vec3 from_axis = point;
    from_axis.z() -= std::clamp(point.z(), -half_length_, half_length_);
    const Real length = from_axis.norm();
    return {length - radius_, length > 0 ? Vec3(from_axis / length) : Vec3(Vec3::UnitX())};
  }
  Mesh surface(Real) const override { return rounded_box({0, 0, half_length_}, radius_); }

 private:
  Real half_length_;
  Real radius_;
};

}  // namespace

PlacedShape build(const CapsuleCollider& options) {
  check_options(CapsuleCollider::info.name, options);
  const Vec3 axis = options.to - options.from;
  const Real length = axis.stableNorm();
  Pose pose{options.from + axis / 2};
  if (length > 0) {
    pose.rotation = Eigen::Quaternion<Real>::FromTwoVectors(Vec3(Vec3::UnitZ()), Vec3(axis / length));
  }
  return {std::make_shared<CapsuleShape>(length / 2, options.radius), pose};
}

}  // namespace pliant
