#pragma once
// Triangle strain: the stretches of a triangle stay between limits. 1 to 1 is as rigid as possible (ARAP).
//
//        x₂
//       ╱  ╲           z = F = Ds Dm⁻¹ (3 × 2) = U diag(σ) Vᵀ
//     x₀────x₁         p = U diag(clamp(σ, min, max)) Vᵀ        E = k a/2 ‖F − p‖²_F
//
// Source: Bouaziz et al. 2014, Sec. 5.1 (strain limiting). The same cloth at any resolution and in any orientation.
#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

struct TriangleStrain {
  static constexpr ConstraintInfo info{"triangle_strain", "F (3 × 2)", "F with stretches from min to max",
                                       "½ k a ‖F − p‖²", "Bouaziz et al. 2014, Sec. 5.1"};

  /// Vertices whose triangles resist strain; default: all.
  Selection on{};
  /// Triples of vertices, in place of the triangles of the mesh.
  Stencils stencils{};
  /// Young's modulus times thickness, roughly [N/m], > 0; cotton about 1e3.
  Values stiffness = 1e3;
  /// Smallest singular value of F left alone, 0 to max_stretch.
  Values min_stretch = 1;
  /// Largest singular value of F left alone, from min_stretch.
  Values max_stretch = 1;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose triangles resist strain"}, self.on);
    field(OptionInfo{"stencils", "", "triples of vertices, in place of the triangles of the mesh"}, self.stencils);
    field(OptionInfo{"stiffness", "N/m", "Young's modulus times thickness, roughly; cotton about 1e3", positive},
          self.stiffness);
    field(OptionInfo{"min_stretch", "", "smallest singular value of F left alone", not_negative}, self.min_stretch);
    field(OptionInfo{"max_stretch", "", "largest singular value of F left alone", not_negative}, self.max_stretch);
  }
};

struct TriangleStrainProjection {
  static constexpr std::string_view name = "triangle_strain";
  static constexpr int vertices = 3;
  static constexpr int rows = 2;
  static constexpr int fields = 2;  // min, max
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr bool limits_stretches = true;
  static constexpr auto kernel = &LocalKernels::triangle_strain;
  static void project(const Real* field, const Real* z, Real* p);
};

/// Throws Error(input) on a triangle without area, min above max, an index out of range, lists of the wrong length.
ConstraintSet build(const BodyView& body, const TriangleStrain& options);

}  // namespace pliant
