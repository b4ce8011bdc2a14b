#pragma once
// Forward and backward substitution over any kind of lanes, compiled once for each instruction set: one source file for
// each includes this, under its own compiler flags. Nothing here may call an inline function of another header, whose
// code the linker might share between instruction sets.
//
// `Lanes` computes with blocks of 4 rows × 4 lanes. What bounds them is the latency of multiply-adds where panels
// are narrow, and the reading of the values where they are wide; so several sums run side by side in registers, and
// each value is read once.
#include "pliant/solver/global/factorization/triangular_solve.h"

namespace pliant {
namespace {

inline std::int32_t smaller(std::int32_t a, std::int32_t b) {
  return a < b ? a : b;
}

/// Values of the inverse diagonal block before its row block b: block b has 4 b + 4 columns.
inline std::ptrdiff_t inverse_offset(std::int32_t b) {
  return 8 * static_cast<std::ptrdiff_t>(b) * (b + 1);
}

/// Values of the inverse diagonal block of so many columns.
inline std::ptrdiff_t inverse_size(std::int32_t columns) {
  return inverse_offset((columns + 3) / 4 - 1) + 4 * static_cast<std::ptrdiff_t>(columns);
}

template <int n>
struct Count {
  static constexpr int value = n;
};

template <class Lanes>
struct Kernel {
  using T = typename Lanes::Scalar;
  using Block = typename Lanes::Block;
  using Sum = typename Lanes::Sum;

  /// x of the panel's columns ← D⁻¹ x. From the last rows up, since the others read what is above them.
  static void multiply_inverse(const T* inverse, T* x, std::int32_t columns) {
    for (std::int32_t b = (columns + 3) / 4 - 1; b >= 0; --b) {
      const T* value = inverse + inverse_offset(b);
      const std::int32_t end = smaller(columns, 4 * b + 4);
      Block sum = Lanes::zero();
      for (std::int32_t c = 0; c < end; ++c) Lanes::add_product(sum, value + 4 * c, Lanes::spread(x + 4 * c));
      Lanes::store(x + 16 * static_cast<std::ptrdiff_t>(b), sum, columns - 4 * b);
    }
  }

  template <int count>
  static void subtract_rows(const T* value, const std::int32_t* row, T* x, const T* own, std::int32_t columns) {
    Block sum[count];
    for (int b = 0; b < count; ++b) sum[b] = Lanes::zero();
    const std::ptrdiff_t stride = 4 * static_cast<std::ptrdiff_t>(columns);
    for (std::int32_t c = 0; c < columns; ++c, value += 4) {
      const auto xc = Lanes::spread(own + 4 * c);
      for (int b = 0; b < count; ++b) Lanes::add_product(sum[b], value + b * stride, xc);
    }
    for (int b = 0; b < count; ++b) Lanes::scatter_subtract(x, row + 4 * b, sum[b]);
  }

  static void forward(const SubstitutionData<T>& data, std::size_t begin, std::size_t end) {
    const typename Lanes::Mode mode;
    for (std::size_t i = begin; i < end; ++i) {
      const Panel& panel = data.panels[i];
      const std::int32_t columns = panel.columns;
      T* own = data.x + 4 * static_cast<std::ptrdiff_t>(panel.first_column);
      const T* value = data.values + panel.first_value;
      multiply_inverse(value, own, columns);
      value += inverse_size(columns);
      const std::int32_t* row = data.rows + panel.first_row;
      std::int32_t b = 0;
      constexpr int at_once = Lanes::row_blocks_at_once;
      for (; b + at_once <= panel.row_blocks; b += at_once) {
        subtract_rows<at_once>(value, row, data.x, own, columns);
        value += 4 * at_once * static_cast<std::ptrdiff_t>(columns);
        row += 4 * at_once;
      }
      for (; b < panel.row_blocks; ++b) {
        subtract_rows<1>(value, row, data.x, own, columns);
        value += 4 * static_cast<std::ptrdiff_t>(columns);
        row += 4;
      }
    }
  }

  /// own ← own − Bᵀ x for `count` columns, up to four.
  template <int count>
  static void subtract_below(const T* value, std::int32_t stride, const Panel& panel, const std::int32_t* row,
                             const T* x, T* own) {
    Sum sum[4];
    for (int c = 0; c < 4; ++c) sum[c] = Lanes::zero_sum();
    for (std::int32_t b = 0; b < panel.row_blocks; ++b, value += stride, row += 4) {
      const Block xb = Lanes::gather(x, row);
      for (int c = 0; c < count; ++c) Lanes::add_dot(sum[c], value + 4 * c, xb);
    }
    const Block before = Lanes::load(own, count);
    Lanes::store(own, Lanes::difference(before, Lanes::reduce(sum)), count);
  }

  /// own ← D⁻ᵀ own for `count` columns from column c0, a multiple of four. Columns before it read nothing from it.
  template <int count>
  static void multiply_transposed(const T* inverse, T* own, std::int32_t c0, std::int32_t columns) {
    Sum sum[4];
    for (int c = 0; c < 4; ++c) sum[c] = Lanes::zero_sum();
    const std::int32_t blocks = (columns + 3) / 4;
    for (std::int32_t b = c0 / 4; b < blocks; ++b) {
      const Block xb = Lanes::load(own + 16 * static_cast<std::ptrdiff_t>(b), columns - 4 * b);
      const T* value = inverse + inverse_offset(b) + 4 * c0;
      for (int c = 0; c < count; ++c) Lanes::add_dot(sum[c], value + 4 * c, xb);
    }
    Lanes::store(own + 4 * static_cast<std::ptrdiff_t>(c0), Lanes::reduce(sum), count);
  }

  /// Calls body(count, first column) for the columns, four at a time.
  template <class Body>
  static void for_columns(std::int32_t columns, Body&& body) {
    std::int32_t c = 0;
    for (; c + 4 <= columns; c += 4) body(Count<4>(), c);
    if (columns - c == 3) body(Count<3>(), c);
    if (columns - c == 2) body(Count<2>(), c);
    if (columns - c == 1) body(Count<1>(), c);
  }

  static void backward(const SubstitutionData<T>& data, std::size_t begin, std::size_t end) {
    const typename Lanes::Mode mode;
    for (std::size_t i = end; i-- > begin;) {
      const Panel& panel = data.panels[i];
      const std::int32_t columns = panel.columns;
      const T* inverse = data.values + panel.first_value;
      const T* below = inverse + inverse_size(columns);
      T* own = data.x + 4 * static_cast<std::ptrdiff_t>(panel.first_column);
      if (panel.row_blocks > 0) {
        for_columns(columns, [&](auto count, std::ptrdiff_t c) {
          subtract_below<count.value>(below + 4 * c, 4 * columns, panel, data.rows + panel.first_row, data.x,
                                      own + 4 * c);
        });
      }
      for_columns(columns,
                  [&](auto count, std::int32_t c) { multiply_transposed<count.value>(inverse, own, c, columns); });
    }
  }
};

}  // namespace
}  // namespace pliant
