#pragma once
// Edge as a fibre with a limited stretch, for ropes and for cloth.
//
//     x₀ ●────L────● x₁        z = (x₁ − x₀)/L        p = z/‖z‖ · clamp(‖z‖, min, max)        E = w/2 ‖z − p‖²
//
//     rope:   w = EA · L, EA [N]: its stretch does not depend on the number of links
//     cloth:  w = k a, k [N/m], a a third of the area of the adjacent triangles
//
// Source: Bouaziz et al. 2014, Sec. 5.1 in one dimension. With min = max = 1 it is a spring of constant EA/L; with
// min = 0 a rope that carries no pressure. Cloth made with EA would halve its sag at each refinement: use `cloth`.
#include <cmath>

#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

enum class FibreMeasure { rope, cloth };
constexpr std::array<std::string_view, 2> choice_names(FibreMeasure) {
  return {"rope", "cloth"};
}

struct EdgeStrain {
  static constexpr ConstraintInfo info{"edge_strain", "(x₁ − x₀)/L", "the vectors of length min to max",
                                       "½ w (‖z‖ − 1)², w = EA·L or k·a", "Bouaziz et al. 2014, Sec. 5.1"};

  /// Vertices whose edges become fibres; default: all.
  Selection on{};
  /// Pairs of vertices, in place of the edges of the mesh.
  Stencils stencils{};
  /// What the weight of a fibre grows with: its length, or the area beside it.
  FibreMeasure measure = FibreMeasure::rope;
  /// `rope`: EA [N]; `cloth`: k [N/m]; > 0.
  Values stiffness = 1e3;
  /// L [m], > 0; default: the length at rest.
  Values rest_length{};
  /// Shortest length over rest length, 0 to max_stretch; 0: no pressure.
  Values min_stretch = 1;
  /// Longest length over rest length, from min_stretch.
  Values max_stretch = 1;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose edges become fibres"}, self.on);
    field(OptionInfo{"stencils", "", "pairs of vertices, in place of the edges of the mesh"}, self.stencils);
    field(OptionInfo{"measure", "", "`rope`: weight EA·L; `cloth`: weight k·a, a a third of the adjacent area"},
          self.measure);
    field(OptionInfo{"stiffness", "N or N/m", "rope: EA [N]; cloth: k [N/m]", positive}, self.stiffness);
    field(OptionInfo{"rest_length", "m", "default: the length at rest", positive}, self.rest_length);
    field(OptionInfo{"min_stretch", "", "shortest length over rest length; 0: no pressure", not_negative},
          self.min_stretch);
    field(OptionInfo{"max_stretch", "", "longest length over rest length", not_negative}, self.max_stretch);
  }
};

struct EdgeStrainProjection {
  static constexpr std::string_view name = "edge_strain";
  static constexpr int vertices = 2;
  static constexpr int rows = 1;
  static constexpr int fields = 2;  // min, max
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr bool limits_stretches = true;
  static constexpr auto kernel = &LocalKernels::edge_strain;
  static void project(const Real* field, const Real* z, Real* p) {
    const Real stretch = std::sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    const Real wanted = std::clamp(stretch, field[0], field[1]);
    const Real scale = wanted / stretch;
    const bool defined = stretch > 0;
    p[0] = defined ? scale * z[0] : wanted;
    p[1] = defined ? scale * z[1] : 0;
    p[2] = defined ? scale * z[2] : 0;
  }
};

/// Throws Error(input) on an edge of rest length zero, `cloth` on an edge without triangles, min above max, an index
/// out of range, lists of the wrong length.
ConstraintSet build(const BodyView& body, const EdgeStrain& options);

}  // namespace pliant
