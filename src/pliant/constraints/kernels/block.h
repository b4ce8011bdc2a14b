#pragma once
// What the kernels share: how a vector of constraints is read, and what becomes of its results. Compiled as lanes.h
// says.
#include "pliant/constraints/kernels/lane_points.h"
#include "pliant/constraints/kernels/local_kernels.h"

namespace pliant {
namespace {

template <int width>
struct Block : LanePoints<width> {
  using Math = LaneMath<width>;
  using typename Math::Mask;
  using typename Math::Number;

  /// Differences this small are rounding: they carry no information, but would set what is at rest in motion.
  static constexpr double rounding = 64 * 2.220446049250313e-16;

  /// What a block comes to, vector by vector.
  struct Sums {
    Number energy = {};
    Mask any_left = {};
    Mask left[local_block / width];

    /// Vector i of the block: its energy counts where it is not left.
    void add(std::size_t i, Mask is_left, Number more) {
      left[i] = is_left;
      any_left |= is_left;
      energy += Math::select(is_left, Number{}, more);
    }
    LocalDone done(std::size_t vectors) const {
      LocalDone result{vectors * width, 0, Math::sum(energy)};
      if (!Math::any(any_left)) return result;
      for (std::size_t i = 0; i < vectors; ++i) result.left |= Math::bits(left[i]) << (i * width);
      return result;
    }
  };

  /// x_j − x_0 of constraints with so many vertices.
  static void difference(const LocalBlock& block, std::size_t vertices, std::size_t first, std::size_t j,
                         Number (&e)[3]) {
    const std::int32_t* stencil = block.stencil + vertices * first;
    LanePoints<width>::subtract(
        [&](std::size_t lane, const double*& from, const double*& to) {
          const std::int32_t* corner = stencil + vertices * lane;
          from = block.positions + 3 * static_cast<std::ptrdiff_t>(corner[0]);
          to = block.positions + 3 * static_cast<std::ptrdiff_t>(corner[j]);
        },
        e);
  }

  template <std::size_t vertices, std::size_t rows>
  static Number coefficient(const LocalBlock& block, std::size_t first, std::size_t row, std::size_t j) {
    constexpr std::size_t size = rows * (vertices - 1), lanes = lanes_of_coefficients;
    const std::size_t place = row * (vertices - 1) + j - 1;
    return Math::load(block.coefficients + (first / lanes * size + place) * lanes + first % lanes);
  }

  /// z = A S q of a type whose rows sum to zero, row after row.
  template <std::size_t vertices, std::size_t rows>
  static void reduce(const LocalBlock& block, std::size_t first, Number (&z)[3 * rows]) {
    for (Number& number : z) number = Number{};
    for (std::size_t j = 1; j < vertices; ++j) {
      Number e[3];
      difference(block, vertices, first, j, e);
      for (std::size_t row = 0; row < rows; ++row) {
        const Number c = coefficient<vertices, rows>(block, first, row, j);
        for (std::size_t axis = 0; axis < 3; ++axis)
          z[3 * row + axis] = Math::multiply_add(c, e[axis], z[3 * row + axis]);
      }
    }
  }

  static Number weight(const LocalBlock& block, std::size_t first) {
    return block.stiffness * Math::load(block.measure + first);
  }
};

}  // namespace
}  // namespace pliant
