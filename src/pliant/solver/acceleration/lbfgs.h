#pragma once
// The global step with the memory of earlier ones: L-BFGS (Nocedal and Wright 2006, Algorithm 7.4), whose first guess
// of the inverse Hessian is the factor of Y (Liu, Bouaziz and Kavan 2017, Sec. 4.1). The first move of a step is the
// plain one.
//
// With r = −∇E and x = Y⁻¹ r, a pair is a move s and y = r − r', and Y⁻¹ y = x − x' stands in what was solved already.
// So the two loops need no vectors but the moves and the solutions: one pass over memory takes their scalar products
// with the new r, the loops are arithmetic of a few numbers, and a second pass adds up the move.
#include <array>
#include <vector>

#include "pliant/solver/acceleration/accelerator.h"
#include "pliant/solver/acceleration/remembered.h"

namespace pliant {

class Lbfgs final : public Accelerator {
 public:
  /// Pairs that are remembered; fewer from so many vertices on, where they outgrow the second-level cache.
  static constexpr std::size_t memory = 10;
  static constexpr std::size_t memory_of_large = 6;
  static constexpr Index large = 4096;

  void begin(Index vertex_count) override;
  void forget() override;
  void scale_move(Real share, Positions& q) override;
  void move_plainly(const Positions& x, Real curvature, Positions& q) override;
  void shorten(Real share, const Positions& x, Positions& q) override;
  void prepare(const LocalResult& local, const Positions& r, const Positions& x, ThreadPool& threads) override;
  /// q ← q + H r, or plainly.
  void move(const Positions& x, Real curvature, Positions& q, ThreadPool& threads) override;

 private:
  static constexpr std::size_t most_vectors = memory + 1;
  using Vector = remembered::Vector;

  /// A number for each vector: its scalar product with a residual, or its coefficient in a move.
  struct Numbers {
    std::array<Real, most_vectors> moves = {};
    std::array<Real, most_vectors> solutions = {};
  };
  using Table = std::array<std::array<Real, memory>, memory>;

  Real slope() const override { return last_.moves[pair_count_]; }
  Numbers products(const Positions& r, const Positions& x, ThreadPool& threads);
  void complete_pair(Numbers& now);
  Numbers coefficients(const Numbers& products) const;
  void add_up(const Numbers& coefficients, const Positions& x, Positions& q, ThreadPool& threads);
  /// Forgets everything but the newest solution, which becomes the first.
  void forget_pairs(Numbers& products);
  void forget_oldest_pair();
  std::size_t last_solution() const { return pair_count_ + (has_moved_ ? 1 : 0); }

  // Oldest first: pair i is move i, and solution i less solution i + 1. After a move there is one of each besides,
  // whose pair is complete as soon as the next residual and its solution are known.
  std::size_t memory_ = memory;
  std::size_t pair_count_ = 0;
  std::array<Vector, most_vectors> moves_;      // 3 m numbers each [m]
  std::array<Vector, most_vectors> solutions_;  // the same
  Numbers last_;                                // products with the last residual
  Numbers factors_;                             // of the vectors in the next move
  Table move_products_ = {};                    // sᵢᵀ yⱼ, j ≥ i
  Table solution_products_ = {};                // yᵢᵀ Y⁻¹ yⱼ, j ≥ i

  std::vector<Numbers> chunk_products_;
};

}  // namespace pliant
