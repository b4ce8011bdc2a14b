#include "pliant/solver/acceleration/lbfgs.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pliant {

namespace {

template <class Numbers>
Real sum_of_products(const Numbers& a, const Numbers& b) {
  return std::inner_product(a.moves.begin(), a.moves.end(), b.moves.begin(), Real{0}) +
         std::inner_product(a.solutions.begin(), a.solutions.end(), b.solutions.begin(), Real{0});
}

}  // namespace

void Lbfgs::begin(Index vertex_count) {
  if (positions_before_.rows() != vertex_count) {
    memory_ = vertex_count < large ? memory : memory_of_large;
    for (std::size_t i = 0; i <= memory_; ++i) moves_[i].resize(3 * at(vertex_count));
    for (std::size_t i = 0; i <= memory_; ++i) solutions_[i].resize(3 * at(vertex_count));
    chunk_products_.resize(at(remembered::chunk_count(vertex_count)));
    positions_before_.resize(vertex_count, 3);  // last: its size says that all have theirs
  }
  pair_count_ = 0;
  has_moved_ = false;
  is_plain_ = true;
}

void Lbfgs::forget() {
  pair_count_ = 0;
  has_moved_ = false;
}

void Lbfgs::scale_move(Real share, Positions& q) {
  q = positions_before_ + share * (q - positions_before_);
  const remembered::Kept factor = static_cast<remembered::Kept>(share);
  for (remembered::Kept& each : moves_[pair_count_]) each *= factor;
  last_.moves[pair_count_] *= share;
}

void Lbfgs::move_plainly(const Positions& x, Real curvature, Positions& q) {
  if (has_moved_) {
    std::swap(solutions_[0], solutions_[pair_count_]);
    last_.solutions[0] = last_.solutions[pair_count_];
    pair_count_ = 0;
  }
  is_plain_ = true;
  length_ = 1;
  shorten(plain_length(curvature), x, q);
}

void Lbfgs::shorten(Real share, const Positions& x, Positions& q) {
  length_ *= share;
  q = positions_before_ + length_ * x;
  if (!has_moved_) return;
  const remembered::Kept factor = static_cast<remembered::Kept>(length_);
  std::ranges::transform(solutions_[0], moves_[0].begin(), [factor](remembered::Kept each) { return factor * each; });
  last_.moves[0] = length_ * last_.solutions[0];
}

void Lbfgs::prepare(const LocalResult& local, const Positions& r, const Positions& x, ThreadPool& threads) {
  Numbers now = products(r, x, threads);
  descent_ = now.solutions[last_solution()];
  if (has_moved_) complete_pair(now);
  has_moved_ = false;
  factors_ = coefficients(now);
  Real descent = sum_of_products(factors_, now);
  if (!(descent > 0)) {
    forget_pairs(now);
    descent = descent_;
  }
  is_plain_ = pair_count_ == 0;
  last_ = now;
  last_.moves[pair_count_] = descent;
  local_before_ = local;
}

void Lbfgs::move(const Positions& x, Real curvature, Positions& q, ThreadPool& threads) {
  if (is_plain_) {
    length_ = plain_length(curvature);
    factors_ = {};
    factors_.solutions[0] = length_;
    last_.moves[0] = length_ * last_.solutions[0];
  }
  add_up(factors_, x, q, threads);
  has_moved_ = true;
  if (pair_count_ == memory_) forget_oldest_pair();
}

/// Keeps the new solution besides.
Lbfgs::Numbers Lbfgs::products(const Positions& r, const Positions& x, ThreadPool& threads) {
  const std::size_t moves = last_solution();
  const std::size_t solutions = last_solution();
  remembered::for_each_chunk(static_cast<Index>(r.rows()), threads,
                             [&](std::size_t chunk, std::size_t first, std::size_t count) {
                               const Real* const solved = x.data() + first;
                               remembered::Kept* const kept = solutions_[solutions].data() + first;
                               for (std::size_t k = 0; k < count; ++k)
                                 kept[k] = static_cast<remembered::Kept>(solved[k]);
                               remembered::ChunkOfVectors<2 * most_vectors> all;
                               for (std::size_t i = 0; i < moves; ++i) all.add(moves_[i], first);
                               for (std::size_t i = 0; i <= solutions; ++i) all.add(solutions_[i], first);
                               std::array<Real, 2 * most_vectors> sums;
                               all.multiply(r.data() + first, count, sums.data());
                               Numbers& products = chunk_products_[chunk];
                               std::copy_n(sums.begin(), moves, products.moves.begin());
                               std::copy_n(sums.begin() + moves, solutions + 1, products.solutions.begin());
                             });
  Numbers total;
  for (const Numbers& sums : chunk_products_) {
    for (std::size_t i = 0; i < moves; ++i) total.moves[i] += sums.moves[i];
    for (std::size_t i = 0; i <= solutions; ++i) total.solutions[i] += sums.solutions[i];
  }
  return total;
}

/// The pair of the last move; without positive curvature along it all pairs are forgotten. Y⁻¹ is taken as symmetric,
/// x'ᵀ r = xᵀ r', which a solve in single precision is nearly; where that misleads, the objective tells.
void Lbfgs::complete_pair(Numbers& now) {
  const std::size_t pair = pair_count_;
  const auto change = [&](std::size_t i) {
    return last_.solutions[i] - last_.solutions[i + 1] - now.solutions[i] + now.solutions[i + 1];
  };
  last_.solutions[pair + 1] = now.solutions[pair];
  for (std::size_t i = 0; i <= pair; ++i) {
    move_products_[i][pair] = last_.moves[i] - now.moves[i];
    solution_products_[i][pair] = change(i);
  }
  if (move_products_[pair][pair] > 0) {
    ++pair_count_;
    has_moved_ = false;
  } else {
    forget_pairs(now);
  }
}

/// The two loops, for scalar products in place of vectors.
Lbfgs::Numbers Lbfgs::coefficients(const Numbers& products) const {
  std::array<Real, memory> alpha = {};
  std::array<Real, memory> gamma = {};  // α − β
  for (std::size_t i = pair_count_; i-- > 0;) {
    Real sum = products.moves[i];
    for (std::size_t j = i + 1; j < pair_count_; ++j) sum -= alpha[j] * move_products_[i][j];
    alpha[i] = sum / move_products_[i][i];
  }
  for (std::size_t i = 0; i < pair_count_; ++i) {
    Real sum = products.solutions[i] - products.solutions[i + 1];
    for (std::size_t j = 0; j < pair_count_; ++j) {
      sum -= alpha[j] * solution_products_[std::min(i, j)][std::max(i, j)];
    }
    for (std::size_t j = 0; j < i; ++j) sum += gamma[j] * move_products_[j][i];
    gamma[i] = alpha[i] - sum / move_products_[i][i];
  }
  Numbers result;
  result.solutions[pair_count_] = 1;
  for (std::size_t i = 0; i < pair_count_; ++i) {
    result.moves[i] = gamma[i];
    result.solutions[i] -= alpha[i];
    result.solutions[i + 1] += alpha[i];
  }
  return result;
}

/// Keeps the move besides, and where it began.
void Lbfgs::add_up(const Numbers& coefficients, const Positions& x, Positions& q, ThreadPool& threads) {
  remembered::for_each_chunk(static_cast<Index>(q.rows()), threads,
                             [&](std::size_t, std::size_t first, std::size_t count) {
                               remembered::ChunkOfVectors<2 * memory> all;
                               for (std::size_t i = 0; i < pair_count_; ++i) {
                                 all.add(moves_[i], first, coefficients.moves[i]);
                                 all.add(solutions_[i], first, coefficients.solutions[i]);
                               }
                               all.move({.factor = coefficients.solutions[pair_count_],
                                         .x = x.data() + first,
                                         .q = q.data() + first,
                                         .before = positions_before_.data() + first,
                                         .move = moves_[pair_count_].data() + first},
                                        count);
                             });
}

void Lbfgs::forget_pairs(Numbers& products) {
  const std::size_t last = last_solution();
  std::swap(solutions_[0], solutions_[last]);
  products.solutions[0] = products.solutions[last];
  pair_count_ = 0;
  has_moved_ = false;
}

void Lbfgs::forget_oldest_pair() {
  remembered::drop_first(moves_, memory_ + 1);
  remembered::drop_first(last_.moves, memory_ + 1);
  remembered::drop_first(solutions_, memory_ + 1);
  remembered::drop_first(last_.solutions, memory_ + 1);
  for (Table* const table : {&move_products_, &solution_products_}) {
    for (auto& line : *table) remembered::drop_first(line, memory_);
    remembered::drop_first(*table, memory_);
  }
  --pair_count_;
}

}  // namespace pliant
