#pragma once
// Two numbers side by side in a register, which every processor has.
#include <cstddef>
#include <cstdint>

#include "pliant/core/types.h"

namespace pliant {

using TwoNumbers = Real __attribute__((vector_size(2 * sizeof(Real))));

inline TwoNumbers two_numbers_at(const Real* from) {
  TwoNumbers two;
  __builtin_memcpy(&two, from, sizeof two);
  return two;
}

/// Of vectors that lie as x, y, z: each number added up by itself, in the order in which they come.
class VectorSum {
 public:
  void add(const Real* v) {
    xy_ += two_numbers_at(v);
    z_ += v[2];
  }
  /// v where `sign` is 0, −v where it is 1.
  void add_signed(std::size_t sign, const Real* v) {
    xy_ += reinterpret_cast<TwoNumbers>(reinterpret_cast<TwoSigns>(two_numbers_at(v)) ^ signs[sign]);
    const TwoNumbers z{v[2], 0};
    z_ += reinterpret_cast<TwoNumbers>(reinterpret_cast<TwoSigns>(z) ^ signs[sign])[0];
  }
  void add(Real factor, const Real* v) {
    xy_ += TwoNumbers{factor, factor} * two_numbers_at(v);
    z_ += factor * v[2];
  }
  void write(Real* to) const {
    __builtin_memcpy(to, &xy_, sizeof xy_);
    to[2] = z_;
  }

 private:
  using TwoSigns = std::uint64_t __attribute__((vector_size(2 * sizeof(std::uint64_t))));
  static constexpr std::uint64_t first_bit = std::uint64_t{1} << 63;
  static constexpr TwoSigns signs[2] = {{0, 0}, {first_bit, first_bit}};

  TwoNumbers xy_{};
  Real z_ = 0;
};

}  // namespace pliant
