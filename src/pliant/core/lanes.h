#pragma once
// Several doubles side by side. What includes this is compiled once for each instruction set: one source file for each,
// under its own compiler flags. Nothing there may call an inline function of another header, whose code the linker
// might share between instruction sets; hence the nameless namespace and the few functions that others have as well.
#include <cstddef>
#include <cstdint>
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace pliant {
namespace {

using Pair = double __attribute__((vector_size(16)));

template <int width>
struct Lanes;
template <>
struct Lanes<2> {
  using Number = Pair;
  using Mask = long long __attribute__((vector_size(16)));
  using Single = float __attribute__((vector_size(8)));
  template <class P>  // so that the compiler looks at it only where there are registers for it
  static Number join(const P* pairs) {
    return pairs[0];
  }
  template <class N>
  static void part(const N& low, const N& high, N& even, N& odd) {
    even = __builtin_shufflevector(low, high, 0, 2);
    odd = __builtin_shufflevector(low, high, 1, 3);
  }
};
template <>
struct Lanes<4> {
  using Number = double __attribute__((vector_size(32)));
  using Mask = long long __attribute__((vector_size(32)));
  using Single = float __attribute__((vector_size(16)));
  template <class P>  // so that the compiler looks at it only where there are registers for it
  static Number join(const P* pairs) {
    return __builtin_shufflevector(pairs[0], pairs[1], 0, 1, 2, 3);
  }
  template <class N>
  static void part(const N& low, const N& high, N& even, N& odd) {
    even = __builtin_shufflevector(low, high, 0, 2, 4, 6);
    odd = __builtin_shufflevector(low, high, 1, 3, 5, 7);
  }
};
template <>
struct Lanes<8> {
  using Number = double __attribute__((vector_size(64)));
  using Mask = long long __attribute__((vector_size(64)));
  using Single = float __attribute__((vector_size(32)));
  template <class P>  // so that the compiler looks at it only where there are registers for it
  static Number join(const P* pairs) {
    return __builtin_shufflevector(Lanes<4>::join(pairs), Lanes<4>::join(pairs + 2), 0, 1, 2, 3, 4, 5, 6, 7);
  }
  template <class N>
  static void part(const N& low, const N& high, N& even, N& odd) {
    even = __builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14);
    odd = __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15);
  }
};

template <int width>
struct LaneMath : Lanes<width> {
  using typename Lanes<width>::Number;
  using typename Lanes<width>::Mask;
  using typename Lanes<width>::Single;
  using Lanes<width>::join;

  /// What get(lane) returns in each lane.
  template <class Get>
  static Number each(Get get) {
    Pair pairs[width / 2];
    for (std::size_t i = 0; i < width / 2; ++i) pairs[i] = Pair{get(2 * i), get(2 * i + 1)};
    return join(pairs);
  }

  static Pair load_pair(const double* from) {
    Pair pair;
    __builtin_memcpy(&pair, from, sizeof pair);
    return pair;
  }
  static void store_pair(Pair pair, double* to) { __builtin_memcpy(to, &pair, sizeof pair); }

  static Number load(const double* from) {
    Number all;
    __builtin_memcpy(&all, from, sizeof all);
    return all;
  }
  /// Number a of `size` of each lane, which stand one lane after the other.
  static Number load(const double* from, std::size_t size, std::size_t a) {
    return each([&](std::size_t lane) { return from[size * lane + a]; });
  }
  /// Both numbers of each lane, which stand one lane after the other.
  static void load_both(const double* from, Number& first, Number& second) {
    Lanes<width>::part(load(from), load(from + width), first, second);
  }

  static Number select(Mask mask, Number yes, Number no) { return mask ? yes : no; }
  static Number larger(Number a, Number b) { return select(a > b, a, b); }
  static Number smaller(Number a, Number b) { return select(a < b, a, b); }
  static Number square_root(Number x) {
    for (int lane = 0; lane < width; ++lane) x[lane] = __builtin_sqrt(x[lane]);
    return x;
  }
  static Single square_root(Single x) {
    for (int lane = 0; lane < width; ++lane) x[lane] = __builtin_sqrtf(x[lane]);
    return x;
  }
  static Single to_single(Number x) {
#ifdef __AVX512F__
    if constexpr (width == 8) return _mm512_cvtpd_ps(x);  // in one go, which g++ 12 does not do by itself
#endif
    return __builtin_convertvector(x, Single);
  }
  static Number to_double(Single x) {
#ifdef __AVX512F__
    if constexpr (width == 8) return _mm512_cvtps_pd(x);
#endif
    return __builtin_convertvector(x, Number);
  }
  /// a b + c, rounded once where the processor can.
  static Number multiply_add(Number a, Number b, Number c) {
#ifdef __AVX512F__
    if constexpr (width == 8) return _mm512_fmadd_pd(a, b, c);
#endif
#ifdef __FMA__
    if constexpr (width == 4) return _mm256_fmadd_pd(a, b, c);
#endif
    return a * b + c;
  }
  static double sum(Number x) {
    double all = 0;
    for (int lane = 0; lane < width; ++lane) all += x[lane];
    return all;
  }
  static bool any(Mask mask) {
    return bits(mask) != 0;
  }
  /// One bit a lane; those of a mask are all set, or none is.
  static std::uint64_t bits(Mask mask) {
#ifdef __AVX512DQ__
    if constexpr (width == 8) return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask));
#endif
#ifdef __AVX__
    if constexpr (width == 4) return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
#endif
    std::uint64_t all = 0;
    for (int lane = 0; lane < width; ++lane) all |= std::uint64_t{mask[lane] != 0} << lane;
    return all;
  }
};

}  // namespace
}  // namespace pliant
