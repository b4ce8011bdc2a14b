#pragma once
// Forward and backward substitution over any kind of lanes, compiled once for each instruction set: one source file for
// each includes this, under its own compiler flags. Nothing here may call an inline function of another header, whose
// code the linker might share between instruction sets.
//
// `Lanes` computes with blocks of 4 rows × 4 lanes. What bounds them is the latency of multiply-adds and of loads that
// wait for stores where panels are narrow, and the reading of the values where they are wide; so several sums run side
// by side in registers, each value is read once, and nothing of a panel waits for what its own columns become.
#include "pliant/solver/global/factorization/triangular_solve_products.h"

namespace pliant {
namespace {

template <class Lanes>
struct Kernel {
  using T = typename Lanes::Scalar;
  using Block = typename Lanes::Block;
  using All = Products<Lanes>;

  /// Panels up to this wide keep their columns of x in registers.
  static constexpr int most_narrow_columns = 8;
  static_assert(most_narrow_columns <= most_whole_columns, "narrow panels are taken to store whole blocks");

  template <int columns>
  static void forward_narrow(const T* value, const std::int32_t* row, std::int32_t blocks, T* x, T* own) {
    typename Lanes::Spread xc[columns];
    for (int c = 0; c < columns; ++c) xc[c] = Lanes::spread(own + 4 * c);
    const auto multiply_next = [&] {
      Block sum = Lanes::zero();
      for (int c = 0; c < columns; ++c) Lanes::add_product(sum, value + 4 * c, xc[c]);
      value += 4 * columns;
      return sum;
    };
    for (int b = 0; b < (columns + 3) / 4; ++b) Lanes::store(own + 16 * b, multiply_next(), columns - 4 * b);
    for (std::int32_t b = 0; b < blocks; ++b, row += 4) Lanes::scatter_subtract(x, row, multiply_next());
  }

  static void forward_wide(const T* value, const std::int32_t* row, const Panel& panel, T* x, T* own) {
    const std::int32_t columns = panel.columns;
    const auto multiply_below = [&] {
      All::multiply(value + diagonal_size(columns), panel.row_blocks, own, columns,
                    [&](std::int32_t b, const Block& sum) { Lanes::scatter_subtract(x, row + 4 * b, sum); });
    };
    if (columns > most_whole_columns) {
      multiply_below();
      All::multiply_inverse(value, own, columns);
      All::multiply_transposed(value, own, columns);
      return;
    }
    alignas(64) T solved[4 * most_whole_columns];
    const std::int32_t blocks = (columns + 3) / 4;
    All::multiply(value, blocks, own, columns,
                  [&](std::int32_t b, const Block& sum) { Lanes::store(solved + 16 * b, sum, 4); });
    multiply_below();
    for (std::int32_t b = 0; b < blocks; ++b) {
      Lanes::store(own + 16 * b, Lanes::load(solved + 16 * b, 4), columns - 4 * b);
    }
  }

  static void forward(const SubstitutionData<T>& data, std::size_t begin, std::size_t end) {
    const typename Lanes::Mode mode;
    for (std::size_t i = begin; i < end; ++i) {
      const Panel& panel = data.panels[i];
      T* own = data.x + 4 * static_cast<std::ptrdiff_t>(panel.first_column);
      const T* value = data.values + panel.first_value;
      const std::int32_t* row = data.rows + panel.first_row;
      const auto narrow = [&](auto count) {
        forward_narrow<decltype(count)::value>(value, row, panel.row_blocks, data.x, own);
      };
      if (panel.columns > most_narrow_columns) {
        forward_wide(value, row, panel, data.x, own);
      } else {
        with_count<most_narrow_columns>(panel.columns, narrow);
      }
    }
  }

  static void backward(const SubstitutionData<T>& data, std::size_t begin, std::size_t end) {
    const typename Lanes::Mode mode;
    constexpr int at_once = Lanes::columns_at_once;
    for (std::size_t i = end; i-- > begin;) {
      const Panel& panel = data.panels[i];
      if (panel.row_blocks == 0) continue;
      const std::int32_t columns = panel.columns;
      const std::ptrdiff_t stride = 4 * static_cast<std::ptrdiff_t>(columns);
      const T* below = data.values + panel.first_value + diagonal_size(columns);
      T* own = data.x + 4 * static_cast<std::ptrdiff_t>(panel.first_column);
      const std::int32_t* row = data.rows + panel.first_row;
      std::int32_t c = 0;
      const auto subtract_next = [&](auto count) {
        All::template subtract_below<decltype(count)::value>(below + 4 * c, stride, panel.row_blocks, row, data.x,
                                                             own + 4 * c);
      };
      for (; c + at_once <= columns; c += at_once) subtract_next(Count<at_once>());
      with_count<at_once - 1>(columns - c, subtract_next);
    }
  }
};

}  // namespace
}  // namespace pliant
