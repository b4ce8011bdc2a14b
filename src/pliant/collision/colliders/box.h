#pragma once
#include "pliant/collision/colliders/collider.h"

namespace pliant {

/// A box whose edges may be rounded: a table, a step. With p = |x − c| in its axes and e half of its size less the
/// rounding ρ, d = ‖max(p − e, 0)‖ + min(max(p − e), 0) − ρ.
struct BoxCollider {
  static constexpr ColliderInfo info{"box", "‖max(|x − c| − e, 0)‖ + min(max(|x − c| − e), 0) − ρ"};

  /// c [m]
  Vec3 center = Vec3::Zero();
  /// [m], > 0: from face to face along its axes.
  Vec3 size = {1, 1, 1};
  /// ρ [m], ≥ 0, at most half of the least size: of its edges and corners.
  Real rounding = 0;
  /// [°]: how it is turned at the beginning, axis times angle.
  Vec3 rotation = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Vec3 surface_velocity = Vec3::Zero();
  Values friction{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"center", "m", "where it begins"}, self.center);
    field(OptionInfo{"size", "m", "from face to face along its axes", positive}, self.size);
    field(OptionInfo{"rounding", "m", "radius of its edges and corners, at most half of the least size", not_negative},
          self.rounding);
    field(OptionInfo{"rotation", "°", "how it is turned at the beginning: axis times angle"}, self.rotation);
    visit_motion(self, field);
  }
};

/// Throws Error(input) on options out of their range.
PlacedShape build(const BoxCollider& options);

}  // namespace pliant
