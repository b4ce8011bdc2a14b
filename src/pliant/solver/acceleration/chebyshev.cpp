#include "pliant/solver/acceleration/chebyshev.h"

#include <algorithm>

#include "pliant/solver/acceleration/remembered.h"

namespace pliant {
namespace {

// Gaps 1 − ρ: the first one suits cloth, and three rises lead from it to what a stiff solid has.
constexpr Real first_gap = 0.003;
constexpr Real least_gap = 0.0003;
constexpr Real most_gap = 0.5;
constexpr Real wider = 3;
constexpr Real narrower = 0.75;
constexpr Index moves_until_narrower = 5;

}  // namespace

void Chebyshev::begin(Index vertex_count) {
  if (positions_before_.rows() != vertex_count) {
    chunk_sums_.resize(at(remembered::chunk_count(vertex_count)));
    positions_before_.resize(vertex_count, 3);
  }
  forget();
  is_plain_ = true;
  gap_ = first_gap;
  moves_ = 0;
}

void Chebyshev::forget() {
  has_moved_ = false;
  omega_ = 1;
}

void Chebyshev::scale_move(Real share, Positions& q) {
  q = positions_before_ + share * (q - positions_before_);
}

void Chebyshev::note_rise() {
  gap_ = std::min(most_gap, wider * gap_);
  moves_ = 0;
}

void Chebyshev::move_plainly(const Positions& x, Real curvature, Positions& q) {
  omega_ = 1;
  is_plain_ = true;
  length_ = 1;
  shorten(plain_length(curvature), x, q);
}

void Chebyshev::shorten(Real share, const Positions& x, Positions& q) {
  length_ *= share;
  q = positions_before_ + length_ * x;
}

void Chebyshev::prepare(const LocalResult& local, const Positions& r, const Positions& x, ThreadPool& threads) {
  remembered::for_each_chunk(static_cast<Index>(r.rows()), threads,
                             [&](std::size_t chunk, std::size_t first, std::size_t size) {
                               chunk_sums_[chunk] = remembered::dot(x.data() + first, r.data() + first, size);
                             });
  descent_ = 0;
  for (const Real sum : chunk_sums_) descent_ += sum;
  is_plain_ = !has_moved_;
  local_before_ = local;
}

void Chebyshev::move(const Positions& x, Real curvature, Positions& q, ThreadPool& threads) {
  Real of_solution = 1;
  Real of_last = 0;
  if (is_plain_) {
    of_solution = length_ = plain_length(curvature);
    omega_ = 1;
  } else {
    if (++moves_ % moves_until_narrower == 0) gap_ = std::max(least_gap, narrower * gap_);
    const Real rho = (1 - gap_) / (1 + gap_);  // of the interval that the relaxation makes of 0 to 1 − gap
    omega_ = omega_ == 1 ? 2 / (2 - rho * rho) : 4 / (4 - rho * rho * omega_);
    of_solution = omega_ * 2 / (1 + gap_);
    of_last = omega_ - 1;
  }
  remembered::for_each_chunk(static_cast<Index>(q.rows()), threads,
                             [&](std::size_t, std::size_t first, std::size_t size) {
                               const Real* const solution = x.data() + first;
                               Real* const moved = q.data() + first;
                               Real* const before = positions_before_.data() + first;
                               for (std::size_t k = 0; k < size; ++k) {
                                 const Real last = of_last == 0 ? 0 : of_last * (moved[k] - before[k]);
                                 before[k] = moved[k];
                                 moved[k] += of_solution * solution[k] + last;
                               }
                             });
  has_moved_ = true;
}

}  // namespace pliant
