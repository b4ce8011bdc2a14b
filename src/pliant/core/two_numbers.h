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

}  // namespace pliant
