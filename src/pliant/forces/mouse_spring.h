#pragma once
#include "pliant/forces/force_options.h"

namespace pliant {

/// The mouse spring as the thesis prints it (Sec. 5.2, Eq. 5.3): F = k (‖d‖ − L) d/‖d‖ with d = anchor − xᵢ, evaluated
/// at qₙ. Explicit, hence unstable once h² k/m ≥ 4, and refused with BDF2; the constraint Drag is the implicit spring
/// without that limit. No force where d = 0. The potential is k/2 (‖d‖ − L)².
struct MouseSpring {
  static constexpr ForceInfo info{"mouse_spring", "k (‖d‖ − L) d/‖d‖", "thesis Eq. 5.3", ForceReach::body, "anchor"};

  /// Vertices of the body that hang on such a spring each; default: all.
  Selection vertices{};
  /// The other end of the spring [m], finite: a point in space that stays where it is until it is changed.
  Vec3 anchor = Vec3::Zero();
  /// k [N/m], > 0; stable only while h² k/m < 4.
  Real stiffness = 100;
  /// L [m], ≥ 0: the length at which the spring neither draws nor pushes.
  Real rest_length = 0;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"vertices", "", "on a spring each; or \"vertex\", an index"}, self.vertices);
    field(OptionInfo{"anchor", "m", "the other end of the spring, which stays there until it is changed"}, self.anchor);
    field(
        OptionInfo{"stiffness", "N/m", "k, explicit: stable only while h² k/m < 4; a drag has no such limit", positive},
        self.stiffness);
    field(OptionInfo{"rest_length", "m", "L", not_negative}, self.rest_length);
  }
};

/// Throws Error(input) on options out of their range.
std::unique_ptr<Force> build(const ForceScope& scope, const MouseSpring& options);

}  // namespace pliant
