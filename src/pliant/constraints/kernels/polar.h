#pragma once
// The rotations nearest to several matrices side by side. What a lane gets does not depend on the matrices beside it.
//
// With the stretches σ of F, K its cofactors and J > 0 its determinant, e = Σ σ is the largest root of
// (e² − ‖F‖²)² = 4 ‖K‖² + 8 e J, as the invariants of S = (FᵀF)^½ satisfy e₁² = ‖F‖² + 2 e₂ and e₂² = ‖K‖² + 2 e₁ J.
// The nearest rotation is the gradient of e (Cayley and Hamilton: (e₁ e₂ − J) R = (e₁² − e₂) F + e₁ K − F FᵀF).
// Newton's iteration for e comes from above, so it passes the root by rounding alone; it begins in single precision and
// ends in double.
//
// Where one stretch is more than about twenty times both others, or the iteration is not done, Newton's for the polar
// decomposition, R ← ½ (R + R⁻ᵀ) (Higham 1986), each lane until it has converged. What is inverted is left.
#include "pliant/core/lanes.h"

namespace pliant {
namespace {

template <int width>
struct Polar : LaneMath<width> {
  using Math = LaneMath<width>;
  using typename Math::Mask;
  using typename Math::Number;
  using typename Math::Single;

  /// Of the iterations for e; enough where stretches differ by a factor of two, and the most that may follow.
  static constexpr int single_iterations = 3, more_iterations = 6;
  /// Of e: what it leaves after so small a change is below rounding.
  static constexpr double last_change_of_sum = 1e-11;
  /// Of (e₁ e₂ − J)² to ‖F‖⁶; at rest it is 2.4. Rounding is amplified by one over its root.
  static constexpr double smallest_ratio = 0.01;
  /// Of ‖F‖², so that its square is a number in single precision.
  static constexpr double smallest_squares = 1e-8, largest_squares = 1e8;

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
    return dot(m, c);
  }

  /// Puts the nearest rotations in place of m; returns where that was not possible, and m is anything.
  static Mask rotate(Number (&m)[9]) {
    Number r[9];
    const Mask is_done = rotate_by_sum(m, r);
    if (!Math::any(~is_done)) {
      for (int a = 0; a < 9; ++a) m[a] = r[a];
      return Mask{};
    }
    const Mask is_left = rotate_by_steps(m, ~is_done);
    for (int a = 0; a < 9; ++a) m[a] = Math::select(is_done, r[a], m[a]);
    return is_left;
  }

 private:
  static Number dot(const Number* a, const Number* b) {
    return Math::multiply_add(a[0], b[0], Math::multiply_add(a[1], b[1], a[2] * b[2]));
  }

  /// The sum of the stretches, 8 (e₁ e₂ − J), and the reciprocal of that.
  struct Sum {
    Number e, slope, reciprocal;
    Mask is_open;  // not converged
  };
  /// Of those that are wanted.
  static Sum sum_of_stretches(Number squares, Number squared_cofactors, Number J, Mask is_wanted) {
    const Single a = Math::to_single(squares), b = Math::to_single(4 * squared_cofactors), j = Math::to_single(8 * J);
    Single s = Math::square_root(3 * a);
    for (int i = 0; i < single_iterations; ++i) {
      const Single t = s * s - a;
      s -= (t * t - (b + j * s)) / (4 * s * t - j);
    }
    Sum sum{Math::to_double(s), {}, Math::to_double(1 / (4 * s * (s * s - a) - j)), {}};
    const auto off = [&] {
      const Number t = Math::multiply_add(sum.e, sum.e, -squares);
      return Math::multiply_add(t, t, -Math::multiply_add(8 * J, sum.e, 4 * squared_cofactors));
    };
    const auto slope = [&] {
      return Math::multiply_add(4 * sum.e, Math::multiply_add(sum.e, sum.e, -squares), -8 * J);
    };
    const Number least = last_change_of_sum * last_change_of_sum * squares;
    sum.e -= off() * sum.reciprocal;
    Number change = off() * sum.reciprocal;
    sum.e -= change;
    sum.is_open = is_wanted & ~(change * change <= least);
    for (int i = 0; i < more_iterations && Math::any(sum.is_open); ++i) {
      const Number exact = 1 / slope();
      change = off() * exact;
      sum.e = Math::select(sum.is_open, sum.e - change, sum.e);
      sum.reciprocal = Math::select(sum.is_open, exact, sum.reciprocal);
      sum.is_open &= ~(change * change <= least);
    }
    sum.slope = slope();
    for (int i = 0; i < 2; ++i) {
      sum.reciprocal *= Math::multiply_add(-sum.slope, sum.reciprocal, Number{} + 2);
    }
    return sum;
  }

  /// Where it returns false r is anything.
  static Mask rotate_by_sum(const Number (&m)[9], Number (&r)[9]) {
    Number c[9];
    const Number J = cofactors(m, c);
    const Number xx = dot(m, m), yy = dot(m + 3, m + 3), zz = dot(m + 6, m + 6);
    const Number xy = dot(m, m + 3), yz = dot(m + 3, m + 6), zx = dot(m + 6, m);
    const Number squares = xx + yy + zz;
    const Number cubed = squares * squares * squares;
    const Mask is_sound = (squares > smallest_squares) & (squares < largest_squares) & (J > 0) &
                          (J * J > smallest_determinant * smallest_determinant / 27 * cubed);
    const Sum sum = sum_of_stretches(squares, dot(c, c) + dot(c + 3, c + 3) + dot(c + 6, c + 6), J, is_sound);
    const Number factor = 8 * sum.reciprocal;
    const Number of_cofactors = factor * sum.e;
    const Number of_m = 0.5 * factor * Math::multiply_add(sum.e, sum.e, squares);  // e₁² − e₂ = (e² + ‖F‖²)/2
    const Number columns[3][3] = {{xx, xy, zx}, {xy, yy, yz}, {zx, yz, zz}};
    for (int i = 0; i < 3; ++i) {
      const Number* C = columns[i];
      const Number x = -factor * C[0], y = -factor * C[1], z = -factor * C[2];
      for (int a = 0; a < 3; ++a) {
        const Number back = Math::multiply_add(x, m[a], Math::multiply_add(y, m[3 + a], z * m[6 + a]));
        r[3 * i + a] = Math::multiply_add(of_m, m[3 * i + a], Math::multiply_add(of_cofactors, c[3 * i + a], back));
      }
    }
    const Number denominator = sum.slope / 8;
    return is_sound & ~sum.is_open & (denominator > 0) & (denominator * denominator > smallest_ratio * cubed);
  }

  /// Those that are wanted; returns where that was not possible.
  static Mask rotate_by_steps(Number (&m)[9], Mask is_wanted) {
    Number squares = m[0] * m[0];
    for (int a = 1; a < 9; ++a) squares = Math::multiply_add(m[a], m[a], squares);
    const Number scale = 1 / Math::square_root(squares / 3);
    for (int a = 0; a < 9; ++a) m[a] *= scale;
    Number c[9];
    Number determinant = cofactors(m, c);
    const Mask is_sound = determinant > smallest_determinant;  // not so where it is not finite
    Mask is_open = is_sound & is_wanted;
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
    return is_open | (is_wanted & ~is_sound);
  }
};

}  // namespace
}  // namespace pliant
