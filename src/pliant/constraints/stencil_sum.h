#pragma once
// z = A S q of one constraint.
#include <algorithm>
#include <array>
#include <span>

#include "pliant/core/types.h"

namespace pliant {

/// Writes the rows of z, three numbers each. coefficients: A, rows × n. Where every row sums to zero, it is summed over
/// differences to the first vertex of the stencil: far from the origin this keeps the digits that the sum over
/// positions would lose.
template <int rows, bool translation_invariant>
void sum_stencil(const Real* positions, std::span<const Index> stencil, const Real* coefficients, Real* z) {
  const auto corner = [&](std::size_t j) { return positions + 3 * static_cast<std::ptrdiff_t>(stencil[j]); };
  std::fill_n(z, rows * 3, Real(0));
  const Real* origin = corner(0);
  for (std::size_t j = translation_invariant ? 1 : 0; j < stencil.size(); ++j) {
    const Real* x = corner(j);
    std::array<Real, 3> e = {x[0], x[1], x[2]};
    if constexpr (translation_invariant) e = {x[0] - origin[0], x[1] - origin[1], x[2] - origin[2]};
    for (std::size_t row = 0; row < rows; ++row) {
      const Real c = coefficients[row * stencil.size() + j];
      for (std::size_t axis = 0; axis < 3; ++axis) z[row * 3 + axis] += c * e[axis];
    }
  }
}

}  // namespace pliant
