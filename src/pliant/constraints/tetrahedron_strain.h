#pragma once
// Tetrahedron strain: the stretches of a tetrahedron stay between limits. 1 to 1 is as rigid as possible (ARAP).
//
//     z = F = Ds Dm⁻¹ (3 × 3) = U diag(σ) Vᵀ, U and V rotations, σ₃ with the sign of det F
//     p = U diag(clamp(σ, min, max)) Vᵀ, so det p > 0 whatever det F        E = k v/2 ‖F − p‖²_F
//
// Source: Bouaziz et al. 2014, Sec. 5.1. An inverted element is turned back along its smallest stretch.
#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

struct TetrahedronStrain {
  static constexpr ConstraintInfo info{"tetrahedron_strain", "F (3 × 3)", "F with stretches from min to max, det > 0",
                                       "½ k v ‖F − p‖²", "Bouaziz et al. 2014, Sec. 5.1"};

  /// Vertices whose tetrahedra resist strain; default: all.
  Selection on{};
  /// Quadruples of vertices, in place of the tetrahedra of the mesh.
  Stencils stencils{};
  /// Of the material [Pa], > 0; half of it is the shear modulus.
  Values stiffness = 1e5;
  /// Smallest singular value of F left alone, above 0 up to max_stretch.
  Values min_stretch = 1;
  /// Largest singular value of F left alone, from min_stretch.
  Values max_stretch = 1;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose tetrahedra resist strain"}, self.on);
    field(OptionInfo{"stencils", "", "quadruples of vertices, in place of the tetrahedra of the mesh"}, self.stencils);
    field(OptionInfo{"stiffness", "Pa", "of the material; half of it is the shear modulus", positive}, self.stiffness);
    field(OptionInfo{"min_stretch", "", "smallest singular value of F left alone", positive}, self.min_stretch);
    field(OptionInfo{"max_stretch", "", "largest singular value of F left alone", positive}, self.max_stretch);
  }
};

struct TetrahedronStrainProjection {
  static constexpr std::string_view name = "tetrahedron_strain";
  static constexpr int vertices = 4;
  static constexpr int rows = 3;
  static constexpr int fields = 2;  // min, max
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr bool limits_stretches = true;
  static constexpr auto kernel = &LocalKernels::tetrahedron_strain;
  static void project(const Real* field, const Real* z, Real* p);
};

/// Throws Error(input) on an inverted or flat tetrahedron, min above max, an index out of range, lists of the wrong
/// length.
ConstraintSet build(const BodyView& body, const TetrahedronStrain& options);

}  // namespace pliant
