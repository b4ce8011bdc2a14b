#pragma once
// A constraint, a force and a collider of a user's own, which name their options.
#include <memory>

#include "pliant/constraints/batch.h"
#include "pliant/constraints/build.h"
#include "pliant/simulation/simulation.h"

namespace pliant_tests {

using pliant::OptionInfo;
using pliant::Real;
using pliant::Vec3;

/// A vertex stays outside of a ball.
struct OutsideBallProjection {
  static constexpr std::string_view name = "outside_ball";
  static constexpr int vertices = 1, rows = 1, fields = 4;  // center, radius
  static constexpr bool translation_invariant = false;
  static void project(const Real* field, const Real* z, Real* p) {
    const Vec3 center(field[0], field[1], field[2]), point(z[0], z[1], z[2]);
    const Vec3 way = point - center;
    const Real distance = way.norm();
    const Vec3 nearest = distance > 0 && distance < field[3] ? Vec3(center + way * (field[3] / distance)) : point;
    std::copy_n(nearest.data(), 3, p);
  }
};

enum class BallSize { as_given, double_ };
constexpr std::array<std::string_view, 2> choice_names(BallSize) {
  return {"as_given", "double"};
}

struct OutsideBall {
  static constexpr pliant::ConstraintInfo info{"outside_ball", "x", "outside of a ball", "", ""};
  pliant::Selection on{};
  pliant::Values stiffness = 1e3;
  Vec3 center = Vec3::Zero();
  Real radius = 0.3;
  BallSize size = BallSize::as_given;
  bool is_hollow = false;
  std::vector<int> passed_over{};  // of a kind that nobody knows

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices kept outside"}, self.on);
    field(OptionInfo{"stiffness", "N/m", "towards the surface", pliant::positive}, self.stiffness);
    field(OptionInfo{"center", "m", "of the ball"}, self.center);
    field(OptionInfo{"radius", "m", "of the ball", pliant::positive}, self.radius);
    field(OptionInfo{"size", "", "`as_given` or `double`"}, self.size);
    field(OptionInfo{"is_hollow", "", "changes nothing"}, self.is_hollow);
    field(OptionInfo{"passed_over", "", "a list"}, self.passed_over);
  }
};

inline pliant::ConstraintSet build(const pliant::BodyView& body, const OutsideBall& options) {
  const pliant::Stencils chosen = choose_vertices(OutsideBall::info.name, body, options.on, {});
  const pliant::StiffnessSplit stiffness(OutsideBall::info.name, body, options.stiffness, chosen);
  auto batch = std::make_unique<pliant::Batch<OutsideBallProjection>>(stiffness.common());
  const Real radius = options.size == BallSize::double_ ? 2 * options.radius : options.radius;
  const std::array<Real, 4> ball = {options.center[0], options.center[1], options.center[2], radius};
  const Real one = 1;
  for (pliant::Index i = 0; i < chosen.size(); ++i) {
    const pliant::Index vertex = body.first_vertex + chosen[i][0];
    batch->add({&vertex, 1}, {&one, 1}, stiffness.of(i), ball);
  }
  pliant::ConstraintSet set;
  set.count = chosen.size();
  set.batches.push_back(std::move(batch));
  return set;
}

/// A force about the z axis that grows with the distance from it.
struct Whirl {
  static constexpr pliant::ForceInfo info{"whirl", "c m ẑ × x", "", pliant::ForceReach::bodies};
  Real strength = 2;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"strength", "1/s²", "acceleration a meter from the axis", pliant::Range{0, 50}}, self.strength);
  }
};

class WhirlForce final : public pliant::Force {
 public:
  explicit WhirlForce(Real strength) : strength_(strength) {}
  std::string_view type() const override { return Whirl::info.name; }
  void add_to(pliant::Positions& forces, const pliant::StateView& state, Real) override {
    for (pliant::Index i = 0; i < static_cast<pliant::Index>(forces.rows()); ++i) {
      const Real factor = strength_ * state.masses[static_cast<std::size_t>(i)];
      forces.row(i) += factor * pliant::row(state.positions, i).cross(Vec3(0, 0, -1)).transpose();
    }
  }
  std::unique_ptr<Force> copy() const override { return std::make_unique<WhirlForce>(*this); }

 private:
  Real strength_;
};

inline std::unique_ptr<pliant::Force> build(const pliant::ForceScope&, const Whirl& options) {
  pliant::check_options(Whirl::info.name, options);
  return std::make_unique<WhirlForce>(options.strength);
}

/// An ellipsoid that is told by its distance from a ball, near enough where it is nearly one.
class EggShape final : public pliant::ColliderShape {
 public:
  explicit EggShape(Real height) : height_(height) {}
  std::string_view type() const override { return "egg"; }
  pliant::SignedDistance distance(const Vec3& point) const override {
    const Real length = point.norm();
    return {length - height_, length > 0 ? Vec3(point / length) : Vec3(0, 0, 1)};
  }

 private:
  Real height_;
};

struct EggCollider {
  static constexpr pliant::ColliderInfo info{"egg", "‖x‖ − h"};
  Real height = 0.2;
  Vec3 center = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Vec3 surface_velocity = Vec3::Zero();
  pliant::Values friction{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"height", "m", "from the center to the top", pliant::positive}, self.height);
    field(OptionInfo{"center", "m", "where it begins"}, self.center);
    pliant::visit_motion(self, field);
  }
};

inline pliant::PlacedShape build(const EggCollider& options) {
  pliant::check_options(EggCollider::info.name, options);
  return {std::make_shared<EggShape>(options.height), {options.center}};
}

}  // namespace pliant_tests
