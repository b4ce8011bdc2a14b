#include "pliant/collision/colliders/collider.h"

#include "pliant/mesh/mesh.h"

namespace pliant {

Mesh ColliderShape::surface(Real) const {
  return {};
}

Pose interpolate(const Pose& from, const Pose& to, Real share) {
  if (share == 1) return to;
  return {from.position + share * (to.position - from.position), from.rotation.slerp(share, to.rotation)};
}

Pose moved_on(const Pose& pose, const Vec3& velocity, const Vec3& angular_velocity, Real time) {
  Pose moved{pose.position + time * velocity, pose.rotation};
  const Real speed = angular_velocity.stableNorm();
  if (!(speed > 0)) return moved;
  const Eigen::AngleAxis<Real> turn(time * speed, angular_velocity / speed);
  moved.rotation = (Eigen::Quaternion<Real>(turn) * pose.rotation).normalized();
  return moved;
}

}  // namespace pliant
