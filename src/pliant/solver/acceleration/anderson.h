#pragma once
// The global step with the memory of earlier ones: Anderson acceleration of q → q + x(q) (Peng et al. 2018). What the
// last solutions differ by tells which combination of the last moves would have made x least, ‖x − Σ γᵢ Δxᵢ‖; the next
// iterate is that combination of where the moves led, q + x − Σ γᵢ (sᵢ + Δxᵢ). It is kept where the objective falls;
// else the plain iterate takes its place, see Descent.
//
// Moves and differences are taken apart when they are made: one pass over memory reads the differences, a second one
// adds up the move, so an iteration reads half of what L-BFGS does with as many of them.
#include <array>
#include <vector>

#include "pliant/solver/acceleration/accelerator.h"
#include "pliant/solver/acceleration/remembered.h"

namespace pliant {

class Anderson final : public Accelerator {
 public:
  /// Moves that are remembered; fewer from so many vertices on, where they outgrow the second-level cache.
  static constexpr std::size_t memory = 8;
  static constexpr std::size_t memory_of_large = 5;
  static constexpr Index large = 4096;

  void begin(Index vertex_count) override;
  void forget() override;
  void scale_move(Real share, Positions& q) override;
  void move_plainly(const Positions& x, Real curvature, Positions& q) override;
  void shorten(Real share, const Positions& x, Positions& q) override;
  void prepare(const LocalResult& local, const Positions& r, const Positions& x, ThreadPool& threads) override;
  void move(const Positions& x, Real curvature, Positions& q, ThreadPool& threads) override;

 private:
  using Numbers = std::array<Real, memory>;
  struct Sums {
    Numbers with_newest = {};    // Δxᵢ·Δx of the newest difference
    Numbers with_solution = {};  // Δxᵢ·x
    Real descent = 0;            // xᵀr
  };

  Real slope() const override { return is_plain_ ? length_ * descent_ : 0; }
  Sums products(const Positions& r, const Positions& x, ThreadPool& threads);
  bool find_shares(const Numbers& with_solution);
  void forget_oldest();

  std::size_t memory_ = memory;
  std::size_t count_ = 0;                             // of differences, oldest first
  std::array<remembered::Vector, memory> changes_;    // Δx [m]
  std::array<remembered::Vector, memory + 1> moves_;  // s + Δx; the last move, whose Δx is yet to come, is behind [m]
  std::array<Numbers, memory> products_ = {};         // Δxᵢ·Δxⱼ, j ≤ i
  Numbers shares_ = {};                               // −γ
  Positions last_solution_;
  std::vector<Sums> chunk_sums_;
};

}  // namespace pliant
