#pragma once
// What makes more of a global solve than the plain next iterate. It makes the moves of a step, and remembers of the
// last one what is needed to judge it, to take it back and to make it shorter. The first move of a step is the plain
// one.
#include "pliant/core/thread_pool.h"
#include "pliant/solver/local/local_step.h"

namespace pliant {

class Accelerator {
 public:
  Accelerator() = default;
  Accelerator(const Accelerator&) = default;
  Accelerator(Accelerator&&) = default;
  Accelerator& operator=(const Accelerator&) = default;
  Accelerator& operator=(Accelerator&&) = default;
  virtual ~Accelerator() = default;

  /// Forgets all moves: the objective of a new step is another. Allocates when the number of vertices has changed.
  virtual void begin(Index vertex_count) = 0;
  /// Forgets all moves in the middle of a step, the last one as well: it did not end where it led.
  virtual void forget() = 0;
  /// Whether the last move has raised the objective, by more than rounding does, or it is NaN.
  bool has_risen(const LocalResult& now) const;
  /// Of the last move, which led to `now`: the minimum of the parabola through both objectives and the slope at first;
  /// 0 where the slope is not known.
  Real best_share(const LocalResult& now) const;
  /// Makes the last move, which led to q, `share` times as long; it is no plain one.
  virtual void scale_move(Real share, Positions& q) = 0;
  /// The last move, no plain one, has raised the objective.
  virtual void note_rise() {}
  /// Takes the last move back, makes the plain one in its place, with the x that it was made from, and forgets the
  /// moves before.
  virtual void move_plainly(const Positions& x, Real curvature, Positions& q) = 0;
  /// Makes the plain move `share` times as long.
  virtual void shorten(Real share, const Positions& x, Positions& q) = 0;
  /// The next move, from what the local step found: its r [N] and x = B⁻¹ r [m] with the matrix B that was
  /// factorized.
  virtual void prepare(const LocalResult& local, const Positions& r, const Positions& x, ThreadPool& threads) = 0;
  /// Moves q, as was prepared. A plain move is q ← q + α x, α = xᵀr / (xᵀr + c): the minimum of a quadratic objective
  /// with the matrix B + C and c = xᵀ C x, `curvature` [N m].
  virtual void move(const Positions& x, Real curvature, Positions& q, ThreadPool& threads) = 0;
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

 protected:
  /// By how much the objective falls along the last move, at its beginning [N m]; 0: not known.
  virtual Real slope() const = 0;

  bool has_moved_ = false;  // and has not forgotten it
  bool is_plain_ = true;
  Real descent_ = 0;  // xᵀr of the last solution [N m]
  Real length_ = 1;   // α of the last plain move
  LocalResult local_before_;
  Positions positions_before_;
};

}  // namespace pliant
