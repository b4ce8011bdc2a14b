#pragma once
// The sweeps, compiled once for each instruction set: one source file for each includes this, under its own compiler
// flags. Nothing here may call an inline function of another header, whose code the linker might share between
// instruction sets.
//
// Both sweeps are bound by the latency of multiply-adds, not by their number, wherever panels are narrow; so several
// sums run side by side in registers. Forward: four rows at a time, each a dot product with the block's x. Backward:
// up to four columns at a time, each a sum over all rows below, rows in pairs.
#include "pliant/solver/factorization/sweeps.h"

namespace pliant {
namespace {

using Lanes = double __attribute__((vector_size(32)));

inline Lanes& lanes(double* x, std::int32_t row) {
  return *reinterpret_cast<Lanes*>(x + 4 * static_cast<std::ptrdiff_t>(row));
}

/// Solves with the diagonal block and returns where its values end.
inline const double* forward_block(const double* value, double* block, std::int32_t columns) {
  for (std::int32_t r = 0; r < columns; ++r) {
    Lanes even = lanes(block, r);
    Lanes odd = {};
    std::int32_t c = 0;
    for (; c + 2 <= r; c += 2, value += 2) {
      even -= value[0] * lanes(block, c);
      odd -= value[1] * lanes(block, c + 1);
    }
    if (c < r) even -= *value++ * lanes(block, c);
    lanes(block, r) = *value++ * (even + odd);
  }
  return value;
}

template <int count>
inline const double* forward_rows(const double* value, const std::int32_t* row, double* x, double* block,
                                  std::int32_t columns) {
  Lanes sum[count] = {};
  for (std::int32_t c = 0; c < columns; ++c) {
    const Lanes xc = lanes(block, c);
    for (int r = 0; r < count; ++r) sum[r] += value[r * static_cast<std::ptrdiff_t>(columns) + c] * xc;
  }
  for (int r = 0; r < count; ++r) lanes(x, row[r]) -= sum[r];
  return value + count * static_cast<std::ptrdiff_t>(columns);
}

void forward(const SweepData& data) {
  const double* value = data.values;
  for (std::size_t i = 0; i < data.supernode_count; ++i) {
    const Supernode& s = data.supernodes[i];
    double* block = data.x + 4 * static_cast<std::ptrdiff_t>(s.first_column);
    value = forward_block(value, block, s.columns);
    const std::int32_t* row = data.rows + s.first_row;
    std::int32_t r = 0;
    for (; r + 4 <= s.rows_below; r += 4) value = forward_rows<4>(value, row + r, data.x, block, s.columns);
    for (; r < s.rows_below; ++r) value = forward_rows<1>(value, row + r, data.x, block, s.columns);
  }
}

/// Subtracts from `count` columns what all rows below contribute.
template <int count>
inline void backward_columns(const double* value, std::int32_t stride, const std::int32_t* row, std::int32_t rows,
                             double* x, double* block) {
  Lanes even[count] = {};
  Lanes odd[count] = {};
  std::int32_t r = 0;
  for (; r + 2 <= rows; r += 2, value += 2 * static_cast<std::ptrdiff_t>(stride)) {
    const Lanes x0 = lanes(x, row[r]);
    const Lanes x1 = lanes(x, row[r + 1]);
    for (int c = 0; c < count; ++c) even[c] += value[c] * x0;
    for (int c = 0; c < count; ++c) odd[c] += value[stride + c] * x1;
  }
  if (r < rows) {
    const Lanes x0 = lanes(x, row[r]);
    for (int c = 0; c < count; ++c) even[c] += value[c] * x0;
  }
  for (int c = 0; c < count; ++c) lanes(block, c) -= even[c] + odd[c];
}

/// `value` is where the values of the diagonal block end.
inline void backward_block(const double* value, double* block, std::int32_t columns) {
  for (std::int32_t r = columns; r-- > 0;) {
    value -= r + 1;
    const Lanes x = value[r] * lanes(block, r);
    lanes(block, r) = x;
    for (std::int32_t c = 0; c < r; ++c) lanes(block, c) -= value[c] * x;
  }
}

void backward(const SweepData& data) {
  for (std::size_t i = data.supernode_count; i-- > 0;) {
    const Supernode& s = data.supernodes[i];
    double* block = data.x + 4 * static_cast<std::ptrdiff_t>(s.first_column);
    const double* below = data.values + s.first_value + static_cast<std::ptrdiff_t>(s.columns) * (s.columns + 1) / 2;
    const std::int32_t* row = data.rows + s.first_row;
    std::int32_t c = 0;
    for (; c + 4 <= s.columns; c += 4) {
      backward_columns<4>(below + c, s.columns, row, s.rows_below, data.x, block + 4 * c);
    }
    const std::int32_t rest = s.columns - c;
    if (rest == 3) backward_columns<3>(below + c, s.columns, row, s.rows_below, data.x, block + 4 * c);
    if (rest == 2) backward_columns<2>(below + c, s.columns, row, s.rows_below, data.x, block + 4 * c);
    if (rest == 1) backward_columns<1>(below + c, s.columns, row, s.rows_below, data.x, block + 4 * c);
    backward_block(below, block, s.columns);
  }
}

}  // namespace
}  // namespace pliant
