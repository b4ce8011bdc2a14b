#pragma once
// Types whose points are isometries: triangles and tetrahedra. Compiled as lanes.h says.
#include "pliant/constraints/kernels/block.h"
#include "pliant/constraints/kernels/polar.h"

namespace pliant {
namespace {

template <int width>
struct StrainKernels : Block<width> {
  using All = Block<width>;
  using Math = LaneMath<width>;
  using typename All::Sums;
  using typename Math::Mask;
  using typename Math::Number;

  /// Writes Aᵀ w (p − z), the forces on the vertices. Rows sum to zero, so the forces do.
  template <std::size_t vertices, std::size_t rows>
  static void scatter(const LocalBlock& block, std::size_t first, const Number (&d)[3 * rows]) {
    Number forces[3 * vertices];
    for (std::size_t axis = 0; axis < 3; ++axis) forces[axis] = Number{};
    for (std::size_t j = 1; j < vertices; ++j) {
      Number* force = forces + 3 * j;
      for (std::size_t axis = 0; axis < 3; ++axis) force[axis] = Number{};
      for (std::size_t row = 0; row < rows; ++row) {
        const Number c = All::template coefficient<vertices, rows>(block, first, row, j);
        for (std::size_t axis = 0; axis < 3; ++axis)
          force[axis] = Math::multiply_add(c, d[3 * row + axis], force[axis]);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) forces[axis] -= force[axis];
    }
    All::store(forces, block.out + 3 * vertices * first);
  }

  /// Writes the forces where p is `stretch` times the isometry of each lane, of constraints with these limits.
  template <std::size_t vertices, std::size_t size>
  static void stretch(const LocalBlock& block, std::size_t i, const Number (&z)[size], Number (&p)[size], Mask is_left,
                      Sums& sums) {
    Number stretch, largest;
    Math::load_both(block.fields + 2 * i * width, stretch, largest);
    is_left |= stretch != largest;
    for (std::size_t a = 0; a < size; ++a) p[a] = Math::multiply_add(stretch, p[a], -z[a]);
    settle<vertices>(block, i, p, is_left, sums);
  }

  /// Writes the forces of d = p − z.
  template <std::size_t vertices, std::size_t size>
  static void settle(const LocalBlock& block, std::size_t i, Number (&d)[size], Mask is_left, Sums& sums) {
    Number squares = {};
    for (std::size_t a = 0; a < size; ++a) squares = Math::multiply_add(d[a], d[a], squares);
    const Number w = Math::select(squares <= All::rounding * All::rounding, Number{}, All::weight(block, i * width));
    for (Number& number : d) number *= w;
    scatter<vertices, size / 3>(block, i * width, d);
    sums.add(i, is_left, w / 2 * squares);
  }

  /// The isometry F (FᵀF)^-½ with the root of a 2 × 2 matrix in closed form: for C = FᵀF it is S = (C + r) / t with
  /// r = √det C = ‖f₀ × f₁‖ and t = √(tr C + 2 r), for S² = C by Cayley and Hamilton.
  static LocalDone triangle_strain(const LocalBlock& block) {
    constexpr double smallest_ratio = 1e-3;  // of r to the trace: below, F is too near to a matrix of lower rank
    Sums sums;
    const std::size_t vectors = block.count / width;
    for (std::size_t i = 0; i < vectors; ++i) {
      Number f[6];
      All::template reduce<3, 2>(block, i * width, f);
      const Number a = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
      const Number b = f[0] * f[3] + f[1] * f[4] + f[2] * f[5];
      const Number d = f[3] * f[3] + f[4] * f[4] + f[5] * f[5];
      const Number x = f[1] * f[5] - f[2] * f[4], y = f[2] * f[3] - f[0] * f[5], z = f[0] * f[4] - f[1] * f[3];
      const Number r = Math::square_root(x * x + y * y + z * z);
      const Number trace = a + d;
      const Mask is_left = ~(r > smallest_ratio * trace) | ~(trace * trace < 1e300);
      const Number scale = 1 / (r * Math::square_root(trace + 2 * r));
      Number p[6];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        p[axis] = scale * ((d + r) * f[axis] - b * f[3 + axis]);
        p[3 + axis] = scale * ((a + r) * f[3 + axis] - b * f[axis]);
      }
      stretch<3>(block, i, f, p, is_left, sums);
    }
    return sums.done(vectors);
  }

  static LocalDone tetrahedron_strain(const LocalBlock& block) {
    Sums sums;
    const std::size_t vectors = block.count / width;
    for (std::size_t i = 0; i < vectors; ++i) {
      Number f[9];
      All::template reduce<4, 3>(block, i * width, f);
      Number p[9];
      for (std::size_t a = 0; a < 9; ++a) p[a] = f[a];
      const Mask is_left = Polar<width>::rotate(p);
      stretch<4>(block, i, f, p, is_left, sums);
    }
    return sums.done(vectors);
  }
};

}  // namespace
}  // namespace pliant
