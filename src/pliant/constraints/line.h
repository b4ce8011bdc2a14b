#pragma once
// Line: a vertex is drawn to a straight line and may slide along it.
//
//     z = xᵢ        p = o + ((xᵢ − o)·d) d, ‖d‖ = 1        E = k/2 dist(xᵢ, line)²
//
// Source: thesis Sec. 4.4.2, Eq. 4.2. Since A is the identity, an iterate is also held back along the line until the
// iterations have converged; the converged step slides freely.
#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

struct Line {
  static constexpr ConstraintInfo info{"line", "xᵢ", "the line o + λ d, ‖d‖ = 1", "½ k dist(xᵢ, line)²",
                                       "thesis Sec. 4.4.2, Eq. 4.2"};

  /// Vertices on the line; default: all.
  Selection on{};
  /// One vertex each, in place of `on`.
  Stencils stencils{};
  /// Towards the line [N/m], > 0.
  Values stiffness = 1e5;
  /// Of the line, of any finite length but zero; one for all, or one for each.
  Points direction{};
  /// A point of the line [m]; default: where the vertex starts.
  Points origin{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices on the line"}, self.on);
    field(OptionInfo{"stencils", "", "one vertex each, in place of `on`"}, self.stencils);
    field(OptionInfo{"stiffness", "N/m", "towards the line", positive}, self.stiffness);
    field(OptionInfo{"direction", "", "of the line, of any length but zero"}, self.direction);
    field(OptionInfo{"origin", "m", "a point of the line; default: where the vertex starts"}, self.origin);
  }
};

struct LineProjection {
  static constexpr std::string_view name = "line";
  static constexpr int vertices = 1;
  static constexpr int rows = 1;
  static constexpr int fields = 6;  // origin, unit direction
  static constexpr bool translation_invariant = false;
  static constexpr bool has_anchors = true;
  static void project(const Real* field, const Real* z, Real* p) {
    const Real* o = field;
    const Real* d = field + 3;
    const Real along = (z[0] - o[0]) * d[0] + (z[1] - o[1]) * d[1] + (z[2] - o[2]) * d[2];
    for (int axis = 0; axis < 3; ++axis) p[axis] = o[axis] + along * d[axis];
  }
};

/// Throws Error(input) on a zero or missing direction, an index out of range, lists of the wrong length.
ConstraintSet build(const BodyView& body, const Line& options);

}  // namespace pliant
