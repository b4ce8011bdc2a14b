#pragma once
// Elastic materials with an energy of their own: stable Neo-Hookean and St. Venant-Kirchhoff, for tetrahedra and for
// triangles (membranes in plane stress). They know Young's modulus and Poisson's ratio.
//
//     z = F = Ds Dm⁻¹ (3 × 3 or 3 × 2)        E = v Ψ(F), of triangles a Ψ(F)
//
//     stable Neo-Hookean      Ψ = μ/2 (tr C − 3) + λ/2 (J − α)² − μ/2 ln(tr C + 1), C = FᵀF, J = det F
//     St. Venant-Kirchhoff    Ψ = μ ‖G‖² + λ/2 (tr G)², G = (C − I)/2
//
// No point p is nearest to z, so they are no projections: the system matrix has w/2 ‖Az‖² with w = c v in their place,
// c the curvature of Ψ along one stretch at rest, and L-BFGS learns what they are besides (Liu, Bouaziz and Kavan
// 2017, Sec. 4). Moves that would raise the objective are shortened, with or without `lbfgs`.
//
// Source: Smith, De Goes and Kim 2018, Eq. 14, with its μ and λ for given moduli (Sec. 3.4); of triangles its analogue
// Ψ = μ/2 (tr C − 2) − μ (J − 1) + (λ + μ)/2 (J − 1)² with J the ratio of areas.
#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

/// Of the options: above it, what is left to change of a volume is too little for the iterations to find.
inline constexpr Real largest_poisson_ratio = 0.4999;

struct NeoHookean {
  static constexpr auto kernel_of_tetrahedra = &LocalKernels::tetrahedron_neo_hookean;
  static constexpr auto kernel_of_triangles = &LocalKernels::triangle_neo_hookean;
  static constexpr ConstraintInfo of_tetrahedra{"tetrahedron_neo_hookean", "F (3 × 3)", no_set,
                                                "v (½ μ (I − 3) + ½ λ (J − α)² − ½ μ ln(I + 1))", "Smith et al. 2018"};
  static constexpr ConstraintInfo of_triangles{"triangle_neo_hookean", "F (3 × 2)", no_set,
                                               "a (½ μ (I − 2J) + ½ (λ + μ) (J − 1)²)", "after Smith et al. 2018"};
};

struct StVenantKirchhoff {
  static constexpr auto kernel_of_tetrahedra = &LocalKernels::tetrahedron_stvk;
  static constexpr auto kernel_of_triangles = &LocalKernels::triangle_stvk;
  static constexpr ConstraintInfo of_tetrahedra{"tetrahedron_stvk", "F (3 × 3)", no_set, "v (μ ‖G‖² + ½ λ (tr G)²)",
                                                "Sifakis and Barbič 2012, Sec. 3.3"};
  static constexpr ConstraintInfo of_triangles{"triangle_stvk", "F (3 × 2)", no_set, "a (μ ‖G‖² + ½ λ (tr G)²)",
                                               "Sifakis and Barbič 2012, Sec. 3.3"};
};

template <class Law>
struct ElasticTetrahedra {
  static constexpr ConstraintInfo info = Law::of_tetrahedra;

  /// Vertices whose tetrahedra resist strain; default: all.
  Selection on{};
  /// Quadruples of vertices, in place of the tetrahedra of the mesh.
  Stencils stencils{};
  /// Young's modulus [Pa], > 0.
  Values stiffness = 1e5;
  /// 0 to 0.4999; rubber and flesh about 0.45 to 0.49.
  Real poisson_ratio = 0.45;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose tetrahedra resist strain"}, self.on);
    field(OptionInfo{"stencils", "", "quadruples of vertices, in place of the tetrahedra of the mesh"}, self.stencils);
    field(OptionInfo{"stiffness", "Pa", "Young's modulus", positive}, self.stiffness);
    field(OptionInfo{"poisson_ratio", "", "by which what is stretched becomes thinner; rubber 0.49",
                     Range{0, largest_poisson_ratio}},
          self.poisson_ratio);
  }
};

template <class Law>
struct ElasticTriangles {
  static constexpr ConstraintInfo info = Law::of_triangles;

  /// Vertices whose triangles resist strain; default: all.
  Selection on{};
  /// Triples of vertices, in place of the triangles of the mesh.
  Stencils stencils{};
  /// Young's modulus times thickness [N/m], > 0.
  Values stiffness = 1e3;
  /// 0 to 0.4999; rubber sheets 0.49, woven cloth less along its threads than any material of these.
  Real poisson_ratio = 0.3;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose triangles resist strain"}, self.on);
    field(OptionInfo{"stencils", "", "triples of vertices, in place of the triangles of the mesh"}, self.stencils);
    field(OptionInfo{"stiffness", "N/m", "Young's modulus times thickness", positive}, self.stiffness);
    field(OptionInfo{"poisson_ratio", "", "by which what is stretched becomes narrower; rubber 0.49",
                     Range{0, largest_poisson_ratio}},
          self.poisson_ratio);
  }
};

using TetrahedronNeoHookean = ElasticTetrahedra<NeoHookean>;
using TetrahedronStvk = ElasticTetrahedra<StVenantKirchhoff>;
using TriangleNeoHookean = ElasticTriangles<NeoHookean>;
using TriangleStvk = ElasticTriangles<StVenantKirchhoff>;

/// Fields: μ and λ of the law over c, both for a Young's modulus of 1.
template <class Law, int columns>
struct ElasticPotential {
  static constexpr std::string_view name = columns == 3 ? Law::of_tetrahedra.name : Law::of_triangles.name;
  static constexpr int vertices = columns + 1;
  static constexpr int rows = columns;
  static constexpr int fields = 2;
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr auto kernel = columns == 3 ? Law::kernel_of_tetrahedra : Law::kernel_of_triangles;
  static Real potential(const Real* field, const Real* z, Real* d);
};

/// Throws Error(input) on an element without positive measure, an index out of range, lists of the wrong length.
template <class Law>
ConstraintSet build(const BodyView& body, const ElasticTetrahedra<Law>& options);
template <class Law>
ConstraintSet build(const BodyView& body, const ElasticTriangles<Law>& options);

}  // namespace pliant
