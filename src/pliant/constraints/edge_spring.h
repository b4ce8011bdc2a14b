#pragma once
// Edge as a spring of constant k: two vertices keep their distance.
//
//     x₀ ●────L────● x₁        z = x₁ − x₀        p = L z/‖z‖        E = k/2 (‖z‖ − L)²
//
// Source: thesis Sec. 4.4.3, whose A = ½[[1,−1],[−1,1]] (Eq. 4.3) gives the same energy and the same iteration with
// w = 2k. At ‖z‖ = 0 every direction is equally near; the x axis is taken.
#include <cmath>

#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

struct EdgeSpring {
  static constexpr ConstraintInfo info{"edge_spring", "x₁ − x₀", "the vectors of length L", "½ k (‖x₁ − x₀‖ − L)²",
                                       "thesis Sec. 4.4.3 (w = 2k)"};

  /// Vertices whose edges become springs; default: all.
  Selection on{};
  /// Pairs of vertices, in place of the edges of the mesh.
  Stencils stencils{};
  /// k of each spring [N/m], > 0; doubling it halves the stretch and costs no time.
  Values stiffness = 1e4;
  /// L [m], > 0; default: the length at rest.
  Values rest_length{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose edges become springs"}, self.on);
    field(OptionInfo{"stencils", "", "pairs of vertices, in place of the edges of the mesh"}, self.stencils);
    field(OptionInfo{"stiffness", "N/m", "of each spring; doubling it halves the stretch and costs no time", positive},
          self.stiffness);
    field(OptionInfo{"rest_length", "m", "default: the length at rest", positive}, self.rest_length);
  }
};

struct EdgeSpringProjection {
  static constexpr std::string_view name = "edge_spring";
  static constexpr int vertices = 2;
  static constexpr int rows = 1;
  static constexpr int fields = 1;  // L
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr bool is_difference = true;
  static constexpr auto kernel = &LocalKernels::edge_spring;
  static void project(const Real* field, const Real* z, Real* p) {
    const Real length = std::sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    const Real scale = field[0] / length;
    const bool defined = length > 0;
    p[0] = defined ? scale * z[0] : field[0];
    p[1] = defined ? scale * z[1] : 0;
    p[2] = defined ? scale * z[2] : 0;
  }
};

/// Throws Error(input) on an edge of rest length zero, an index out of range, lists of the wrong length.
ConstraintSet build(const BodyView& body, const EdgeSpring& options);

}  // namespace pliant
