#pragma once
// Types whose points have a given area or volume. Compiled as lanes.h says.
//
// The nearest X to F of product t satisfies X = F − λ C with C the gradient of the product at X. So X ← F − λ C, λ such
// that to first order the product becomes t: the error shrinks by about |λ| each time, a few hundredths near rest. A
// stationary X nearer than half the smallest stretch of F is the nearest (product_projection.cpp says why); what is
// farther, inverted or nearly flat is left.
#include "pliant/constraints/kernels/polar.h"
#include "pliant/constraints/kernels/strain_kernels.h"

namespace pliant {
namespace {

template <int width>
struct ProductKernels : StrainKernels<width> {
  using All = Block<width>;
  using Math = LaneMath<width>;
  using typename All::Sums;
  using typename Math::Mask;
  using typename Math::Number;

  static constexpr int most_iterations = 24;
  /// Of the norm of F; what the iteration leaves after such a change is below rounding.
  static constexpr double last_change = 2e-15;

  template <std::size_t size>
  static Number dot(const Number (&a)[size], const Number (&b)[size]) {
    Number sum = {};
    for (std::size_t k = 0; k < size; ++k) sum = Math::multiply_add(a[k], b[k], sum);
    return sum;
  }

  /// The area ‖x₁ × x₂‖ of the columns, and its gradient.
  static Number product_of(const Number (&x)[6], Number (&c)[6]) {
    Number n[3] = {x[1] * x[5] - x[2] * x[4], x[2] * x[3] - x[0] * x[5], x[0] * x[4] - x[1] * x[3]};
    const Number area = Math::square_root(dot(n, n));
    for (Number& number : n) number /= area;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, d = (a + 2) % 3;
      c[a] = x[3 + b] * n[d] - x[3 + d] * n[b];
      c[3 + a] = n[b] * x[d] - n[d] * x[b];
    }
    return area;
  }
  /// The determinant, and its gradient.
  static Number product_of(const Number (&x)[9], Number (&c)[9]) { return Polar<width>::cofactors(x, c); }

  /// Half of the smallest stretch of a matrix with this product and square norm is more: σ₁ ≤ ‖F‖, σ₁ σ₂ ≤ ‖F‖²/2.
  template <std::size_t size>
  static Number half_smallest(Number product, Number squares) {
    if constexpr (size == 9) return product / squares;
    return product / (2 * Math::square_root(squares));
  }

  template <std::size_t vertices>
  static LocalDone keep_product(const LocalBlock& block) {
    constexpr std::size_t rows = vertices - 1, size = 3 * rows;
    Sums sums;
    const std::size_t vectors = block.count / width;
    for (std::size_t i = 0; i < vectors; ++i) {
      Number f[size], x[size], c[size];
      All::template reduce<vertices, rows>(block, i * width, f);
      for (std::size_t a = 0; a < size; ++a) x[a] = f[a];
      Number least, most;
      Math::load_both(block.fields + 2 * i * width, least, most);
      const Number given = product_of(x, c);
      const Number squares = dot(f, f);
      const Number target = Math::select(given < least, least, most);
      const Mask is_inside = (given >= least) & (given <= most);
      const Number reach = half_smallest<size>(given, squares);
      const Mask is_sound = (reach > 0) & (squares < 1e100);
      Mask is_open = is_sound & ~is_inside;
      for (int k = 0; k < most_iterations && Math::any(is_open); ++k) {
        const Number product = k == 0 ? given : product_of(x, c);
        Number off[size];
        for (std::size_t a = 0; a < size; ++a) off[a] = f[a] - x[a];
        const Number lambda = (dot(c, off) + product - target) / dot(c, c);
        Number change = {};
        for (std::size_t a = 0; a < size; ++a) {
          const Number next = Math::multiply_add(-lambda, c[a], f[a]);
          change = Math::multiply_add(next - x[a], next - x[a], change);
          x[a] = Math::select(is_open, next, x[a]);
        }
        is_open &= ~(change <= last_change * last_change * squares);
      }
      for (std::size_t a = 0; a < size; ++a) x[a] -= f[a];
      const Mask is_near = dot(x, x) <= reach * reach;
      const Mask is_done = is_inside | (is_sound & ~is_open & is_near);
      StrainKernels<width>::template settle<vertices>(block, i, x, ~is_done, sums);
    }
    return sums.done(vectors);
  }

  static LocalDone triangle_area(const LocalBlock& block) { return keep_product<3>(block); }
  static LocalDone tetrahedron_volume(const LocalBlock& block) { return keep_product<4>(block); }
};

}  // namespace
}  // namespace pliant
