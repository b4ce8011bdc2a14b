#pragma once
// Bending of an edge between two triangles, free borders included: the hinge.
//
//          x₁
//        ╱ │ ╲          z = (c₁₂ + c₁₃) x₀ + (c₀₂ + c₀₃) x₁ − (c₀₂ + c₁₂) x₂ − (c₀₃ + c₁₃) x₃
//      x₂  │  x₃        p = z ‖z_g‖/‖z‖
//        ╲ │ ╱          E = κ/(2(A₀ + A₁)) (‖z‖ − ‖z_g‖)²
//          x₀
//
// c_ab: cotangent of the angle at edge vertex a in the triangle whose third vertex is b; A₀, A₁ the areas of the two
// triangles. z is zero on any flat pair. Source: Bergou et al. 2006, Sec. 4 ("A quadratic bending model"), with a third
// of its weight, so that on equilateral meshes and on strips the energy is κ/2 ∫ (2H)² dA; on grids with diagonals it
// is 3/4 to 3 times that, depending on the direction of the fold: 3 along the diagonals. Where the factor matters, use
// `bending`, which has 1.000 everywhere but leaves borders unbent.
#include "pliant/constraints/bending.h"

namespace pliant {

struct HingeBending {
  static constexpr ConstraintInfo info{"hinge", "Σ cᵢ xᵢ over two triangles", "the vectors of length ‖z_g‖",
                                       "½ κ/(A₀ + A₁) (‖z‖ − ‖z_g‖)²", "Bergou et al. 2006, Sec. 4"};

  /// Vertices whose edges resist folding; default: all.
  Selection on{};
  /// Two edge vertices and the two opposite, in place of the edges of the mesh.
  Stencils stencils{};
  /// κ of the sheet [N·m], > 0; cotton about 1e-5, sheet metal 1 and more.
  Values stiffness = 1e-3;
  /// Whether both ways of folding cost the same.
  Orientation orientation = Orientation::absolute;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose edges resist folding"}, self.on);
    field(OptionInfo{"stencils", "", "two edge vertices and the two opposite, in place of the edges of the mesh"},
          self.stencils);
    field(OptionInfo{"stiffness", "N·m", "κ of the sheet; cotton about 1e-5, sheet metal 1 and more", positive},
          self.stiffness);
    field(OptionInfo{"orientation", "", "`absolute`: both ways of folding cost the same; `signed`: they do not"},
          self.orientation);
  }
};

/// Throws Error(input) on an index out of range, a stencil whose triangles have no area, lists of the wrong length.
ConstraintSet build(const BodyView& body, const HingeBending& options);

}  // namespace pliant
