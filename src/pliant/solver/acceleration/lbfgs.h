#pragma once
// The global step with the memory of earlier ones: L-BFGS (Nocedal and Wright 2006, Algorithm 7.4), whose first guess
// of the inverse Hessian is the factor of Y (Liu, Bouaziz and Kavan 2017, Sec. 4.1). The first move of a step is the
// plain one.
//
// With r = −∇E and x = Y⁻¹ r, a pair is a move s and y = r − r', and Y⁻¹ y = x − x' stands in what was solved already.
// So the two loops need no vectors but the moves and the solutions: one pass over memory takes their scalar products
// with the new r, the loops are arithmetic of a few numbers, and a second pass adds up the move. The vectors are kept
// in single precision: they steer where the iteration goes, not what it ends in.
#include <array>
#include <vector>

#include "pliant/core/aligned.h"
#include "pliant/core/thread_pool.h"
#include "pliant/solver/local/local_step.h"

namespace pliant {

class Lbfgs {
 public:
  /// Pairs that are remembered; fewer from so many vertices on, where they outgrow the second-level cache.
  static constexpr std::size_t memory = 10;
  static constexpr std::size_t memory_of_large = 6;
  static constexpr Index large = 4096;

  /// Forgets all pairs: the objective of a new step is another. Allocates when the number of vertices has changed.
  void begin(Index vertex_count);

  /// Forgets all pairs in the middle of a step, and that the last move makes one: it did not end where it led.
  void forget();
  /// Whether the last move has raised the objective, by more than rounding does, or it is NaN.
  bool has_risen(const LocalResult& now) const;
  /// Of the last move, which led to `now`: the minimum of the parabola through both objectives and the slope at first.
  Real best_share(const LocalResult& now) const;
  /// Makes the last move, which led to q, `share` times as long; it is no plain one.
  void scale_move(Real share, Positions& q);
  /// Takes the last move back, makes the plain one in its place, with the x that it was made from, and forgets the
  /// pairs.
  void move_plainly(const Positions& x, Real curvature, Positions& q);
  /// Makes the plain move `share` times as long.
  void shorten(Real share, const Positions& x, Positions& q);
  /// The next move, from what the local step found: its r [N] and x = B⁻¹ r [m] with the matrix B that was
  /// factorized.
  void prepare(const LocalResult& local, const Positions& r, const Positions& x, ThreadPool& threads);
  /// q ← q + H r, as was prepared. A plain move is q ← q + α x, α = xᵀr / (xᵀr + c): the minimum of a quadratic
  /// objective with the matrix B + C and c = xᵀ C x, `curvature` [N m].
  void move(const Positions& x, Real curvature, Positions& q, ThreadPool& threads);
  /// α of a plain move from where the next one was prepared.
  Real plain_length(Real curvature) const {
    const Real resistance = descent_ + curvature;
    return descent_ > 0 && resistance > 0 ? descent_ / resistance : 1;
  }
  /// Of the move that was prepared or made last.
  bool is_plain() const { return is_plain_; }
  /// From where the last move went, and what the local step found there.
  const Positions& positions_before() const { return positions_before_; }
  const LocalResult& local_before() const { return local_before_; }

 private:
  static constexpr std::size_t most_vectors = memory + 1;
  using Kept = float;
  using Vector = AlignedVector<Kept>;

  /// A number for each vector: its scalar product with a residual, or its coefficient in a move.
  struct Numbers {
    std::array<Real, most_vectors> moves = {};
    std::array<Real, most_vectors> solutions = {};
  };
  using Table = std::array<std::array<Real, memory>, memory>;

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
  bool has_moved_ = false;
  bool is_plain_ = true;
  std::array<Vector, most_vectors> moves_;      // 3 m numbers each [m]
  std::array<Vector, most_vectors> solutions_;  // the same
  Numbers last_;                                // products with the last residual
  Numbers factors_;                             // of the vectors in the next move
  Table move_products_ = {};                    // sᵢᵀ yⱼ, j ≥ i
  Table solution_products_ = {};                // yᵢᵀ Y⁻¹ yⱼ, j ≥ i

  Real descent_ = 0;          // xᵀr of the last solution [N m]
  Real length_ = 1;           // α of the last plain move
  LocalResult local_before_;  // found just before the last move
  Positions positions_before_;
  std::vector<Numbers> chunk_products_;
};

}  // namespace pliant
