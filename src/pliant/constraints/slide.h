#pragma once
// Slide: a vertex is drawn to a plane and may slide in it.
//
//     z = xᵢ        p = xᵢ − ((xᵢ − o)·n) n, ‖n‖ = 1        E = k/2 dist(xᵢ, plane)²
#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

struct Slide {
  static constexpr ConstraintInfo info{"slide", "xᵢ", "the plane through o with normal n", "½ k dist(xᵢ, plane)²",
                                       "after thesis Sec. 4.4.2"};

  Selection on{};
  Stencils stencils{};
  Values stiffness = 1e5;
  Points normal{};
  Points origin{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices on the plane"}, self.on);
    field(OptionInfo{"stencils", "", "one vertex each, in place of `on`"}, self.stencils);
    field(OptionInfo{"stiffness", "N/m", "towards the plane", positive}, self.stiffness);
    field(OptionInfo{"normal", "", "of the plane, of any length but zero"}, self.normal);
    field(OptionInfo{"origin", "m", "a point of the plane; default: where the vertex starts"}, self.origin);
  }
};

struct SlideProjection {
  static constexpr std::string_view name = "slide";
  static constexpr int vertices = 1;
  static constexpr int rows = 1;
  static constexpr int fields = 6;  // origin, unit normal
  static constexpr bool translation_invariant = false;
  static constexpr bool has_anchors = true;
  static void project(const Real* field, const Real* z, Real* p) {
    const Real* o = field;
    const Real* n = field + 3;
    const Real distance = (z[0] - o[0]) * n[0] + (z[1] - o[1]) * n[1] + (z[2] - o[2]) * n[2];
    for (int axis = 0; axis < 3; ++axis) p[axis] = z[axis] - distance * n[axis];
  }
};

/// Throws Error(input) on a zero or missing normal, an index out of range, lists of the wrong length.
ConstraintSet build(const BodyView& body, const Slide& options);

}  // namespace pliant
