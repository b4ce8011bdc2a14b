#pragma once
// The potentials of hyperelastic.h. Compiled as lanes.h says.
#include "pliant/constraints/kernels/polar.h"
#include "pliant/constraints/kernels/strain_kernels.h"

namespace pliant {
namespace {

template <int width>
struct HyperelasticKernels : StrainKernels<width> {
  using All = Block<width>;
  using Math = LaneMath<width>;
  using typename All::Sums;
  using typename Math::Mask;
  using typename Math::Number;

  /// Of ‖G‖²: below it energies are found from the invariants of G.
  static constexpr double near_rest = 0.01;
  /// Of ‖F‖²: above it, or where that is not finite, an element is left.
  static constexpr double too_large = 1e100;

  /// G = (FᵀF − I)/2, of triangles with a third row and column of zeros.
  struct Strain {
    Number xx, yy, zz, xy, yz, zx;

    Number trace() const { return xx + yy + zz; }
    Number squares() const { return xx * xx + yy * yy + zz * zz + 2 * (xy * xy + yz * yz + zx * zx); }
    Number second() const { return xx * yy - xy * xy + (yy * zz - yz * yz) + (zz * xx - zx * zx); }
    Number third() const { return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx); }
  };

  static Number dot(const Number* a, const Number* b) {
    return Math::multiply_add(a[0], b[0], Math::multiply_add(a[1], b[1], a[2] * b[2]));
  }

  template <std::size_t size>
  static Strain strain_of(const Number (&f)[size]) {
    const Number *x = f, *y = f + 3;
    Strain G{(dot(x, x) - 1) / 2, (dot(y, y) - 1) / 2, Number{}, dot(x, y) / 2, Number{}, Number{}};
    if constexpr (size == 9) {
      const Number* z = f + 6;
      G.zz = (dot(z, z) - 1) / 2, G.yz = dot(y, z) / 2, G.zx = dot(z, x) / 2;
    }
    return G;
  }

  /// J, and its gradient; of what has no area that is zero.
  static Number measure_of(const Number (&f)[9], Number (&c)[9]) { return Polar<width>::cofactors(f, c); }
  static Number measure_of(const Number (&f)[6], Number (&c)[6]) {
    Number n[3] = {f[1] * f[5] - f[2] * f[4], f[2] * f[3] - f[0] * f[5], f[0] * f[4] - f[1] * f[3]};
    const Number area = Math::square_root(dot(n, n));
    const Number scale = Math::select(area > 0, 1 / area, Number{});
    for (Number& number : n) number *= scale;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, d = (a + 2) % 3;
      c[a] = f[3 + b] * n[d] - f[3 + d] * n[b];
      c[3 + a] = n[b] * f[d] - n[d] * f[b];
    }
    return area;
  }

  /// x − ln(1 + x)
  static Number less_logarithm(Number x) {
    constexpr double small = 1e-3;
    Number logarithm = x;
    for (int lane = 0; lane < width; ++lane) logarithm[lane] = __builtin_log1p(x[lane]);
    const Number series = x * x * (0.5 - x * (1.0 / 3 - x * (0.25 - x * (0.2 - x / 6))));
    return Math::select((x > -small) & (x < small), series, x - logarithm);
  }

  /// Writes the forces of P, whose energy is `energy`, both of weight 1; takes P for zero where it is rounding of the
  /// moduli.
  template <std::size_t vertices, std::size_t size>
  static void finish(const LocalBlock& block, std::size_t i, Number (&P)[size], Number energy, Number moduli,
                     Mask is_left, Sums& sums) {
    Number squares = {};
    for (std::size_t a = 0; a < size; ++a) squares = Math::multiply_add(P[a], P[a], squares);
    const Number least = All::rounding * moduli;
    const Number w = All::weight(block, i * width);
    const Number pull = Math::select(squares <= least * least, Number{}, -w);
    for (Number& number : P) number *= pull;
    StrainKernels<width>::template scatter<vertices, size / 3>(block, i * width, P);
    sums.add(i, is_left, w * energy);
  }

  template <std::size_t vertices>
  static LocalDone neo_hookean(const LocalBlock& block) {
    constexpr std::size_t rows = vertices - 1, size = 3 * rows;
    Sums sums;
    const std::size_t vectors = block.count / width;
    for (std::size_t i = 0; i < vectors; ++i) {
      Number f[size], c[size];
      All::template reduce<vertices, rows>(block, i * width, f);
      const Number J = measure_of(f, c);
      const Strain G = strain_of(f);
      Number mu, lambda;
      Math::load_both(block.fields + 2 * i * width, mu, lambda);
      const Number t = 2 * G.trace(), quartic = 4 * G.second() + 8 * G.third();  // J² − 1 is their sum
      const Mask is_near = (G.squares() < near_rest) & (J > 0);
      const Number d = Math::select(is_near, (t + quartic) / (J + 1), J - 1);
      const Number unlike = Math::select(is_near, d * d - quartic, t - 2 * d);
      const bool is_solid = vertices == 4;
      const Number log_term = is_solid ? less_logarithm(t / 4) : Number{};
      const Number share = is_solid ? mu * 3 / 4 : mu;
      const Number of_f = is_solid ? mu * (1 - 1 / (t + 4)) : mu;
      const Number of_gradient = lambda * d - share;
      for (std::size_t a = 0; a < size; ++a) c[a] = Math::multiply_add(of_f, f[a], of_gradient * c[a]);
      const Number energy = mu / 2 * log_term + share / 2 * unlike + lambda / 2 * d * d;
      finish<vertices>(block, i, c, energy, mu + lambda, ~(t < too_large), sums);
    }
    return sums.done(vectors);
  }

  template <std::size_t vertices>
  static LocalDone st_venant_kirchhoff(const LocalBlock& block) {
    constexpr std::size_t rows = vertices - 1, size = 3 * rows;
    Sums sums;
    const std::size_t vectors = block.count / width;
    for (std::size_t i = 0; i < vectors; ++i) {
      Number f[size], P[size];
      All::template reduce<vertices, rows>(block, i * width, f);
      const Strain G = strain_of(f);
      Number mu, lambda;
      Math::load_both(block.fields + 2 * i * width, mu, lambda);
      const Number of_trace = lambda * G.trace();
      const Number S[3][3] = {{2 * mu * G.xx + of_trace, 2 * mu * G.xy, 2 * mu * G.zx},
                              {2 * mu * G.xy, 2 * mu * G.yy + of_trace, 2 * mu * G.yz},
                              {2 * mu * G.zx, 2 * mu * G.yz, 2 * mu * G.zz + of_trace}};
      for (std::size_t column = 0; column < rows; ++column) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          Number sum = {};
          for (std::size_t k = 0; k < rows; ++k) sum = Math::multiply_add(f[3 * k + axis], S[k][column], sum);
          P[3 * column + axis] = sum;
        }
      }
      const Number energy = mu * G.squares() + lambda / 2 * G.trace() * G.trace();
      finish<vertices>(block, i, P, energy, mu + lambda, ~(G.trace() < too_large), sums);
    }
    return sums.done(vectors);
  }
};

}  // namespace
}  // namespace pliant
