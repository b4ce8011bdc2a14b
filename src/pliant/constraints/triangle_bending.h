#pragma once
// Bending of a triangle together with its neighbors: the Hessian of position, borders included.
//
//        r ─── x₂ ─── r         H = 1/A Σ_e l_e sym((∂_t x t + s_e n) ⊗ n) over its three edges, constant in it
//          ╲  ╱  ╲  ╱           z = (H_xx, √2 H_xy, H_yy), three rows, each a constraint
//          x₀ ─── x₁            p = z ‖z_g‖/‖z‖ of each row
//            ╲   ╱              E = κ A/2 Σ (‖z‖ − ‖z_g‖)²
//              r
//
// l, t, n: length, direction and outer normal of an edge in the plane of the triangle at rest; s_e: slope across the
// edge at its middle. This is Morley's plate element, with slopes that vertices give: the mean of the slopes of the two
// triangles, corrected by folds at the edge and at edges around it, so that it is exact for every quadratic surface
// laid over the unfolded triangles (edge_slope.h), to a share of 1e-4. On grids a triangle has 6 vertices, on other
// meshes 9 in the mean and 12 at most. Both triangles have the same s_e, so that moments of any constant H are in
// balance inside. With both, the energy is κ/2 ∫ ‖∇²x‖² (a plate of ν = 0) on any mesh and in any direction, not only
// where vertices lie on a smooth surface but also where they find their equilibrium themselves.
//
// Borders: s_e is free there, so that no moment acts across: the part of H along n ⊗ n is left out, curvature along the
// border and twist are kept. A border that is clamped holds half a row of triangles behind the last pinned vertices.
//
// Flat rest: p = 0, a constant quadratic. Curved rest: rows are turned among themselves so that the first has the
// direction of H of the rest shape, and the two others (nearly) nothing of it: the bend keeps its direction in the
// sheet and its magnitude. With `signed`, the first row also keeps its side of the triangle, as in bending.h.
//
// Source: Morley 1971, "The constant-moment plate-bending element", J. Strain Analysis 6(1); slopes from a patch of
// triangles after Oñate and Flores 2005, CMAME 194, 2406-2443, where they are not the same on both sides.
#include "pliant/constraints/bending.h"

namespace pliant {

struct TriangleBending {
  static constexpr ConstraintInfo info{"triangle_bending", "∇²x of a triangle and its neighbors, 3 rows",
                                       "the vectors of length ‖z_g‖", "½ κ A Σ (‖z‖ − ‖z_g‖)²",
                                       "Morley 1971; Oñate and Flores 2005"};

  /// Vertices whose triangles resist bending, as if there were no others; default: all.
  Selection on{};
  /// Triangles, in place of those of the mesh.
  Stencils stencils{};
  /// κ of the sheet [N·m], > 0; cotton about 1e-5, sheet metal 1 and more. Doubling it costs no time.
  Values stiffness = 1e-3;
  /// Whether a dent costs as much as a bump.
  Orientation orientation = Orientation::absolute;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose triangles resist bending, as if there were no others"}, self.on);
    field(OptionInfo{"stencils", "", "triangles, in place of those of the mesh"}, self.stencils);
    field(OptionInfo{"stiffness", "N·m", "κ of the sheet; cotton about 1e-5, sheet metal 1 and more", positive},
          self.stiffness);
    field(OptionInfo{"orientation", "", "`absolute`: a dent costs as much as a bump; `signed`: it costs more"},
          self.orientation);
  }
};

/// Batches by the number of vertices, flat and curved. Throws Error(input) on an index out of range, a triangle that
/// has no area, lists of the wrong length.
ConstraintSet build(const BodyView& body, const TriangleBending& options);

}  // namespace pliant
