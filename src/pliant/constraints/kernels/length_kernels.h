#pragma once
// Types whose points keep a length: edges and curvature. Compiled as lanes.h says.
#include "pliant/constraints/kernels/block.h"

namespace pliant {
namespace {

template <int width>
struct LengthKernels : Block<width> {
  using All = Block<width>;
  using Math = LaneMath<width>;
  using typename All::Sums;
  using typename Math::Mask;
  using typename Math::Number;

  /// Lengths: p = wanted(‖z‖) z/‖z‖. A length of zero, or none at all, is left.
  template <class Wanted>
  static void resize(const LocalBlock& block, std::size_t i, Number (&z)[3], Wanted wanted, Sums& sums,
                     Mask is_left = Mask{}) {
    const Number length = Math::square_root(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    const Number change = without_rounding(wanted(length) - length, length);
    const Number w = All::weight(block, i * width);
    pull(block, i, z, w * change / length);
    sums.add(i, is_left | ~(length > 0), w / 2 * change * change);
  }

  static Number without_rounding(Number change, Number length) {
    constexpr double smallest = All::rounding / 16 * (All::rounding / 16);
    return Math::select(change * change <= smallest * length * length, Number{}, change);
  }
  static void pull(const LocalBlock& block, std::size_t i, Number (&z)[3], Number factor) {
    for (Number& number : z) number *= factor;
    All::store(z, block.out + 3 * i * width);
  }

  static LocalDone edge_spring(const LocalBlock& block) {
    Sums sums;
    const std::size_t vectors = block.count / width;
    for (std::size_t i = 0; i < vectors; ++i) {
      Number z[3];
      All::difference(block, 2, i * width, 1, z);
      const Number rest = Math::load(block.fields + i * width);
      resize(
          block, i, z, [&](Number) { return rest; }, sums);
    }
    return sums.done(vectors);
  }

  /// One stretch, of an edge or along a fibre of a triangle, between its limits.
  template <std::size_t vertices>
  static LocalDone strain(const LocalBlock& block) {
    Sums sums;
    const std::size_t vectors = block.count / width;
    for (std::size_t i = 0; i < vectors; ++i) {
      Number z[3];
      All::template reduce<vertices, 1>(block, i * width, z);
      Number min, max;
      Math::load_both(block.fields + 2 * i * width, min, max);
      resize(
          block, i, z, [&](Number length) { return Math::smaller(Math::larger(length, min), max); }, sums);
    }
    return sums.done(vectors);
  }

  /// The stretch along a fibre between its limits, with what it has beyond where it is taut.
  static LocalDone taut_fibre(const LocalBlock& block) {
    Sums sums;
    const std::size_t vectors = block.count / width;
    for (std::size_t i = 0; i < vectors; ++i) {
      Number z[3];
      All::template reduce<3, 1>(block, i * width, z);
      const Number length = Math::square_root(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
      const double* of = block.fields + 5 * i * width;
      const auto field = [&](std::size_t a) { return Math::load(of, 5, a); };
      const Number nearest = Math::smaller(Math::larger(length, field(0)), field(1));
      const Number change = without_rounding(nearest - length, length);
      const Number past = without_rounding(Math::larger(length - field(2), Number{}), length);
      const Number rise = Math::smaller(past, field(3)), over = past - rise;
      const Number squared = rise * (rise / field(3)), w = All::weight(block, i * width);
      pull(block, i, z, w * (change - field(4) * (squared / 2 + over)) / length);
      sums.add(i, ~(length > 0), w / 2 * (change * change + field(4) * (squared * rise / 3 + over * past)));
    }
    return sums.done(vectors);
  }

  /// Curvature: p = 0, or of the length at rest. Summed as the builder of the type summed it at rest, without fusing.
  /// Fields: none; the length and three more; or also a sign and a normal, where z on its other side is left.
  template <std::size_t fields>
  static LocalDone curvature(const LocalBlock& block) {
    constexpr double no_direction = 1e-12;
    Sums sums;
    const std::size_t vectors = block.count / width;
    for (std::size_t i = 0; i < vectors; ++i) {
      Number z[3] = {};
      for (std::size_t j = 1; j < block.vertices; ++j) {
        Number e[3];
        All::difference(block, block.vertices, i * width, j, e);
        const Number c = Math::load(block.reduction + block.vertices * i * width, block.vertices, j);
        for (std::size_t axis = 0; axis < 3; ++axis) z[axis] += c * e[axis];
      }
      if constexpr (fields == 0) {
        const Number w = All::weight(block, i * width);
        const Number squares = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
        for (Number& number : z) number *= -w;
        All::store(z, block.out + 3 * i * width);
        sums.add(i, Mask{}, w / 2 * squares);
      } else {
        const double* of = block.fields + fields * i * width;
        const Number rest = Math::load(of, fields, 0);
        Mask is_left = ~(z[0] * z[0] + z[1] * z[1] + z[2] * z[2] >= no_direction * no_direction * rest * rest);
        if constexpr (fields > 4) {
          Number height = {};
          for (std::size_t axis = 0; axis < 3; ++axis) height += z[axis] * Math::load(of, fields, 5 + axis);
          is_left |= ~(Math::load(of, fields, 4) * height >= 0);
        }
        resize(
            block, i, z, [&](Number) { return rest; }, sums, is_left);
      }
    }
    return sums.done(vectors);
  }
};

}  // namespace
}  // namespace pliant
