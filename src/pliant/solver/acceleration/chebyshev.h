#pragma once
// The global step with momentum: Chebyshev semi-iteration of q → q + x(q) (Wang 2015), begun anew whenever it has
// raised the objective. The matrix Y is never softer than the objective, so errors shrink by factors of 0 to ρ in a
// plain iteration, not of −ρ to ρ: the polynomial is that of this interval, half as long, with a relaxation of 2/(2 −
// ρ).
//
// ρ is found while it runs: a rise tells that it was taken too large, moves without one let it grow again. An iteration
// needs no vector but the last iterate.
#include <vector>

#include "pliant/solver/acceleration/accelerator.h"

namespace pliant {

class Chebyshev final : public Accelerator {
 public:
  void begin(Index vertex_count) override;
  void forget() override;
  void scale_move(Real share, Positions& q) override;
  void note_rise() override;
  void move_plainly(const Positions& x, Real curvature, Positions& q) override;
  void shorten(Real share, const Positions& x, Positions& q) override;
  void prepare(const LocalResult& local, const Positions& r, const Positions& x, ThreadPool& threads) override;
  void move(const Positions& x, Real curvature, Positions& q, ThreadPool& threads) override;

 private:
  Real slope() const override { return is_plain_ ? length_ * descent_ : 0; }

  Real gap_ = 0;     // 1 − ρ
  Real omega_ = 1;   // of the last move
  Index moves_ = 0;  // with momentum since the last rise
  std::vector<Real> chunk_sums_;
};

}  // namespace pliant
