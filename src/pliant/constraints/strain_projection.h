#pragma once
// What the projections of triangles and tetrahedra share.
#include "pliant/core/svd.h"

namespace pliant {

template <class Sigma>
Sigma clamped(const Sigma& sigma, Real min, Real max) {
  return sigma.cwiseMax(min).cwiseMin(max);
}

/// U diag(sigma) Vᵀ
template <int columns, class Sigma>
ThreeRows<columns> recompose(const SmallSvd<columns>& decomposition, const Sigma& sigma) {
  return decomposition.U * sigma.asDiagonal() * decomposition.V.transpose();
}

/// p = z where the two differ by no more than the rounding of z itself. Such a difference carries no information, but
/// its torque would set a free body at rest turning.
inline void keep_within_rounding(const Real* z, Real* p, int size) {
  constexpr Real rounding = 64 * std::numeric_limits<Real>::epsilon();
  Real largest = 0;
  for (int a = 0; a < size; ++a) largest = std::max(largest, std::abs(p[a] - z[a]));
  if (largest <= rounding) std::copy_n(z, size, p);
}

}  // namespace pliant
