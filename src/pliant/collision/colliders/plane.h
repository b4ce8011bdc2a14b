#pragma once
#include "pliant/collision/colliders/collider.h"

namespace pliant {

/// A floor, a wall, a slope: everything behind a plane without end. d = n·(x − c).
struct PlaneCollider {
  static constexpr ColliderInfo info{"plane", "n·(x − c)"};

  /// c [m]: a point of the plane; it turns about this one.
  Vec3 position = Vec3::Zero();
  /// n, of any length but zero: points to the side where bodies are.
  Vec3 normal = Vec3::UnitZ();
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Vec3 surface_velocity = Vec3::Zero();
  Values friction{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"position", "m", "a point of the plane, about which it turns"}, self.position);
    field(OptionInfo{"normal", "", "of any length but zero; points to the side where bodies are"}, self.normal);
    visit_motion(self, field);
  }
};

/// Throws Error(input) on options out of their range.
PlacedShape build(const PlaneCollider& options);

}  // namespace pliant
