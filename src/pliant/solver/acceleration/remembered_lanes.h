#pragma once
// The kernels of remembered_kernels.h, for any number of lanes; compiled as lanes.h says.
#include "pliant/core/lanes.h"
#include "pliant/solver/acceleration/remembered_kernels.h"

namespace pliant {
namespace {

template <int width>
struct RememberedLanes : LaneMath<width> {
  using Math = LaneMath<width>;
  using typename Math::Number;
  using typename Math::Single;

  static Number load(const double* from) { return Math::load(from); }
  static Number load(const float* from) {
    Single all;
    __builtin_memcpy(&all, from, sizeof all);
    return Math::to_double(all);
  }

  /// Of `many` vectors, whose sums do not wait for each other.
  template <std::size_t many, class T>
  static void products_of(const T* const* vectors, const double* c, std::size_t count, double* results) {
    constexpr std::size_t together = 8, parts = together / width;
    Number sums[many][parts] = {};
    std::size_t i = 0;
    for (; i + together <= count; i += together) {
      for (std::size_t part = 0; part < parts; ++part) {
        const Number factor = load(c + i + part * width);
        for (std::size_t v = 0; v < many; ++v) sums[v][part] += load(vectors[v] + i + part * width) * factor;
      }
    }
    for (std::size_t v = 0; v < many; ++v) {
      double lanes[together];
      __builtin_memcpy(lanes, sums[v], sizeof lanes);
      for (std::size_t k = 0; i + k < count; ++k) lanes[k] += static_cast<double>(vectors[v][i + k]) * c[i + k];
      results[v] = 0;
      for (const double lane : lanes) results[v] += lane;
    }
  }
  static void products(const float* const* vectors, std::size_t many, const double* c, std::size_t count,
                       double* results) {
    std::size_t first = 0;
    for (; first + 4 <= many; first += 4) products_of<4>(vectors + first, c, count, results + first);
    for (; first < many; ++first) products_of<1>(vectors + first, c, count, results + first);
  }
  static double product(const double* a, const double* c, std::size_t count) {
    double result = 0;
    products_of<1>(&a, c, count, &result);
    return result;
  }

  static void move(const RememberedMove& move, std::size_t count) {
    std::size_t i = 0;
    for (; i + width <= count; i += width) {
      Number sum = move.factor * load(move.x + i);
      for (std::size_t k = 0; k < 2 * move.pairs; k += 2) {
        sum += move.factors[k] * load(move.vectors[k] + i) + move.factors[k + 1] * load(move.vectors[k + 1] + i);
      }
      const Number before = load(move.q + i), after = before + sum;
      const Single kept = Math::to_single(sum);
      __builtin_memcpy(move.before + i, &before, sizeof before);
      __builtin_memcpy(move.q + i, &after, sizeof after);
      __builtin_memcpy(move.move + i, &kept, sizeof kept);
    }
    for (; i < count; ++i) {
      double sum = move.factor * move.x[i];
      for (std::size_t k = 0; k < 2 * move.pairs; k += 2) {
        sum += move.factors[k] * static_cast<double>(move.vectors[k][i]) +
               move.factors[k + 1] * static_cast<double>(move.vectors[k + 1][i]);
      }
      move.before[i] = move.q[i];
      move.q[i] += sum;
      move.move[i] = static_cast<float>(sum);
    }
  }
};

template <int width>
constexpr RememberedKernels remembered_kernels_of(const char* instruction_set) {
  using Lanes = RememberedLanes<width>;
  return {Lanes::products, Lanes::product, Lanes::move, instruction_set};
}

}  // namespace
}  // namespace pliant
