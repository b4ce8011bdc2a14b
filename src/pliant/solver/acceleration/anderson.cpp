#include "pliant/solver/acceleration/anderson.h"

#include <cmath>

namespace pliant {

void Anderson::begin(Index vertex_count) {
  if (positions_before_.rows() != vertex_count) {
    memory_ = vertex_count < large ? memory : memory_of_large;
    for (std::size_t i = 0; i < memory_; ++i) changes_[i].resize(3 * at(vertex_count));
    for (std::size_t i = 0; i <= memory_; ++i) moves_[i].resize(3 * at(vertex_count));
    chunk_sums_.resize(at(remembered::chunk_count(vertex_count)));
    last_solution_.resize(vertex_count, 3);
    positions_before_.resize(vertex_count, 3);  // last: its size says that all have theirs
  }
  forget();
  is_plain_ = true;
}

void Anderson::forget() {
  count_ = 0;
  has_moved_ = false;
}

void Anderson::scale_move(Real share, Positions& q) {
  q = positions_before_ + share * (q - positions_before_);
  const remembered::Kept factor = static_cast<remembered::Kept>(share);
  for (remembered::Kept& each : moves_[count_]) each *= factor;
}

void Anderson::move_plainly(const Positions& x, Real curvature, Positions& q) {
  count_ = 0;
  is_plain_ = true;
  length_ = 1;
  shorten(plain_length(curvature), x, q);
}

void Anderson::shorten(Real share, const Positions& x, Positions& q) {
  length_ *= share;
  q = positions_before_ + length_ * x;
  if (!has_moved_) return;
  const Real length = length_;
  std::transform(x.data(), x.data() + x.size(), moves_[0].begin(),
                 [length](Real each) { return static_cast<remembered::Kept>(length * each); });
}

void Anderson::prepare(const LocalResult& local, const Positions& r, const Positions& x, ThreadPool& threads) {
  if (has_moved_ && count_ == memory_) forget_oldest();
  const Sums now = products(r, x, threads);
  descent_ = now.descent;
  if (has_moved_) products_[count_++] = now.with_newest;
  has_moved_ = false;
  if (!find_shares(now.with_solution)) count_ = 0;
  is_plain_ = count_ == 0;
  local_before_ = local;
}

/// Makes the last move and its solution a pair of move and difference besides.
Anderson::Sums Anderson::products(const Positions& r, const Positions& x, ThreadPool& threads) {
  const std::size_t newest = count_;
  const std::size_t count = has_moved_ ? count_ + 1 : count_;
  remembered::for_each_chunk(static_cast<Index>(r.rows()), threads,
                             [&](std::size_t chunk, std::size_t first, std::size_t size) {
                               Sums& sums = chunk_sums_[chunk];
                               const Real* const solution = x.data() + first;
                               Real* const last = last_solution_.data() + first;
                               remembered::ChunkOfVectors<memory> differences;
                               for (std::size_t i = 0; i < count; ++i) differences.add(changes_[i], first);
                               if (has_moved_) {
                                 remembered::ChunkSum change;
                                 remembered::Kept* const kept = changes_[newest].data() + first;
                                 remembered::Kept* const move = moves_[newest].data() + first;
                                 for (std::size_t k = 0; k < size; ++k) {
                                   change[k] = solution[k] - last[k];
                                   kept[k] = static_cast<remembered::Kept>(change[k]);
                                   move[k] += kept[k];
                                 }
                                 differences.multiply(change.data(), size, sums.with_newest.data());
                               }
                               differences.multiply(solution, size, sums.with_solution.data());
                               sums.descent = remembered::dot(solution, r.data() + first, size);
                               std::copy_n(solution, size, last);
                             });
  Sums total;
  for (const Sums& sums : chunk_sums_) {
    for (std::size_t i = 0; i < count; ++i) total.with_newest[i] += has_moved_ ? sums.with_newest[i] : 0;
    for (std::size_t i = 0; i < count; ++i) total.with_solution[i] += sums.with_solution[i];
    total.descent += sums.descent;
  }
  return total;
}

/// The least squares by their normal equations, scaled to a diagonal of 1 and solved by Cholesky's method. A difference
/// that says next to nothing beyond the older ones has no share. False where numbers are not finite.
bool Anderson::find_shares(const Numbers& with_solution) {
  constexpr Real least_pivot = 1e-10;  // single precision knows no less
  std::array<Numbers, memory> factor = {};
  Numbers scales = {};
  Numbers unknowns = {};
  for (std::size_t i = 0; i < count_; ++i) {
    const Real square = products_[i][i];
    if (!std::isfinite(square) || !std::isfinite(with_solution[i])) return false;
    scales[i] = square > 0 ? 1 / std::sqrt(square) : 0;
    unknowns[i] = scales[i] * with_solution[i];
    for (std::size_t j = 0; j < i; ++j) {
      factor[i][j] = scales[i] * scales[j] * products_[i][j];
      for (std::size_t k = 0; k < j; ++k) factor[i][j] -= factor[i][k] * factor[j][k];
      factor[i][j] *= factor[j][j];
      unknowns[i] -= factor[i][j] * unknowns[j];
    }
    Real pivot = square > 0 ? 1 : 0;
    for (std::size_t j = 0; j < i; ++j) pivot -= factor[i][j] * factor[i][j];
    factor[i][i] = pivot > least_pivot ? 1 / std::sqrt(pivot) : 0;  // one over Cholesky's
    unknowns[i] *= factor[i][i];
  }
  for (std::size_t i = count_; i-- > 0;) {
    for (std::size_t j = i + 1; j < count_; ++j) unknowns[i] -= factor[j][i] * unknowns[j];
    unknowns[i] *= factor[i][i];
    shares_[i] = -scales[i] * unknowns[i];
  }
  return true;
}

void Anderson::move(const Positions& x, Real curvature, Positions& q, ThreadPool& threads) {
  length_ = is_plain_ ? plain_length(curvature) : 1;
  remembered::for_each_chunk(static_cast<Index>(q.rows()), threads,
                             [&](std::size_t, std::size_t first, std::size_t size) {
                               remembered::ChunkOfVectors<memory + 1> all;
                               for (std::size_t i = 0; i < count_; ++i) all.add(moves_[i], first, shares_[i]);
                               all.move({.factor = length_,
                                         .x = x.data() + first,
                                         .q = q.data() + first,
                                         .before = positions_before_.data() + first,
                                         .move = moves_[count_].data() + first},
                                        size);
                             });
  has_moved_ = true;
}

void Anderson::forget_oldest() {
  remembered::drop_first(changes_, memory_);
  remembered::drop_first(moves_, memory_ + 1);
  for (Numbers& line : products_) remembered::drop_first(line, memory_);
  remembered::drop_first(products_, memory_);
  --count_;
}

}  // namespace pliant
