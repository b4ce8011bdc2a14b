#pragma once
// Edge as a spring of constant k: two vertices keep their distance.
//
//     x₀ ●────L────● x₁        z = x₁ − x₀        p = L z/‖z‖        E = k/2 (‖z‖ − L)²
//
// Source: thesis Sec. 4.4.3, whose A = ½[[1,−1],[−1,1]] (Eq. 4.3) gives the same energy and the same iteration with
// w = 2k. At ‖z‖ = 0 every direction is equally near; the x axis is taken.
//
// With `reduction: identity` both vertices are projected by themselves: z = (x₀, x₁), p their midpoint ∓ L/2 along the
// edge, of weight 2k. That is the same energy, and the same converged step; but p holds the midpoint of the last
// iterate, so that changes spread only slowly (thesis Sec. 4.4.3). It is there for comparison.
#include <cmath>

#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

enum class EdgeReduction { difference, identity };
constexpr std::array<std::string_view, 2> choice_names(EdgeReduction) {
  return {"difference", "identity"};
}

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
  /// What A takes of the two vertices; with `identity` changes spread only slowly.
  EdgeReduction reduction = EdgeReduction::difference;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose edges become springs"}, self.on);
    field(OptionInfo{"stencils", "", "pairs of vertices, in place of the edges of the mesh"}, self.stencils);
    field(OptionInfo{"stiffness", "N/m", "of each spring; doubling it halves the stretch and costs no time", positive},
          self.stiffness);
    field(OptionInfo{"rest_length", "m", "default: the length at rest", positive}, self.rest_length);
    field(OptionInfo{"reduction", "", "`difference`: x₁ − x₀; `identity`: (x₀, x₁), which spreads changes slowly"},
          self.reduction);
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

struct EdgeEndsProjection {
  static constexpr std::string_view name = "edge_ends";
  static constexpr int vertices = 2;
  static constexpr int rows = 2;
  static constexpr int fields = 1;  // L
  static constexpr bool translation_invariant = false;
  static constexpr bool rotation_invariant = true;
  static void project(const Real* field, const Real* z, Real* p) {
    std::array<Real, 3> edge, target;
    for (std::size_t axis = 0; axis < 3; ++axis) edge[axis] = z[3 + axis] - z[axis];
    EdgeSpringProjection::project(field, edge.data(), target.data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Real off = (target[axis] - edge[axis]) / 2;
      p[axis] = z[axis] - off;
      p[3 + axis] = z[3 + axis] + off;
    }
  }
};

/// Throws Error(input) on an edge of rest length zero, an index out of range, lists of the wrong length.
ConstraintSet build(const BodyView& body, const EdgeSpring& options);

}  // namespace pliant
