#pragma once
// X = D⁻¹ of the diagonal block D of a supernode. Compiled as triangular_solve_kernel.h is.
#include "pliant/core/lanes.h"
#include "pliant/solver/global/factorization/triangular_solve_products.h"

namespace pliant {
namespace {

/// Column c of a supernode, from the diagonal on.
inline const double* column_of(const PanelSource& source, std::int32_t c) {
  const auto place = static_cast<std::ptrdiff_t>(c);
  const std::ptrdiff_t rows = static_cast<std::ptrdiff_t>(source.columns) + source.rows_below;
  return source.values + place * rows + (source.is_rectangle ? place : -(place * (place - 1) / 2));
}

/// In strips of eight columns, each of them row after row: what is read together stands together.
template <int width>
class PanelInverse : LaneMath<width> {
 public:
  using Math = LaneMath<width>;
  using typename Math::Number;
  static constexpr std::int32_t strip = panel_columns_together;

  /// `numbers`: room() of them. `work`: strip × n more.
  PanelInverse(const PanelSource& source, double* numbers, double* work) : numbers_(numbers), size_(source.columns) {
    for (std::int32_t first = 0; first < size_; first += strip) {
      const std::int32_t rows = smaller(strip, size_ - first);
      gather_rows(source, first, rows, work);
      for (std::int32_t c = 0; c < first + strip; c += width) find_rows(first, rows, c, work);
    }
  }

  static std::ptrdiff_t room(std::int32_t n) { return (n + strip - 1) / strip * strip_size(n); }
  std::int32_t size() const { return size_; }
  /// Zero above the diagonal within a strip, and where the last strip is wider than what is left; not set further up.
  double* at(std::int32_t r, std::int32_t c) const {
    return numbers_ + c / strip * strip_size(size_) + strip * r + c % strip;
  }

  static Number spread(double x) { return x - Number{}; }  // which is x; x + 0 would be another for −0
  static void put(Number x, double* to) { __builtin_memcpy(to, &x, sizeof x); }

 private:
  static std::ptrdiff_t strip_size(std::int32_t n) { return static_cast<std::ptrdiff_t>(strip) * n; }

  /// These rows of D, column after column. Where there are fewer than a strip is wide the last one stands for the
  /// others.
  static void gather_rows(const PanelSource& source, std::int32_t first, std::int32_t rows, double* to) {
    for (std::int32_t k = 0; k < first + rows; ++k, to += strip) {
      const double* from = column_of(source, k) + (first - k);  // what is above the diagonal is not used
      for (std::int32_t i = k > first ? k - first : 0; i < strip; ++i) to[i] = from[smaller(i, rows - 1)];
    }
  }

  /// A vector of columns of these rows, from those of D and the rows before.
  void find_rows(std::int32_t first, std::int32_t rows, std::int32_t column, const double* factors) const {
    Number sums[strip];
    for (std::int32_t i = 0; i < strip; ++i) sums[i] = unit_vector(first + i - column);
    const std::int32_t begin = column / strip * strip;  // above, these columns are zero
    const double* known = at(begin, column);
    factors += strip_size(begin);
    for (std::int32_t k = begin; k < first; ++k, known += strip, factors += strip) {
      const Number minus = -Math::load(known);
      for (std::int32_t i = 0; i < strip; ++i) sums[i] = Math::multiply_add(spread(factors[i]), minus, sums[i]);
    }
    for (std::int32_t i = 0; i < strip; ++i, factors += strip) {
      if (i >= rows) break;
      const Number row = sums[i] * spread(1 / factors[i]);
      put(row, at(first + i, column));
      for (std::int32_t j = i + 1; j < strip; ++j) sums[j] = Math::multiply_add(spread(factors[j]), -row, sums[j]);
    }
  }

  /// 1 in that lane, if there is such a one.
  static Number unit_vector(std::int32_t lane) {
    alignas(64) static constexpr double one_in_zeros[16] = {0, 0, 0, 0, 0, 0, 0, 1};
    return lane >= 0 && lane < width ? Math::load(one_in_zeros + (7 - lane)) : Number{};
  }

  double* numbers_;
  std::int32_t size_;
};

}  // namespace
}  // namespace pliant
