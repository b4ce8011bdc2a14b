#pragma once
// Lanes of any number type in the vectors of the compiler: one row of x each. Included as triangular_solve_kernel.h is.
#include "pliant/solver/global/factorization/triangular_solve_kernel.h"

namespace pliant {
namespace {

template <class T>
struct RowOf;
template <>
struct RowOf<float> {
  using Type = float __attribute__((vector_size(16), may_alias));
};
template <>
struct RowOf<double> {
  using Type = double __attribute__((vector_size(32), may_alias));
};

template <class T>
struct GenericLanes {
  using Scalar = T;
  using Row = typename RowOf<T>::Type;
  struct Block {
    Row row[4];
  };
  struct Sum {
    Row even, odd;
  };
  struct Mode {
    Mode() {}
    ~Mode() {}
  };
  using Spread = Row;
  static constexpr int row_blocks_at_once = 1;
  static constexpr int columns_at_once = 4;

  static Row& row_at(T* x, std::ptrdiff_t row) { return *reinterpret_cast<Row*>(x + 4 * row); }
  static const Row& row_at(const T* x, std::ptrdiff_t row) { return *reinterpret_cast<const Row*>(x + 4 * row); }

  static Block zero() { return {{Row{}, Row{}, Row{}, Row{}}}; }
  static Sum zero_sum() { return {Row{}, Row{}}; }
  static const Row& spread(const T* x) { return row_at(x, 0); }
  static Block load(const T* x, std::int32_t rows) {
    Block block = zero();
    for (std::int32_t r = 0; r < smaller(rows, 4); ++r) block.row[r] = row_at(x, r);
    return block;
  }
  static void store(T* x, const Block& block, std::int32_t rows) {
    for (std::int32_t r = 0; r < smaller(rows, 4); ++r) row_at(x, r) = block.row[r];
  }
  static Block gather(const T* x, const std::int32_t* row) {
    return {{row_at(x, row[0]), row_at(x, row[1]), row_at(x, row[2]), row_at(x, row[3])}};
  }
  static void scatter_subtract(T* x, const std::int32_t* row, const Block& block) {
    for (int r = 0; r < 4; ++r) row_at(x, row[r]) -= block.row[r];
  }
  static void add_product(Block& sum, const T* value, const Row& x) {
    for (int r = 0; r < 4; ++r) sum.row[r] += value[r] * x;
  }
  static void add_dot(Sum& sum, const T* value, const Block& x) {
    sum.even += value[0] * x.row[0];
    sum.odd += value[1] * x.row[1];
    sum.even += value[2] * x.row[2];
    sum.odd += value[3] * x.row[3];
  }
  static Block reduce(const Sum* sum) {
    Block block;
    for (int c = 0; c < 4; ++c) block.row[c] = sum[c].even + sum[c].odd;
    return block;
  }
  static void subtract_sum(T* x, const Sum& sum) { row_at(x, 0) -= sum.even + sum.odd; }
  static Block difference(const Block& a, const Block& b) {
    Block block;
    for (int r = 0; r < 4; ++r) block.row[r] = a.row[r] - b.row[r];
    return block;
  }
};

}  // namespace
}  // namespace pliant
