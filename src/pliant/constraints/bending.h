#pragma once
// Bending of an interior vertex: the mean curvature keeps its magnitude.
//
//          x₂ ──── x₁           z = v = 1/(2a) Σⱼ (cot αⱼ + cot βⱼ)(xⱼ − x₀)
//         ╱  ╲  β ╱  ╲          p = v ‖v_g‖/‖v‖
//       x₃ ─── x₀ ─── x₆        E = κ a/2 (‖v‖ − ‖v_g‖)²
//         ╲  ╱  α ╲  ╱
//          x₄ ──── x₅           a: mixed Voronoi area; cotangents, a and v_g of the rest shape
//
// Source: thesis Sec. 4.4.4, Eq. 4.4, with a in the system matrix and in the right-hand side alike (Algorithm 2 lacks
// it); area after Meyer et al. 2003, Sec. 3.3. The energy is κ/2 ∫ (2H − 2H₀)² dA, the factor 1.000 of it.
//
// Flat rest (v_g = 0): p = 0, a constant quadratic that needs no projection. Curved rest and v = 0: every direction is
// equally near; the rest vector is taken. Boundary vertices, and those whose triangles are no closed fan, are skipped.
//
// Only magnitudes are compared, so a dent costs as much as a bump: `absolute`. With `signed`, n being the vertex normal
// at the start of the step and σ the sign of v_g·n at rest, p is the nearest point of the half-sphere
// {‖p‖ = ‖v_g‖, σ p·n ≥ 0}.
#include "pliant/constraints/constraint_set.h"

namespace pliant {

enum class Orientation { absolute, signed_ };
constexpr std::array<std::string_view, 2> choice_names(Orientation) {
  return {"absolute", "signed"};
}

struct Bending {
  static constexpr ConstraintInfo info{"bending", "1/(2a) Σ (cot α + cot β)(xⱼ − x₀)", "the vectors of length ‖v_g‖",
                                       "½ κ a (‖v‖ − ‖v_g‖)²", "thesis Sec. 4.4.4, Eq. 4.4"};

  /// Vertices that resist bending, where all their neighbors are selected too; default: all.
  Selection on{};
  /// Center and neighbors (for `signed` in cyclic order), in place of `on`; with cotangents and areas.
  Stencils stencils{};
  /// κ of the sheet [N·m], > 0; cotton about 1e-5, sheet metal 1 and more. Doubling it costs no time.
  Values stiffness = 1e-3;
  /// Whether a dent costs as much as a bump.
  Orientation orientation = Orientation::absolute;
  Ragged<Real>
      cotangents{};  ///< cot α + cot β of each neighbor of each stencil, any finite numbers; with `stencils` alone.
  /// Of each stencil [m²], > 0; with `stencils` alone.
  Values areas{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices that resist bending, where all their neighbors are selected too"}, self.on);
    field(OptionInfo{"stencils", "", "center and neighbors (for `signed` in cyclic order); with cotangents and areas"},
          self.stencils);
    field(OptionInfo{"stiffness", "N·m", "κ of the sheet; cotton about 1e-5, sheet metal 1 and more", positive},
          self.stiffness);
    field(OptionInfo{"orientation", "", "`absolute`: a dent costs as much as a bump; `signed`: it costs more"},
          self.orientation);
    field(OptionInfo{"cotangents", "", "cot α + cot β of each neighbor of each stencil"}, self.cotangents);
    field(OptionInfo{"areas", "m²", "of each stencil", positive}, self.areas);
  }
};

/// One batch for each valence, flat and curved. Throws Error(input) on stencils without cotangents and areas, lists of
/// the wrong length, an index out of range, an area that is not positive.
ConstraintSet build(const BodyView& body, const Bending& options);

}  // namespace pliant
