#pragma once
// What libc++ 13, the standard library of Emscripten 3.1.6, lacks of C++20 and Pliant uses. The build includes it in
// front of every source there (cmake/web.cmake), and nowhere else.
#include <algorithm>
#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <type_traits>

#include "ranges_algorithms.h"

namespace std {

template <class To, class From>
requires(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> && is_trivially_copyable_v<From>) constexpr To
    bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

template <class T, size_t size>
constexpr auto operator<=>(const array<T, size>& a, const array<T, size>& b) -> decltype(a[0] <=> b[0]) {
  for (size_t i = 0; i < size; ++i) {
    if (const auto order = a[i] <=> b[i]; order != 0) return order;
  }
  return strong_ordering::equal;
}

}  // namespace std
