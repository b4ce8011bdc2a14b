#include "pliant/solver/factorization/sweeps.h"

namespace pliant {

const Sweeps& sweeps() {
#ifdef PLIANT_HAS_AVX2_SWEEPS
  static const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (has_avx2) return avx2_sweeps;
#endif
  return portable_sweeps;
}

}  // namespace pliant
