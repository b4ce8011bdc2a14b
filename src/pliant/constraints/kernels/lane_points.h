#pragma once
// How points of three numbers come from memory into lanes, and go back. Compiled as lanes.h says. With AVX a point is
// read in one go, with a zero after it, and written by fours; shuffles between whole vectors do the rest, as few as
// there can be, since many processors do one a cycle.
#include "pliant/core/lanes.h"

namespace pliant {
namespace {

/// In pairs and single numbers.
template <int width>
struct LanePoints : LaneMath<width> {
  using typename LaneMath<width>::Number;
  using LaneMath<width>::join;
  using LaneMath<width>::load_pair;

  /// e ← b − a of each lane: ends(lane, a, b) says where they are.
  template <class Ends>
  static void subtract(Ends ends, Number (&e)[3]) {
    Pair x[width / 2], y[width / 2], z[width / 2];
    for (std::size_t i = 0; i < width / 2; ++i) {
      const double *a0, *b0, *a1, *b1;
      ends(2 * i, a0, b0);
      ends(2 * i + 1, a1, b1);
      const Pair first = load_pair(b0) - load_pair(a0);
      const Pair second = load_pair(b1) - load_pair(a1);
      x[i] = __builtin_shufflevector(first, second, 0, 2);
      y[i] = __builtin_shufflevector(first, second, 1, 3);
      z[i] = Pair{b0[2] - a0[2], b1[2] - a1[2]};
    }
    e[0] = join(x), e[1] = join(y), e[2] = join(z);
  }

  /// `size` numbers of each lane, one lane after the other.
  template <std::size_t size>
  static void store(const Number (&numbers)[size], double* to) {
    for (std::size_t lane = 0; lane < width; ++lane) {
      for (std::size_t a = 0; a < size; ++a) to[size * lane + a] = numbers[a][lane];
    }
  }
  static void store(const Number (&point)[3], double* to) {
    for (int i = 0; i < width; i += 2, to += 6) {
      const Pair x = {point[0][i], point[0][i + 1]}, y = {point[1][i], point[1][i + 1]},
                 z = {point[2][i], point[2][i + 1]};
      LaneMath<width>::store_pair(__builtin_shufflevector(x, y, 0, 2), to);
      LaneMath<width>::store_pair(__builtin_shufflevector(z, x, 0, 3), to + 2);
      LaneMath<width>::store_pair(__builtin_shufflevector(y, z, 1, 3), to + 4);
    }
  }
};

#ifdef __AVX__
using Quad = double __attribute__((vector_size(32)));

template <class Vector>
void put(const Vector& numbers, double* to) {
  __builtin_memcpy(to, &numbers, sizeof numbers);
}

/// A point and a zero.
inline Quad load_point(const double* from) {
#ifdef __AVX512VL__
  return _mm256_maskz_loadu_pd(7, from);
#else
  return _mm256_maskload_pd(from, _mm256_setr_epi64x(-1, -1, -1, 0));
#endif
}

template <class Ends>
Quad difference_of_points(Ends ends, std::size_t lane) {
  const double *a, *b;
  ends(lane, a, b);
  return load_point(b) - load_point(a);
}

/// Numbers of each lane, one lane after the other; those that are left over one by one.
template <class Points, class Number, std::size_t size>
void store_by_fours(const Number (&numbers)[size], double* to) {
  constexpr std::size_t whole = size / 4 * 4, lanes = sizeof(Number) / sizeof(double);
  for (std::size_t a = 0; a < whole; a += 4) Points::store_four(numbers + a, to + a, size);
  for (std::size_t a = whole; a < size; ++a) {
    for (std::size_t lane = 0; lane < lanes; ++lane) to[size * lane + a] = numbers[a][lane];
  }
}

template <>
struct LanePoints<4> : LaneMath<4> {
  template <class Ends>
  static void subtract(Ends ends, Quad (&e)[3]) {
    const Quad p0 = difference_of_points(ends, 0), p1 = difference_of_points(ends, 1);
    const Quad p2 = difference_of_points(ends, 2), p3 = difference_of_points(ends, 3);
    const Quad x01 = __builtin_shufflevector(p0, p1, 0, 4, 2, 6), x23 = __builtin_shufflevector(p2, p3, 0, 4, 2, 6);
    const Quad y01 = __builtin_shufflevector(p0, p1, 1, 5, 3, 7), y23 = __builtin_shufflevector(p2, p3, 1, 5, 3, 7);
    e[0] = __builtin_shufflevector(x01, x23, 0, 1, 4, 5);
    e[1] = __builtin_shufflevector(y01, y23, 0, 1, 4, 5);
    e[2] = __builtin_shufflevector(x01, x23, 2, 3, 6, 7);
  }

  template <std::size_t size>
  static void store(const Quad (&numbers)[size], double* to) {
    store_by_fours<LanePoints>(numbers, to);
  }
  static void store(const Quad (&point)[3], double* to) {
    const Quad xy = __builtin_shufflevector(point[0], point[1], 0, 4, 2, 6);
    const Quad zx = __builtin_shufflevector(point[2], point[0], 0, 5, 2, 7);
    const Quad yz = __builtin_shufflevector(point[1], point[2], 1, 5, 3, 7);
    put(__builtin_shufflevector(xy, zx, 0, 1, 4, 5), to);
    put(__builtin_shufflevector(yz, xy, 0, 1, 6, 7), to + 4);
    put(__builtin_shufflevector(zx, yz, 2, 3, 6, 7), to + 8);
  }

  static void store_four(const Quad* n, double* to, std::size_t stride) {
    const Quad even = __builtin_shufflevector(n[0], n[1], 0, 4, 2, 6);
    const Quad odd = __builtin_shufflevector(n[0], n[1], 1, 5, 3, 7);
    const Quad even_after = __builtin_shufflevector(n[2], n[3], 0, 4, 2, 6);
    const Quad odd_after = __builtin_shufflevector(n[2], n[3], 1, 5, 3, 7);
    put(__builtin_shufflevector(even, even_after, 0, 1, 4, 5), to);
    put(__builtin_shufflevector(odd, odd_after, 0, 1, 4, 5), to + stride);
    put(__builtin_shufflevector(even, even_after, 2, 3, 6, 7), to + 2 * stride);
    put(__builtin_shufflevector(odd, odd_after, 2, 3, 6, 7), to + 3 * stride);
  }
};
#endif

#ifdef __AVX512F__
template <>
struct LanePoints<8> : LaneMath<8> {
  template <class Ends>
  static void subtract(Ends ends, Number (&e)[3]) {
    const auto both = [&](std::size_t first, std::size_t second) {
      return __builtin_shufflevector(difference_of_points(ends, first), difference_of_points(ends, second), 0, 1, 2, 3,
                                     4, 5, 6, 7);
    };
    const Number p02 = both(0, 2), p13 = both(1, 3), p46 = both(4, 6), p57 = both(5, 7);
    const Number x = low(p02, p13), x_after = low(p46, p57);
    const Number y = high(p02, p13), y_after = high(p46, p57);
    e[0] = __builtin_shufflevector(x, x_after, 0, 1, 4, 5, 8, 9, 12, 13);
    e[1] = __builtin_shufflevector(y, y_after, 0, 1, 4, 5, 8, 9, 12, 13);
    e[2] = __builtin_shufflevector(x, x_after, 2, 3, 6, 7, 10, 11, 14, 15);
  }

  template <std::size_t size>
  static void store(const Number (&numbers)[size], double* to) {
    store_by_fours<LanePoints>(numbers, to);
  }
  static void store(const Number (&point)[3], double* to) {
    const Number &x = point[0], &y = point[1], &z = point[2];
    const Number first = __builtin_shufflevector(x, y, 0, 8, 0, 1, 9, 0, 2, 10);
    const Number second = __builtin_shufflevector(x, y, 0, 3, 11, 0, 4, 12, 0, 5);
    const Number third = __builtin_shufflevector(x, y, 13, 0, 6, 14, 0, 7, 15, 0);
    put(__builtin_shufflevector(first, z, 0, 1, 8, 3, 4, 9, 6, 7), to);
    put(__builtin_shufflevector(second, z, 10, 1, 2, 11, 4, 5, 12, 7), to + 8);
    put(__builtin_shufflevector(third, z, 0, 13, 2, 3, 14, 5, 6, 15), to + 16);
  }

  static void store_four(const Number* n, double* to, std::size_t stride) {
    const Number even = low(n[0], n[1]), even_after = low(n[2], n[3]);
    const Number odd = high(n[0], n[1]), odd_after = high(n[2], n[3]);
    put_two(__builtin_shufflevector(even, even_after, 0, 1, 8, 9, 2, 3, 10, 11), to, to + 2 * stride);
    put_two(__builtin_shufflevector(even, even_after, 4, 5, 12, 13, 6, 7, 14, 15), to + 4 * stride, to + 6 * stride);
    put_two(__builtin_shufflevector(odd, odd_after, 0, 1, 8, 9, 2, 3, 10, 11), to + stride, to + 3 * stride);
    put_two(__builtin_shufflevector(odd, odd_after, 4, 5, 12, 13, 6, 7, 14, 15), to + 5 * stride, to + 7 * stride);
  }

 private:
  /// Of each two numbers those of even lanes, or of odd ones.
  static Number low(Number a, Number b) { return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14); }
  static Number high(Number a, Number b) { return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15); }

  static void put_two(Number both, double* first, double* second) {
    put(__builtin_shufflevector(both, both, 0, 1, 2, 3), first);
    put(__builtin_shufflevector(both, both, 4, 5, 6, 7), second);
  }
};
#endif

}  // namespace
}  // namespace pliant
