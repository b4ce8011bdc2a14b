#pragma once
// Tetrahedron volume: the volume of a tetrahedron stays between limits, whatever its shape.
//
//     z = F = Ds Dm⁻¹ (3 × 3) = U diag(σ) Vᵀ, U and V rotations, σ₃ with the sign of det F
//     p = U diag(g) Vᵀ, g nearest to σ with min ≤ g₁ g₂ g₃ ≤ max        E = k v/2 ‖F − p‖²_F
//
// Source: Bouaziz et al. 2014, Sec. 5.1 (area and volume preservation); thesis Ch. 7. By itself it leaves shapes free:
// beside `tetrahedron_strain` it makes what is stretched thinner, as Poisson's ratio does. An inverted element is
// turned back along its smallest stretch, to the nearest F of positive volume.
#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

struct TetrahedronVolume {
  static constexpr ConstraintInfo info{"tetrahedron_volume", "F (3 × 3)", "F with det F from min to max",
                                       "½ k v ‖F − p‖²", "Bouaziz et al. 2014, Sec. 5.1"};

  /// Vertices whose tetrahedra keep their volume; default: all.
  Selection on{};
  /// Quadruples of vertices, in place of the tetrahedra of the mesh.
  Stencils stencils{};
  /// Against changes of volume [Pa], > 0.
  Values stiffness = 1e5;
  /// Smallest volume left alone, as a share of that at rest, above 0 to max_volume.
  Values min_volume = 1;
  /// Largest volume left alone, as a share of that at rest, > 0, from min_volume.
  Values max_volume = 1;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose tetrahedra keep their volume"}, self.on);
    field(OptionInfo{"stencils", "", "quadruples of vertices, in place of the tetrahedra of the mesh"}, self.stencils);
    field(OptionInfo{"stiffness", "Pa", "against changes of volume", positive}, self.stiffness);
    field(OptionInfo{"min_volume", "", "smallest volume left alone, as a share of that at rest", positive},
          self.min_volume);
    field(OptionInfo{"max_volume", "", "largest volume left alone, as a share of that at rest", positive},
          self.max_volume);
  }
};

struct TetrahedronVolumeProjection {
  static constexpr std::string_view name = "tetrahedron_volume";
  static constexpr int vertices = 4;
  static constexpr int rows = 3;
  static constexpr int fields = 2;  // min, max
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr auto kernel = &LocalKernels::tetrahedron_volume;
  static void project(const Real* field, const Real* z, Real* p);
};

/// Throws Error(input) on an inverted or flat tetrahedron, min above max, an index out of range, lists of the wrong
/// length.
ConstraintSet build(const BodyView& body, const TetrahedronVolume& options);

}  // namespace pliant
