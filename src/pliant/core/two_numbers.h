#pragma once
// Two numbers side by side in a register, which every processor has.

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
  void write(Real* to) const {
    __builtin_memcpy(to, &xy_, sizeof xy_);
    to[2] = z_;
  }

 private:
  TwoNumbers xy_{};
  Real z_ = 0;
};

}  // namespace pliant
