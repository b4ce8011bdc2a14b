#include "pliant/collision/colliders/sphere.h"

#include "pliant/collision/colliders/surface.h"

namespace pliant {
namespace {

class SphereShape final : public ColliderShape {
 public:
  explicit SphereShape(Real radius) : radius_(radius) {}

  std::string_view type() const override { return SphereCollider::info.name; }
  SignedDistance distance(const Vec3& point) const override {
    const Real length = point.norm();
    return {length - radius_, length > 0 ? Vec3(point / length) : Vec3(Vec3::UnitZ())};
  }
  Mesh surface(Real) const override { return rounded_box(Vec3::Zero(), radius_); }

 private:
  Real radius_;
};

}  // namespace

PlacedShape build(const SphereCollider& options) {
  check_options(SphereCollider::info.name, options);
  return {std::make_shared<SphereShape>(options.radius), {options.center}};
}

}  // namespace pliant
