#include "pliant/collision/colliders/plane.h"

#include "pliant/mesh/mesh.h"

namespace pliant {
namespace {

/// In its frame the plane is z = 0.
class PlaneShape final : public ColliderShape {
 public:
  std::string_view type() const override { return PlaneCollider::info.name; }
  SignedDistance distance(const Vec3& point) const override { return {point.z(), Vec3::UnitZ()}; }
  bool is_bounded() const override { return false; }
  Mesh surface(Real size) const override {
    Mesh mesh;
    mesh.vertices.resize(4, 3);
    mesh.vertices << -size, -size, 0, size, -size, 0, size, size, 0, -size, size, 0;
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
  }
};

}  // namespace

PlacedShape build(const PlaneCollider& options) {
  check_options(PlaneCollider::info.name, options);
  const Real length = options.normal.stableNorm();
  if (!(length > 0)) fail_input("plane: normal: its length is zero; give a direction");
  const Eigen::Quaternion<Real> rotation =
      Eigen::Quaternion<Real>::FromTwoVectors(Vec3(Vec3::UnitZ()), Vec3(options.normal / length));
  return {std::make_shared<PlaneShape>(), {options.position, rotation}};
}

}  // namespace pliant
