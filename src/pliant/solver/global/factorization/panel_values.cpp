#include "pliant/solver/global/factorization/panel_values.h"

#include <algorithm>
#include <array>

#include <Eigen/Dense>

#include "pliant/solver/global/factorization/triangular_solve.h"

namespace pliant {
namespace {

using Dense = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor>;
using Block = Eigen::Map<Dense, 0, Eigen::OuterStride<>>;

/// Row after row: each is a combination of the rows of the inverse above it.
void invert_small(Real* L, Index n, Index stride) {
  constexpr Index most = 32;
  std::array<Real, most> row;
  const auto at = [&](Index r, Index c) -> Real& { return L[static_cast<std::ptrdiff_t>(c) * stride + r]; };
  for (Index r = 0; r < n; ++r) {
    const Real inverse = 1 / at(r, r);
    for (Index c = 0; c < r; ++c) row[static_cast<std::size_t>(c)] = at(r, c);
    for (Index c = 0; c < r; ++c) {
      Real sum = 0;
      for (Index k = c; k < r; ++k) sum += row[static_cast<std::size_t>(k)] * at(k, c);
      at(r, c) = -inverse * sum;
    }
    at(r, r) = inverse;
  }
}

/// By halves: [A 0; B C]⁻¹ = [A⁻¹ 0; −C⁻¹ B A⁻¹ C⁻¹], a third of the operations of a solve for the identity.
void invert(Real* L, Index n, Index stride) {
  constexpr Index small = 24;
  if (n <= small) {
    invert_small(L, n, stride);
    return;
  }
  const Index half = n / 2;
  Real* const lower = L + static_cast<std::ptrdiff_t>(half) * stride + half;
  invert(L, half, stride);
  invert(lower, n - half, stride);
  const Block A(L, half, half, Eigen::OuterStride<>(stride));
  const Block C(lower, n - half, n - half, Eigen::OuterStride<>(stride));
  Block B(L + half, n - half, half, Eigen::OuterStride<>(stride));
  const Dense product = C.triangularView<Eigen::Lower>() * B;
  B.noalias() = product * A.triangularView<Eigen::Lower>();
  B = -B;
}

template <class T>
T* write_inverse(const Real* inverse, Index n, Real unit, T* out) {
  for (Index first = 0; first < n; first += panel_lanes) {
    for (Index c = 0; c < std::min(n, first + panel_lanes); ++c) {
      const Real* column = inverse + static_cast<std::ptrdiff_t>(c) * n;
      for (Index r = first; r < first + panel_lanes; ++r) *out++ = r < n && c <= r ? T(column[r] * unit) : T(0);
    }
  }
  return out;
}

template <class T>
void write_below(const Supernode& s, Real unit, T* out) {
  const auto below = static_cast<Index>(s.rows_below.size());
  const Real scale = 1 / unit;  // exact
  Index first = 0;
  for (; first + panel_lanes <= below; first += panel_lanes) {
    for (Index c = 0; c < s.columns; ++c, out += panel_lanes) {
      const Real* from = s.column(c) + (s.columns - c) + first;
      for (Index r = 0; r < panel_lanes; ++r) out[r] = T(from[r] * scale);
    }
  }
  if (first == below) return;
  for (Index c = 0; c < s.columns; ++c) {
    const Real* from = s.column(c) + (s.columns - c) + first;
    for (Index r = 0; r < panel_lanes; ++r) *out++ = first + r < below ? T(from[r] * scale) : T(0);
  }
}

}  // namespace

void invert_lower_triangle(Real* L, Index n) {
  invert(L, n, n);
}

template <class T>
void write_panel(const Supernode& s, Real unit, std::vector<Real>& work, T* out) {
  const auto n = static_cast<std::size_t>(s.columns);
  if (work.size() < n * n) work.resize(n * n);
  for (Index c = 0; c < s.columns; ++c) {
    std::copy_n(s.column(c), s.columns - c, work.data() + static_cast<std::size_t>(c) * (n + 1));
  }
  invert_lower_triangle(work.data(), s.columns);
  write_below(s, unit, write_inverse(work.data(), s.columns, unit, out));
}

template void write_panel(const Supernode& s, Real unit, std::vector<Real>& work, float* out);
template void write_panel(const Supernode& s, Real unit, std::vector<Real>& work, double* out);

}  // namespace pliant
