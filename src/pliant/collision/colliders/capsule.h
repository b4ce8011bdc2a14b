#pragma once
#include "pliant/collision/colliders/collider.h"

namespace pliant {

/// A cylinder with round ends: a limb, a pole. d = distance to the segment from a to b, less R.
struct CapsuleCollider {
  static constexpr ColliderInfo info{"capsule", "‖x − segment‖ − R"};

  /// a [m]: one end of its axis. It turns about the middle between both.
  Vec3 from = {0, 0, -0.5};
  /// b [m]: the other end.
  Vec3 to = {0, 0, 0.5};
  /// R [m], > 0
  Real radius = 0.1;
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Vec3 surface_velocity = Vec3::Zero();
  Values friction{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"from", "m", "one end of its axis; it turns about the middle between both"}, self.from);
    field(OptionInfo{"to", "m", "the other end"}, self.to);
    field(OptionInfo{"radius", "m", "of its surface about the axis", positive}, self.radius);
    visit_motion(self, field);
  }
};

/// Throws Error(input) on options out of their range.
PlacedShape build(const CapsuleCollider& options);

}  // namespace pliant
