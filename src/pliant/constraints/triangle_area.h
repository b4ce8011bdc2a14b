#pragma once
// Triangle area: the area of a triangle stays between limits, whatever its shape.
//
//        x₂
//       ╱  ╲           z = F = Ds Dm⁻¹ (3 × 2) = U diag(σ) Vᵀ
//     x₀────x₁         p = U diag(g) Vᵀ, g nearest to σ with min ≤ g₁ g₂ ≤ max        E = k a/2 ‖F − p‖²_F
//
// Source: Bouaziz et al. 2014, Sec. 5.1 (area and volume preservation); thesis Ch. 7. By itself it leaves shapes free,
// and F without area has no nearest p: the first axis of the rest frame is taken.
#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

struct TriangleArea {
  static constexpr ConstraintInfo info{"triangle_area", "F (3 × 2)", "F with σ₁ σ₂ from min to max", "½ k a ‖F − p‖²",
                                       "Bouaziz et al. 2014, Sec. 5.1"};

  /// Vertices whose triangles keep their area; default: all.
  Selection on{};
  /// Triples of vertices, in place of the triangles of the mesh.
  Stencils stencils{};
  /// Against changes of area [N/m], > 0.
  Values stiffness = 1e3;
  /// Smallest area left alone, as a share of that at rest, 0 to max_area.
  Values min_area = 1;
  /// Largest area left alone, as a share of that at rest, > 0, from min_area.
  Values max_area = 1;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose triangles keep their area"}, self.on);
    field(OptionInfo{"stencils", "", "triples of vertices, in place of the triangles of the mesh"}, self.stencils);
    field(OptionInfo{"stiffness", "N/m", "against changes of area", positive}, self.stiffness);
    field(OptionInfo{"min_area", "", "smallest area left alone, as a share of that at rest", not_negative},
          self.min_area);
    field(OptionInfo{"max_area", "", "largest area left alone, as a share of that at rest", positive}, self.max_area);
  }
};

struct TriangleAreaProjection {
  static constexpr std::string_view name = "triangle_area";
  static constexpr int vertices = 3;
  static constexpr int rows = 2;
  static constexpr int fields = 2;  // min, max
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr auto kernel = &LocalKernels::triangle_area;
  static void project(const Real* field, const Real* z, Real* p);
};

/// Throws Error(input) on a triangle without area, min above max, an index out of range, lists of the wrong length.
ConstraintSet build(const BodyView& body, const TriangleArea& options);

}  // namespace pliant
