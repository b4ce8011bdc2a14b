#pragma once
// Boxes in single precision, eight side by side, so that eight are tested against eight at once. The types are those of
// the compiler's vector extensions, four numbers wide: every x86-64 and ARM processor has such registers.
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "pliant/core/types.h"

namespace pliant::collision {

using FourFloats = float __attribute__((vector_size(16)));
using FourIndices = std::int32_t __attribute__((vector_size(16)));

constexpr std::size_t boxes_side_by_side = 8;

/// The greatest float that is not above x, or the least not below it; past the range of floats its ends. Both are
/// monotone, so what meets in double precision meets after it.
inline float rounded_down(Real x) {
  constexpr Real limit = Real{std::numeric_limits<float>::max()};
  const Real above = x > -limit ? x : -limit;
  const Real inside = above < limit ? above : limit;
  const auto nearest = static_cast<float>(inside);
  // The float below, without a branch that half of all numbers take; a number that is below 0 does not become +0.
  auto bits = std::bit_cast<std::int32_t>(nearest);
  const std::int32_t down = bits < 0 ? 1 : -1;
  bits += Real{nearest} > inside ? down : 0;
  return std::bit_cast<float>(bits);
}
inline float rounded_up(Real x) {
  return -rounded_down(-x);
}

/// From low to high; the fourth numbers are 0.
struct FloatBox {
  FourFloats low, high;

  bool meets(const FloatBox& other) const {
    const auto misses = (low > other.high) | (other.low > high);
    return misses[0] == 0 && misses[1] == 0 && misses[2] == 0;
  }
  void add(const FloatBox& other) {
    low = low < other.low ? low : other.low;
    high = high > other.high ? high : other.high;
  }
};

/// One bit for each number of a comparison.
inline unsigned bits_of(FourIndices mask) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  return (mask[0] != 0 ? 1U : 0U) | (mask[1] != 0 ? 2U : 0U) | (mask[2] != 0 ? 4U : 0U) | (mask[3] != 0 ? 8U : 0U);
#endif
}

inline FourFloats four_of(float x) {
  return FourFloats{x, x, x, x};
}
inline FourIndices four_of(Index x) {
  return FourIndices{x, x, x, x};
}

inline FourFloats four_at(const float* from) {
  FourFloats four;
  __builtin_memcpy(&four, from, sizeof four);
  return four;
}
inline FourIndices four_at(const Index* from) {
  FourIndices four;
  __builtin_memcpy(&four, from, sizeof four);
  return four;
}

inline FourFloats smaller(FourFloats a, FourFloats b) {
  return a < b ? a : b;
}
inline FourFloats larger(FourFloats a, FourFloats b) {
  return a > b ? a : b;
}

/// The first three columns of four rows.
struct ThreeColumns {
  FourFloats first, second, third;
};
inline ThreeColumns columns_of(FourFloats a, FourFloats b, FourFloats c, FourFloats d) {
  const FourFloats low_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const FourFloats low_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const FourFloats high_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const FourFloats high_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(low_ab, low_cd, 0, 1, 4, 5), __builtin_shufflevector(low_ab, low_cd, 2, 3, 6, 7),
          __builtin_shufflevector(high_ab, high_cd, 0, 1, 4, 5)};
}

struct alignas(64) EightBoxes {
  float low[3][boxes_side_by_side];
  float high[3][boxes_side_by_side];

  void set(std::size_t i, const FloatBox& box) {
    for (std::size_t a = 0; a < 3; ++a) low[a][i] = box.low[a], high[a][i] = box.high[a];
  }
  /// It meets nothing then.
  void set_empty(std::size_t i) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a][i] = std::numeric_limits<float>::infinity(), high[a][i] = -std::numeric_limits<float>::infinity();
    }
  }
  bool is_empty(std::size_t i) const { return low[0][i] > high[0][i]; }
  void set_all(const std::array<FloatBox, boxes_side_by_side>& boxes) {
    const auto set_four = [](float(&numbers)[3][boxes_side_by_side], std::size_t first, const ThreeColumns& columns) {
      __builtin_memcpy(&numbers[0][first], &columns.first, sizeof columns.first);
      __builtin_memcpy(&numbers[1][first], &columns.second, sizeof columns.second);
      __builtin_memcpy(&numbers[2][first], &columns.third, sizeof columns.third);
    };
    for (std::size_t i = 0; i < boxes_side_by_side; i += 4) {
      set_four(low, i, columns_of(boxes[i].low, boxes[i + 1].low, boxes[i + 2].low, boxes[i + 3].low));
      set_four(high, i, columns_of(boxes[i].high, boxes[i + 1].high, boxes[i + 2].high, boxes[i + 3].high));
    }
  }
  FloatBox hull() const {
    const auto merged = [](const float(&numbers)[3][boxes_side_by_side], auto&& merge) {
      const auto of_axis = [&](std::size_t a) { return merge(four_at(numbers[a]), four_at(numbers[a] + 4)); };
      const FourFloats x = of_axis(0), y = of_axis(1), z = of_axis(2), none{};
      const FourFloats low_xy = __builtin_shufflevector(x, y, 0, 4, 1, 5),
                       low_z = __builtin_shufflevector(z, none, 0, 4, 1, 5);
      const FourFloats high_xy = __builtin_shufflevector(x, y, 2, 6, 3, 7),
                       high_z = __builtin_shufflevector(z, none, 2, 6, 3, 7);
      const FourFloats xy = merge(low_xy, high_xy), of_z = merge(low_z, high_z);
      return merge(__builtin_shufflevector(xy, of_z, 0, 1, 4, 5), __builtin_shufflevector(xy, of_z, 2, 3, 6, 7));
    };
    return {merged(low, smaller), merged(high, larger)};
  }
};

/// Bit j: box j of b meets box i of a.
inline unsigned meeting_row(const EightBoxes& a, std::size_t i, const EightBoxes& b) {
  unsigned bits = 0;
  for (std::size_t half = 0; half < 2; ++half) {
    FourIndices meets = four_of(Index{-1});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      meets &= (four_of(a.low[axis][i]) <= four_at(&b.high[axis][4 * half])) &
               (four_at(&b.low[axis][4 * half]) <= four_of(a.high[axis][i]));
    }
    bits |= bits_of(meets) << (4 * half);
  }
  return bits;
}

}  // namespace pliant::collision
