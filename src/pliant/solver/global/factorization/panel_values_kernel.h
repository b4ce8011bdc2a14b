#pragma once
// The values of one panel from those of its supernode, in the order of panel_factor.h. Compiled as
// triangular_solve_kernel.h is.
//
// Rows below the diagonal block go through lanes; some vectors of them times some columns of D⁻¹ are summed in
// registers, and written as they are found. What is read again and again is put side by side first: columns of a
// supernode are pages apart.
#include <type_traits>

#include "pliant/solver/global/factorization/panel_inverse_kernel.h"

namespace pliant {
namespace {

template <int width, class T>
struct PanelValues : LaneMath<width> {
  using Math = LaneMath<width>;
  using Inverse = PanelInverse<width>;
  using typename Math::Number;
  using Packed = std::conditional_t<std::is_same_v<T, float>, typename Math::Single, Number>;

  /// Sums that stand in registers: of so many vectors of rows, at least a block of panel_lanes, and columns.
  static constexpr int most_vectors = width == 4 ? 1 : 2;
  static constexpr std::int32_t most_columns = width == 2 ? 4 : 8;
  static constexpr std::int32_t most_rows = most_vectors * width;
  static_assert(panel_columns_together % most_columns == 0 && most_rows % panel_lanes == 0);
  static_assert(most_rows <= 2 * panel_columns_together, "panel_work() has room for so many");

  static void write(const PanelSource& source, double* work, T* out) {
    double* const packed = work + Inverse::room(source.columns);
    const Inverse X(source, work, packed);
    if (source.columns <= most_whole_columns) {
      out = write_whole(X, source.unit * source.unit, out);
    } else {
      out = write_lower(X, source.unit, out);
    }
    for (std::int32_t first = 0; first < source.rows_below; first += most_rows) {
      write_below<most_vectors>(source, X, first, packed, out);
    }
  }

 private:
  /// At least one, and zeros.
  static Number load_some(const double* from, std::int32_t count) {
    if (count >= width) return Math::load(from);
#ifdef __AVX512F__
    if constexpr (width == 8) return _mm512_maskz_loadu_pd(static_cast<__mmask8>((1U << count) - 1), from);
#endif
#ifdef __AVX2__
    if constexpr (width == 4) {
      const __m256i lanes = _mm256_setr_epi64x(0, 1, 2, 3);
      return _mm256_maskload_pd(from, _mm256_cmpgt_epi64(_mm256_set1_epi64x(count), lanes));
    }
#endif
    Number some = {};
    for (std::int32_t lane = 0; lane < count; ++lane) some[lane] = from[lane];
    return some;
  }

  static Packed pack(Number numbers) {
    if constexpr (std::is_same_v<T, float>) {
      return Math::to_single(numbers);
    } else {
      return numbers;
    }
  }
  static std::int32_t blocks_of(std::int32_t rows) {
    return (rows + panel_lanes - 1) / panel_lanes;
  }
  /// Numbers of one column, of row `row` and those after it. `to`: where the first block has that column.
  static void put_blocks(Number numbers, std::int32_t row, std::int32_t blocks, std::int32_t columns, T* to) {
    const Packed packed = pack(numbers);
    constexpr int some = width < panel_lanes ? width : panel_lanes;
    for (int part = 0; part < width / some; ++part) {
      const std::int32_t block = row / panel_lanes + part;
      if (block >= blocks) return;
      T piece[some];
      for (int lane = 0; lane < some; ++lane) piece[lane] = packed[part * some + lane];
      T* const at = to + static_cast<std::ptrdiff_t>(panel_lanes) * columns * block + row % panel_lanes;
      __builtin_memcpy(at, piece, sizeof piece);
    }
  }

  /// XᵀX, whole.
  static T* write_whole(const Inverse& X, double factor, T* out) {
    const std::int32_t n = X.size(), blocks = blocks_of(n);
    for (std::int32_t c = 0; c < n; ++c) {
      for (std::int32_t r = 0; r < blocks * panel_lanes; r += width) {
        Number sum = {};
        const std::int32_t zeros = r / Inverse::strip * Inverse::strip;  // of X, in rows before
        for (std::int32_t k = c > zeros ? c : zeros; k < n; ++k) {
          sum = Math::multiply_add(Inverse::spread(*X.at(k, c)), Math::load(X.at(k, r)), sum);
        }
        put_blocks(sum * factor, r, blocks, n, out + static_cast<std::ptrdiff_t>(panel_lanes) * c);
      }
    }
    return out + static_cast<std::ptrdiff_t>(panel_lanes) * blocks * n;
  }

  /// X, of each block of rows the columns up to its last one.
  static T* write_lower(const Inverse& X, double factor, T* out) {
    const std::int32_t n = X.size();
    for (std::int32_t first = 0; first < n; first += panel_lanes) {
      for (std::int32_t c = 0; c < smaller(n, first + panel_lanes); ++c) {
        for (std::int32_t r = first; r < first + panel_lanes; ++r) {
          *out++ = r < n && c <= r ? T(*X.at(r, c) * factor) : T(0);
        }
      }
    }
    return out;
  }

  /// Rows of B X from `first` on.
  template <int vectors>
  static void write_below(const PanelSource& source, const Inverse& X, std::int32_t first, double* packed, T* out) {
    const std::int32_t n = source.columns, rest = source.rows_below - first;
    if constexpr (vectors > 1 && width >= panel_lanes) {
      if (rest <= width) return write_below<1>(source, X, first, packed, out);
    }
    double* to = packed;
    for (std::int32_t k = 0; k < n; ++k) {
      const double* from = column_of(source, k) + (n - k) + first;
      for (std::int32_t r = 0; r < vectors * width; r += width, to += width) {
        Inverse::put(r < rest ? load_some(from + r, rest - r) : Number{}, to);
      }
    }
    for (std::int32_t c = 0; c < n; c += most_columns) multiply<vectors>(source, X, first, c, packed, out);
  }
  template <int vectors>
  static void multiply(const PanelSource& source, const Inverse& X, std::int32_t first, std::int32_t column,
                       const double* packed, T* out) {
    const std::int32_t n = source.columns, blocks = blocks_of(source.rows_below);
    Number sums[vectors][most_columns] = {};
    const double* factors = X.at(column, column);
    packed += static_cast<std::ptrdiff_t>(vectors * width) * column;
    for (std::int32_t k = column; k < n; ++k, factors += Inverse::strip) {
      for (int v = 0; v < vectors; ++v, packed += width) {
        const Number numbers = Math::load(packed);
        for (int c = 0; c < most_columns; ++c) {
          sums[v][c] = Math::multiply_add(numbers, Inverse::spread(factors[c]), sums[v][c]);
        }
      }
    }
    for (std::int32_t c = 0; c < smaller(most_columns, n - column); ++c) {
      T* const to = out + static_cast<std::ptrdiff_t>(panel_lanes) * (column + c);
      for (int v = 0; v < vectors; ++v) put_blocks(sums[v][c], first + v * width, blocks, n, to);
    }
  }
};

}  // namespace
}  // namespace pliant
