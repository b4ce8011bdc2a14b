#pragma once
// One constraint of a group: its vertices, and the rows of its reduction.
#include "pliant/constraints/constraint_group.h"

namespace pliant {

/// Its vertices, n.
inline std::span<const Index> stencil_of(const ConstraintGroup& group, std::size_t constraint) {
  const auto n = static_cast<std::size_t>(group.shape().vertices);
  return group.stencil().subspan(constraint * n, n);
}

/// Row of A, n coefficients.
inline std::span<const Real> reduction_row(const ConstraintGroup& group, std::size_t constraint, std::size_t row) {
  const auto n = static_cast<std::size_t>(group.shape().vertices);
  return group.reduction().subspan((constraint * static_cast<std::size_t>(group.shape().rows) + row) * n, n);
}

}  // namespace pliant
