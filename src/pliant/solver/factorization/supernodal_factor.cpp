#include "pliant/solver/factorization/supernodal_factor.h"

#include <cstdint>

#include "pliant/core/stopwatch.h"

namespace pliant {

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

SolveTimes SupernodalFactor::solve(const Positions& b, Positions& x) {
  SolveTimes times;
  Stopwatch watch;
  for (std::size_t i = 0; i < permutation_.size(); ++i) {
    const Real* from = b.data() + 3 * static_cast<std::ptrdiff_t>(permutation_[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) x_[4 * i + axis] = from[axis];
  }
  const SweepData data{supernodes_.data(), supernodes_.size(), rows_.data(), values_.data(), x_};
  times.permutation = watch.lap();
  sweeps().forward(data);
  times.forward = watch.lap();
  sweeps().backward(data);
  times.backward = watch.lap();
  for (std::size_t i = 0; i < permutation_.size(); ++i) {
    const Real* from = x_ + 4 * i;
    Real* to = x.data() + 3 * static_cast<std::ptrdiff_t>(permutation_[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) to[axis] = from[axis];
  }
  times.permutation += watch.lap();
  return times;
}

}  // namespace pliant
