#pragma once
// Plane and half-space: a vertex is drawn to a plane and may slide in it, or is kept on one side of it.
//
//     z = xᵢ        d = (xᵢ − o)·n, ‖n‖ = 1        plane: p = xᵢ − d n        E = k/2 d²
//                                             half-space: p = xᵢ − min(d, 0) n        E = k/2 min(d, 0)²
//
// Source: Bouaziz et al. 2014, Sec. 5 (positional constraints); thesis Ch. 7. As with `line`, A is the identity, so an
// iterate is also held back in the plane until the iterations have converged; a vertex in a half-space too, though
// nothing pushes it there. What is to touch and slide with friction is a collider instead.
#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

/// Vertices in a plane.
struct OnPlane {
  static constexpr ConstraintInfo info{"plane", "xᵢ", "the plane (p − o)·n = 0, ‖n‖ = 1", "½ k dist(xᵢ, plane)²",
                                       "thesis Ch. 7"};

  /// Vertices in the plane; default: all.
  Selection on{};
  /// One vertex each, in place of `on`.
  Stencils stencils{};
  /// Towards the plane [N/m], > 0.
  Values stiffness = 1e5;
  /// Of the plane, of any finite length but zero; one for all, or one for each.
  Points normal{};
  /// A point of the plane [m]; default: where the vertex starts.
  Points origin{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices in the plane"}, self.on);
    field(OptionInfo{"stencils", "", "one vertex each, in place of `on`"}, self.stencils);
    field(OptionInfo{"stiffness", "N/m", "towards the plane", positive}, self.stiffness);
    field(OptionInfo{"normal", "", "of the plane, of any length but zero"}, self.normal);
    field(OptionInfo{"origin", "m", "a point of the plane; default: where the vertex starts"}, self.origin);
  }
};

/// Vertices on one side of a plane.
struct InHalfSpace {
  static constexpr ConstraintInfo info{"half_space", "xᵢ", "the points (p − o)·n ≥ 0, ‖n‖ = 1",
                                       "½ k dist(xᵢ, half-space)²", "thesis Ch. 7"};

  /// Vertices kept on the side; default: all.
  Selection on{};
  /// One vertex each, in place of `on`.
  Stencils stencils{};
  /// Against going behind the plane [N/m], > 0.
  Values stiffness = 1e5;
  /// Out of the plane to the side that is free, of any finite length but zero; one for all, or one for each.
  Points normal{};
  /// A point of the plane [m]; default: where the vertex starts.
  Points origin{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices kept on the side"}, self.on);
    field(OptionInfo{"stencils", "", "one vertex each, in place of `on`"}, self.stencils);
    field(OptionInfo{"stiffness", "N/m", "against going behind the plane", positive}, self.stiffness);
    field(OptionInfo{"normal", "", "out of the plane to the side that is free, of any length but zero"}, self.normal);
    field(OptionInfo{"origin", "m", "a point of the plane; default: where the vertex starts"}, self.origin);
  }
};

struct PlaneProjection {
  static constexpr std::string_view name = "plane";
  static constexpr int vertices = 1;
  static constexpr int rows = 1;
  static constexpr int fields = 6;  // origin, unit normal
  static constexpr bool translation_invariant = false;
  static constexpr bool has_anchors = true;

  static Real height(const Real* field, const Real* z) {
    const Real* o = field;
    const Real* n = field + 3;
    return (z[0] - o[0]) * n[0] + (z[1] - o[1]) * n[1] + (z[2] - o[2]) * n[2];
  }
  static void project(const Real* field, const Real* z, Real* p) {
    const Real d = height(field, z);
    for (int axis = 0; axis < 3; ++axis) p[axis] = z[axis] - d * field[3 + axis];
  }
};

struct HalfSpaceProjection : PlaneProjection {
  static constexpr std::string_view name = "half_space";
  static void project(const Real* field, const Real* z, Real* p) {
    const Real d = height(field, z);
    for (int axis = 0; axis < 3; ++axis) p[axis] = d < 0 ? z[axis] - d * field[3 + axis] : z[axis];
  }
};

/// Throw Error(input) on a zero or missing normal, an index out of range, lists of the wrong length.
ConstraintSet build(const BodyView& body, const OnPlane& options);
ConstraintSet build(const BodyView& body, const InHalfSpace& options);

}  // namespace pliant
