#include "viewer/collider_entry.h"

#include <numbers>

#include "pliant/collision/colliders/builtin.h"

namespace pliant_viewer {
namespace {

using pliant::Real;
using pliant::Vec3;

constexpr Real same_rotation = 1e-9;  // [rad]

Vec3 read_vector(const Json& entry, const char* key, const Vec3& otherwise) {
  if (!entry.contains(key)) return otherwise;
  const Json& numbers = entry.at(key);
  return {numbers.at(0).get<Real>(), numbers.at(1).get<Real>(), numbers.at(2).get<Real>()};
}

/// Whether a rotation takes z to a direction of any length but zero.
bool points_along(const pliant::Pose& pose, const Vec3& direction) {
  return (pose.rotation * Vec3::UnitZ() - direction.stableNormalized()).norm() < same_rotation;
}

Json capsule_keys(const Json& entry, const pliant::Pose& pose) {
  const pliant::CapsuleCollider usual;
  const Vec3 from = read_vector(entry, "from", usual.from), to = read_vector(entry, "to", usual.to);
  const Real length = (to - from).stableNorm();
  if (!(length > 0) || points_along(pose, to - from)) {
    const Vec3 way = pose.position - (from + (to - from) / 2);
    return {{"from", json_of(with_digits(Vec3(from + way), 12))}, {"to", json_of(with_digits(Vec3(to + way), 12))}};
  }
  const Vec3 half = length / 2 * (pose.rotation * Vec3::UnitZ());
  return {{"from", json_of(with_digits(Vec3(pose.position - half), 12))},
          {"to", json_of(with_digits(Vec3(pose.position + half), 12))}};
}

Json box_keys(const Json& entry, const pliant::Pose& pose) {
  constexpr Real degree = std::numbers::pi / 180;
  Json keys = {{"center", json_of(pose.position)}};
  const Vec3 rotation = read_vector(entry, "rotation", Vec3::Zero());
  const pliant::Pose begin = pliant::moved_on({}, Vec3::Zero(), Vec3(rotation * degree), 1);
  if (begin.rotation.angularDistance(pose.rotation) < same_rotation) return keys;
  const Eigen::AngleAxis<Real> turn(pose.rotation);
  keys["rotation"] = json_of(with_digits(Vec3(turn.angle() / degree * turn.axis()), 9));
  return keys;
}

}  // namespace

Json pose_keys(const Json& entry, const pliant::Pose& exact) {
  pliant::Pose pose = exact;
  pose.position = without_single_precision(pose.position);
  const std::string type = entry.value("type", "");
  if (type == pliant::CapsuleCollider::info.name) return capsule_keys(entry, pose);
  if (type == pliant::BoxCollider::info.name) return box_keys(entry, pose);
  if (type != pliant::PlaneCollider::info.name) return {{"center", json_of(pose.position)}};
  Json keys = {{"position", json_of(pose.position)}};
  const Vec3 normal = read_vector(entry, "normal", pliant::PlaneCollider{}.normal);
  if (!points_along(pose, normal)) keys["normal"] = json_of(with_digits(Vec3(pose.rotation * Vec3::UnitZ()), 12));
  return keys;
}

}  // namespace pliant_viewer
