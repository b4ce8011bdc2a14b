#pragma once
// Where the iterations of a step begin when `start` is `adaptive`.
//
//     s⁰ = a + η b         without forces          d = s − s⁰       what forces alone do
//     c = η² (vₙ − vₙ₋₁)/h  what the last step's acceleration does
//     q⁰ = s⁰ + t d,  t = Σ m d·c / Σ m ‖d‖², between 0 and 1, of each component
//
// What falls freely begins at s, t = 1. What hangs, lies or sails on evenly has forces in balance, t = 0: it begins
// where the last step has converged to, so convergence goes on from step to step in place of being lost to gravity's
// h² g anew. By component, since a guess that differs from vertex to vertex is jagged.
//
// Source: the adaptive initialization of Chen et al. 2024, Vertex Block Descent, where each vertex has a t of its own,
// along gravity.
#include <span>
#include <vector>

#include "pliant/solver/working_state.h"

namespace pliant {

class BalancedGuess {
 public:
  /// Moves q, the guess s with all forces in it, to q⁰. `form` is that of the step to come, whose length is h [s]; the
  /// step before must have been as long (has_history). Pinned vertices neither count nor are moved.
  void move(const WorkingState& work, const IntegratorCoefficients& form, Real h,
            std::span<const Index> component_of_vertex, std::size_t components, std::span<const char> is_pinned,
            Positions& q);

 private:
  struct Sums {
    Real accelerated = 0, forced = 0;  // Σ m d·c, Σ m ‖d‖² [kg m²]
  };
  std::vector<Sums> sums_;  // of each component; kept, so that a step allocates nothing
};

}  // namespace pliant
