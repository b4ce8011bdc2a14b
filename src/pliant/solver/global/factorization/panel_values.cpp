#include "pliant/solver/global/factorization/panel_values.h"

#include <algorithm>
#include <array>

#include <Eigen/Dense>

#include "pliant/solver/global/factorization/diagonal_blocks.h"
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

/// (D Dᵀ)⁻¹ = D⁻ᵀ D⁻¹, whole.
void invert_whole(const Real* inverse, Index n, Real* whole) {
  const auto at = [n](Index r, Index c) { return static_cast<std::ptrdiff_t>(c) * n + r; };
  for (Index c = 0; c < n; ++c) {
    for (Index r = c; r < n; ++r) {
      Real sum = 0;
      for (Index k = r; k < n; ++k) sum += inverse[at(k, r)] * inverse[at(k, c)];
      whole[at(r, c)] = whole[at(c, r)] = sum;
    }
  }
}

/// C = B D⁻¹.
void multiply_below(const Supernode& s, const Real* inverse, Real* C) {
  const auto below = static_cast<Index>(s.rows_below.size());
  const Index n = s.columns;
  constexpr Index wide = 8;
  if (s.is_rectangle && n > wide && below > 0) {
    const Eigen::Map<const Dense, 0, Eigen::OuterStride<>> B(s.values + n, below, n, Eigen::OuterStride<>(s.rows()));
    Eigen::Map<Dense>(C, below, n).noalias() =
        B * Eigen::Map<const Dense>(inverse, n, n).triangularView<Eigen::Lower>();
    return;
  }
  for (Index c = 0; c < n; ++c, C += below) {
    std::fill_n(C, below, Real(0));
    for (Index k = c; k < n; ++k) {
      const Real* from = s.column(k) + (n - k);
      const Real factor = inverse[static_cast<std::ptrdiff_t>(c) * n + k];
      for (Index r = 0; r < below; ++r) C[r] += factor * from[r];
    }
  }
}

/// D⁻¹, of each block of rows the columns up to its last one.
template <class T>
T* write_inverse(const Real* inverse, Index n, Real factor, T* out) {
  for (Index first = 0; first < n; first += panel_lanes) {
    for (Index c = 0; c < std::min(n, first + panel_lanes); ++c) {
      const Real* column = inverse + static_cast<std::ptrdiff_t>(c) * n;
      for (Index r = first; r < first + panel_lanes; ++r) *out++ = r < n && c <= r ? T(column[r] * factor) : T(0);
    }
  }
  return out;
}

/// A matrix of so many rows, column after column, in blocks of rows.
template <class T>
T* write_blocks(const Real* matrix, Index rows, Index columns, Real factor, T* out) {
  for (Index first = 0; first < rows; first += panel_lanes) {
    const Real* from = matrix + first;
    const Index some = std::min(panel_lanes, rows - first);
    for (Index c = 0; c < columns; ++c, from += rows, out += panel_lanes) {
      for (Index r = 0; r < some; ++r) out[r] = T(from[r] * factor);
      for (Index r = some; r < panel_lanes; ++r) out[r] = T(0);
    }
  }
  return out;
}

}  // namespace

void invert_lower_triangle(Real* L, Index n) {
  invert(L, n, n);
}

template <class T>
void write_panel(const Supernode& s, Real unit, std::vector<Real>& work, T* out) {
  const auto n = static_cast<std::size_t>(s.columns);
  const std::size_t below = s.rows_below.size();
  const std::size_t room = n * (n + std::max(n, below));
  if (work.size() < room) work.resize(room);
  Real* const inverse = work.data();
  Real* const product = inverse + n * n;
  for (Index c = 0; c < s.columns; ++c) {
    std::copy_n(s.column(c), s.columns - c, inverse + static_cast<std::size_t>(c) * (n + 1));
  }
  invert_lower_triangle(inverse, s.columns);
  if (s.columns <= most_whole_columns) {
    invert_whole(inverse, s.columns, product);
    out = write_blocks(product, s.columns, s.columns, unit * unit, out);
  } else {
    out = write_inverse(inverse, s.columns, unit, out);
  }
  multiply_below(s, inverse, product);
  write_blocks(product, static_cast<Index>(below), s.columns, Real(1), out);
}

template void write_panel(const Supernode& s, Real unit, std::vector<Real>& work, float* out);
template void write_panel(const Supernode& s, Real unit, std::vector<Real>& work, double* out);

}  // namespace pliant
