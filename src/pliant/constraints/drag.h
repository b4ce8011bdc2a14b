#pragma once
// Drag: a point of the body is drawn to a target by an implicit spring, as by a hand.
//
//     z = Σ bⱼ xⱼ (one vertex, or a point of an edge or a triangle)        p = t        E = k/2 ‖z − t‖²
//
// The implicit counterpart of the thesis' mouse spring (Sec. 5.2): stable at any stiffness, mass and time step.
#include "pliant/constraints/position.h"

namespace pliant {

struct Drag {
  static constexpr ConstraintInfo info{"drag", "Σ bⱼ xⱼ", "the target t", "½ k ‖Σ bⱼ xⱼ − t‖²",
                                       "thesis Sec. 5.2, made implicit"};

  /// One to four vertices of an element each.
  Stencils stencils{};
  /// Barycentric coordinates bⱼ of each point, 0 to 1, summing to 1; default: equal.
  Ragged<Real> weights{};
  /// Of the spring of rest length zero [N/m], > 0; stable at any value.
  Values stiffness = 1e3;
  /// Where to [m]: one for all, or one for each; default: where the points start.
  Points targets{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"stencils", "", "one to four vertices of an element each"}, self.stencils);
    field(
        OptionInfo{"weights", "", "barycentric coordinates bⱼ of the point, summing to 1; default: equal", Range{0, 1}},
        self.weights);
    field(OptionInfo{"stiffness", "N/m", "of the spring of rest length zero", positive}, self.stiffness);
    field(OptionInfo{"targets", "m", "where to; default: where the point starts"}, self.targets);
  }
};

struct DragProjection {
  static constexpr std::string_view name = "drag";
  static constexpr int vertices = dynamic_vertices;
  static constexpr int rows = 1;
  static constexpr int fields = 3;  // the target
  static constexpr bool translation_invariant = false;
  static constexpr bool has_targets = true;
  static constexpr bool comes_and_goes = true;
  static void project(const Real* target, const Real* z, Real* p) { PositionProjection::project(target, z, p); }
};

/// Throws Error(input) on stencils that are missing or of no or over four vertices, weights that do not sum to 1, an
/// index out of range, lists of the wrong length.
ConstraintSet build(const BodyView& body, const Drag& options);

}  // namespace pliant
