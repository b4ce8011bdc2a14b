#pragma once
// XPBD (Macklin, Müller and Chentanez 2016) on the constraints of a simulation, for contrast: Gauss-Seidel over all
// constraints, one after the other in the order of the mesh, nothing is factorized.
//
// A constraint with the energy w/2 ‖z − p‖², z = A S q, has the function C = ‖z − p‖, whose gradient is Aᵀ (z − p)/C,
// and the compliance α = 1/w. With α̃ = α/h² each sweep changes its multiplier λ and the vertices by
//
//     Δλ = −(C + α̃ λ) / (∇C M⁻¹ ∇Cᵀ + α̃)        q ← q + M⁻¹ ∇Cᵀ Δλ
//
// from q = s and λ = 0 on. What this converges to has C = −α̃ λ, as the step of implicit Euler has, but not M (q − s) =
// ∇Cᵀ λ: the parts of λ were applied along the gradients of their time, which have turned since. With a multiplier for
// each number of z − p, whose gradient A is constant, both hold, and it is that very step:
//
//     Δλ = −(A M⁻¹ Aᵀ + α̃)⁻¹ (z − p + α̃ λ)        q ← q + M⁻¹ Aᵀ Δλ
#include <memory>
#include <vector>

#include "pliant/simulation/simulation.h"

namespace pliant_bench {

enum class Multipliers {
  one,      ///< a constraint, as published
  each_row  ///< a vector for each row of z
};

/// A row of z in each row; stored as constraints write it.
template <int rows>
using ZRows = Eigen::Matrix<double, rows, 3, Eigen::RowMajor>;

class Xpbd {
 public:
  /// Takes over masses, constraints, forces and the state; hard pins are infinite masses. Throws Error(input) unless it
  /// takes(simulation).
  Xpbd(const pliant::Simulation& simulation, Multipliers multipliers);
  /// Whether its steps are of implicit Euler, without contact and without constraints that have no projection or more
  /// than three rows.
  static bool takes(const pliant::Simulation& simulation);

  /// q = s and λ = 0, of a step of implicit Euler from the state that was taken over.
  void begin_step();
  /// Goes through all constraints once. Does not allocate.
  void sweep();

  const pliant::Positions& positions() const { return positions_; }  ///< m × 3 [m]

 private:
  /// Constraints of one kind, and what a sweep reads of them.
  struct Block {
    std::unique_ptr<pliant::ConstraintGroup> group;
    int rows = 1;
    std::size_t vertices = 1;  // of a stencil
    bool is_linear = false;
    const pliant::Index* stencil = nullptr;
    const double* reduction = nullptr;
    std::vector<double> inverse_weights;  // 1/w
    std::vector<double> multipliers;      // one, or three for each row, a constraint
    std::vector<double> inverses;         // of A M⁻¹ Aᵀ + α̃, rows × rows a constraint
  };

  void add_group(const pliant::ConstraintGroup& group);
  void invert(Block& block) const;
  template <int rows>
  void sweep_over(Block& block);
  /// p − z of constraint i.
  template <int rows>
  ZRows<rows> pull_of(const Block& block, std::size_t i) const;
  template <int rows>
  void correct_along_gradient(Block& block, std::size_t i);
  template <int rows>
  void correct_rows(Block& block, std::size_t i);

  Multipliers kind_;
  double time_step_;         // h [s]
  double per_step_squared_;  // 1/h²
  pliant::State start_;
  std::vector<double> inverse_masses_;  // [1/kg], 0 for pinned vertices
  pliant::Positions prediction_, positions_;
  std::vector<Block> blocks_;
  pliant::Positions gradient_;  // of one constraint
};

}  // namespace pliant_bench
