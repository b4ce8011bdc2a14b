#include "pliant/collision/colliders/box.h"

#include <numbers>

#include <fmt/format.h>

#include "pliant/collision/colliders/surface.h"

namespace pliant {
namespace {

class BoxShape final : public ColliderShape {
 public:
  BoxShape(Vec3 inner, Real rounding) : inner_(std::move(inner)), rounding_(rounding) {}

  std::string_view type() const override { return BoxCollider::info.name; }
  SignedDistance distance(const Vec3& point) const override {
    const Vec3 sign = point.unaryExpr([](Real x) { return x < 0 ? Real(-1) : Real(1); });
    const Vec3 beyond = point.cwiseAbs() - inner_;
    int face = 0;
    const Real most = beyond.maxCoeff(&face);
    if (most <= 0) return {most - rounding_, sign[face] * Vec3::Unit(face)};
    const Vec3 outside = beyond.cwiseMax(0);
    const Real length = outside.norm();
    return {length - rounding_, sign.cwiseProduct(outside / length)};
  }
  Mesh surface(Real) const override { return rounded_box(inner_, rounding_); }

 private:
  Vec3 inner_;  // half of its size, without the rounding
  Real rounding_;
};

}  // namespace

PlacedShape build(const BoxCollider& options) {
  check_options(BoxCollider::info.name, options);
  const Vec3 half = options.size / 2;
  if (options.rounding > half.minCoeff()) {
    fail_input(fmt::format("box: rounding: {} is more than half of the least size; give at most {} [m]",
                           options.rounding, half.minCoeff()));
  }
  const Vec3 turn = options.rotation * (std::numbers::pi / 180);
  return {std::make_shared<BoxShape>(half - Vec3::Constant(options.rounding), options.rounding),
          moved_on({options.center}, Vec3::Zero(), turn, 1)};
}

}  // namespace pliant
