#include "pliant/solver/factorization/supernodal_factor.h"

#include <cstdint>

namespace pliant {
namespace {

/// Four doubles; the compiler makes of it what the instruction set has.
using Lanes = Real __attribute__((vector_size(32)));

Lanes& lanes(Real* x, Index row) {
  return *reinterpret_cast<Lanes*>(x + 4 * static_cast<std::ptrdiff_t>(row));
}

}  // namespace

void SupernodalFactor::begin(std::span<const Index> permutation) {
  permutation_.assign(permutation.begin(), permutation.end());
  supernodes_.clear();
  rows_.clear();
  values_.clear();
}

void SupernodalFactor::finish() {
  storage_.assign(4 * permutation_.size() + 4, 0);
  const auto address = reinterpret_cast<std::uintptr_t>(storage_.data());
  x_ = storage_.data() + (32 - address % 32) % 32 / sizeof(Real);
}

void SupernodalFactor::solve(const Positions& b, Positions& x) {
  for (std::size_t i = 0; i < permutation_.size(); ++i) {
    const Real* from = b.data() + 3 * static_cast<std::ptrdiff_t>(permutation_[i]);
    lanes(x_, static_cast<Index>(i)) = Lanes{from[0], from[1], from[2], 0};
  }
  forward();
  backward();
  for (std::size_t i = 0; i < permutation_.size(); ++i) {
    const Real* from = x_ + 4 * i;
    Real* to = x.data() + 3 * static_cast<std::ptrdiff_t>(permutation_[i]);
    to[0] = from[0];
    to[1] = from[1];
    to[2] = from[2];
  }
}

void SupernodalFactor::forward() {
  const Real* value = values_.data();
  for (const Supernode& s : supernodes_) {
    Real* block = x_ + 4 * static_cast<std::ptrdiff_t>(s.first_column);
    for (Index r = 0; r < s.columns; ++r) {
      Lanes sum = lanes(block, r);
      for (Index c = 0; c < r; ++c) sum -= *value++ * lanes(block, c);
      lanes(block, r) = *value++ * sum;
    }
    const Index* row = rows_.data() + s.first_row;
    for (Index r = 0; r < s.rows_below; ++r, value += s.columns) {
      Lanes sum = value[0] * lanes(block, 0);
      for (Index c = 1; c < s.columns; ++c) sum += value[c] * lanes(block, c);
      lanes(x_, row[r]) -= sum;
    }
  }
}

void SupernodalFactor::backward() {
  for (std::size_t i = supernodes_.size(); i-- > 0;) {
    const Supernode& s = supernodes_[i];
    Real* block = x_ + 4 * static_cast<std::ptrdiff_t>(s.first_column);
    const Real* diagonal_block = values_.data() + s.first_value;
    const Real* value = diagonal_block + static_cast<std::ptrdiff_t>(s.columns) * (s.columns + 1) / 2;
    const Index* row = rows_.data() + s.first_row;
    for (Index r = 0; r < s.rows_below; ++r, value += s.columns) {
      const Lanes x = lanes(x_, row[r]);
      for (Index c = 0; c < s.columns; ++c) lanes(block, c) -= value[c] * x;
    }
    const Real* block_row = diagonal_block + static_cast<std::ptrdiff_t>(s.columns) * (s.columns + 1) / 2;
    for (Index r = s.columns; r-- > 0;) {
      block_row -= r + 1;
      const Lanes x = block_row[r] * lanes(block, r);
      lanes(block, r) = x;
      for (Index c = 0; c < r; ++c) lanes(block, c) -= block_row[c] * x;
    }
  }
}

}  // namespace pliant
