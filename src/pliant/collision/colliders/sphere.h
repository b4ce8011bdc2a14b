#pragma once
#include "pliant/collision/colliders/collider.h"

namespace pliant {

/// A ball. d = ‖x − c‖ − R.
struct SphereCollider {
  static constexpr ColliderInfo info{"sphere", "‖x − c‖ − R"};

  /// c [m]
  Vec3 center = Vec3::Zero();
  /// R [m], > 0
  Real radius = 0.5;
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Vec3 surface_velocity = Vec3::Zero();
  Values friction{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"center", "m", "where it begins"}, self.center);
    field(OptionInfo{"radius", "m", "of its surface", positive}, self.radius);
    visit_motion(self, field);
  }
};

/// Throws Error(input) on options out of their range.
PlacedShape build(const SphereCollider& options);

}  // namespace pliant
