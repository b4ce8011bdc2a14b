#pragma once
// Products of panels with rows of x over any kind of lanes. Included as triangular_solve_kernel.h is.
#include "pliant/solver/global/factorization/diagonal_blocks.h"
#include "pliant/solver/global/factorization/triangular_solve.h"

namespace pliant {
namespace {

inline std::int32_t smaller(std::int32_t a, std::int32_t b) {
  return a < b ? a : b;
}

/// Values of D⁻¹ before its row block b: block b has 4 b + 4 columns.
inline std::ptrdiff_t inverse_offset(std::int32_t b) {
  return 8 * static_cast<std::ptrdiff_t>(b) * (b + 1);
}

/// Values of a panel that belong to its own columns.
inline std::ptrdiff_t diagonal_size(std::int32_t columns) {
  const std::int32_t blocks = (columns + 3) / 4;
  if (columns <= most_whole_columns) return 4 * static_cast<std::ptrdiff_t>(blocks) * columns;
  return inverse_offset(blocks - 1) + 4 * static_cast<std::ptrdiff_t>(columns);
}

template <int n>
struct Count {
  static constexpr int value = n;
};

/// Calls body(Count<n>()) for an n of 1 to `most`; for 0 nothing.
template <int most, class Body>
void with_count(std::int32_t n, Body&& body) {
  if constexpr (most > 0) {
    if (n == most) {
      body(Count<most>());
    } else {
      with_count<most - 1>(n, body);
    }
  }
}

template <class Lanes>
struct Products {
  using T = typename Lanes::Scalar;
  using Block = typename Lanes::Block;
  using Sum = typename Lanes::Sum;

  /// Calls use(b, rows b of the matrix times own) for `count` blocks of rows, side by side.
  template <int count, class Use>
  static void multiply_blocks(const T* value, const T* own, std::int32_t columns, Use&& use) {
    Block sum[count];
    for (int b = 0; b < count; ++b) sum[b] = Lanes::zero();
    const std::ptrdiff_t stride = 4 * static_cast<std::ptrdiff_t>(columns);
    for (std::int32_t c = 0; c < columns; ++c, value += 4) {
      const auto xc = Lanes::spread(own + 4 * c);
      for (int b = 0; b < count; ++b) Lanes::add_product(sum[b], value + b * stride, xc);
    }
    for (int b = 0; b < count; ++b) use(b, sum[b]);
  }

  /// The same for any number of blocks.
  template <class Use>
  static void multiply(const T* value, std::int32_t blocks, const T* own, std::int32_t columns, Use&& use) {
    constexpr int at_once = Lanes::row_blocks_at_once;
    std::int32_t first = 0;
    const auto multiply_next = [&](auto count) {
      constexpr int n = decltype(count)::value;
      multiply_blocks<n>(value, own, columns, [&](int b, const Block& sum) { use(first + b, sum); });
      value += 4 * n * static_cast<std::ptrdiff_t>(columns);
    };
    for (; first + at_once <= blocks; first += at_once) multiply_next(Count<at_once>());
    with_count<at_once - 1>(blocks - first, multiply_next);
  }

  /// own ← D⁻¹ own for `count` blocks of rows from b0 on, which read nothing of those below them.
  template <int count>
  static void multiply_inverse_blocks(const T* inverse, T* own, std::int32_t b0, std::int32_t columns) {
    Block sum[count];
    const T* value[count];
    for (int b = 0; b < count; ++b) {
      sum[b] = Lanes::zero();
      value[b] = inverse + inverse_offset(b0 + b);
    }
    std::int32_t c = 0;
    for (; c < 4 * b0; ++c) {
      const auto xc = Lanes::spread(own + 4 * c);
      for (int b = 0; b < count; ++b) Lanes::add_product(sum[b], value[b] + 4 * c, xc);
    }
    for (int first = 0; first < count; ++first) {  // a block ends four columns after the one above it
      for (const std::int32_t end = smaller(columns, 4 * (b0 + first + 1)); c < end; ++c) {
        const auto xc = Lanes::spread(own + 4 * c);
        for (int b = first; b < count; ++b) Lanes::add_product(sum[b], value[b] + 4 * c, xc);
      }
    }
    for (int b = 0; b < count; ++b) {
      Lanes::store(own + 16 * static_cast<std::ptrdiff_t>(b0 + b), sum[b], columns - 4 * (b0 + b));
    }
  }

  /// own ← D⁻¹ own. From the last rows up, since the others read what is above them.
  static void multiply_inverse(const T* inverse, T* own, std::int32_t columns) {
    constexpr int at_once = Lanes::row_blocks_at_once;
    std::int32_t b = (columns + 3) / 4;
    for (; b >= at_once; b -= at_once) multiply_inverse_blocks<at_once>(inverse, own, b - at_once, columns);
    with_count<at_once - 1>(
        b, [&](auto count) { multiply_inverse_blocks<decltype(count)::value>(inverse, own, 0, columns); });
  }

  /// own ← D⁻ᵀ own for `count` columns from column c0, a multiple of four. Columns before it read nothing from it.
  template <int count>
  static void multiply_transposed_columns(const T* inverse, T* own, std::int32_t c0, std::int32_t columns) {
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

  /// own ← D⁻ᵀ own.
  static void multiply_transposed(const T* inverse, T* own, std::int32_t columns) {
    std::int32_t c = 0;
    const auto multiply_next = [&](auto count) {
      multiply_transposed_columns<decltype(count)::value>(inverse, own, c, columns);
    };
    for (; c + 4 <= columns; c += 4) multiply_next(Count<4>());
    with_count<3>(columns - c, multiply_next);
  }

  /// own ← own − Cᵀ x for `count` columns, up to eight, of blocks that are `stride` values apart.
  template <int count>
  static void subtract_below(const T* value, std::ptrdiff_t stride, std::int32_t blocks, const std::int32_t* row,
                             const T* x, T* own) {
    constexpr int groups = (count + 3) / 4;
    Sum sum[4 * groups];
    for (int c = 0; c < 4 * groups; ++c) sum[c] = Lanes::zero_sum();
    for (std::int32_t b = 0; b < blocks; ++b, value += stride, row += 4) {
      const Block xb = Lanes::gather(x, row);
      for (int c = 0; c < count; ++c) Lanes::add_dot(sum[c], value + 4 * c, xb);
    }
    if constexpr (count == 1) {
      Lanes::subtract_sum(own, sum[0]);
    } else {
      for (int g = 0; g < groups; ++g, own += 16) {
        const int rows = count - 4 * g;
        const Block before = Lanes::load(own, rows);
        Lanes::store(own, Lanes::difference(before, Lanes::reduce(sum + 4 * g)), rows);
      }
    }
  }
};

}  // namespace
}  // namespace pliant
