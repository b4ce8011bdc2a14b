#pragma once
// Newton's iteration for the polar decomposition, R ← ½ (R + R⁻ᵀ) (Higham 1986), several matrices side by side. Each
// lane stops by itself, so its result does not depend on the matrices beside it.
#include "pliant/constraints/kernels/lanes.h"

namespace pliant {
namespace {

template <int width>
struct Polar : LaneMath<width> {
  using Math = LaneMath<width>;
  using typename Math::Mask;
  using typename Math::Number;

  /// From 0.01 to 100 times its mean stretch every stretch has converged by then; others are left.
  static constexpr int most_iterations = 14;
  /// The iteration squares the error, so what a change of this norm leaves is below rounding.
  static constexpr double last_change = 1e-8;
  /// Of a matrix whose mean stretch is 1; nearer to a singular one, or inverted, the iteration is not for it.
  static constexpr double smallest_determinant = 1e-6;

  /// The cofactors of m, and its determinant.
  static Number cofactors(const Number* m, Number* c) {
    for (int i = 0; i < 3; ++i) {
      const Number* a = m + 3 * ((i + 1) % 3);
      const Number* b = m + 3 * ((i + 2) % 3);
      for (int j = 0; j < 3; ++j) {
        const Number back = a[(j + 2) % 3] * b[(j + 1) % 3];
        c[3 * i + j] = Math::multiply_add(a[(j + 1) % 3], b[(j + 2) % 3], -back);
      }
    }
    return Math::multiply_add(m[0], c[0], Math::multiply_add(m[1], c[1], m[2] * c[2]));
  }

  /// Puts the nearest rotations in place of m; returns where that was not possible, and m is anything.
  static Mask rotate(Number (&m)[9]) {
    Number squares = m[0] * m[0];
    for (int a = 1; a < 9; ++a) squares = Math::multiply_add(m[a], m[a], squares);
    const Number scale = 1 / Math::square_root(squares / 3);
    for (int a = 0; a < 9; ++a) m[a] *= scale;
    Number c[9];
    Number determinant = cofactors(m, c);
    const Mask is_sound = determinant > smallest_determinant;  // not so where it is not finite
    Mask is_open = is_sound;
    for (int i = 0; i < most_iterations && Math::any(is_open); ++i) {
      if (i > 0) determinant = cofactors(m, c);
      const Number half = 0.5 / determinant;
      Number change = {};
      for (int a = 0; a < 9; ++a) {
        const Number next = Math::multiply_add(half, c[a], 0.5 * m[a]);
        change = Math::multiply_add(next - m[a], next - m[a], change);
        m[a] = Math::select(is_open, next, m[a]);
      }
      is_open &= change >= last_change * last_change;
    }
    return is_open | ~is_sound;
  }
};

}  // namespace
}  // namespace pliant
