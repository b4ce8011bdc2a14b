#include "pliant/solver/global/factorization/sweeps.h"

#include "pliant/core/instruction_sets.h"

namespace pliant {
template <>
std::span<const Sweeps<float>* const> all_sweeps<float>() {
#ifdef PLIANT_HAS_X86_KERNELS
  static constexpr const Sweeps<float>* all[] = {&portable_sweeps_single, &avx2_sweeps_single, &avx512_sweeps_single};
#else
  static constexpr const Sweeps<float>* all[] = {&portable_sweeps_single};
#endif
  return std::span(all).first(instruction_set_count());
}

template <>
std::span<const Sweeps<double>* const> all_sweeps<double>() {
#ifdef PLIANT_HAS_X86_KERNELS
  static constexpr const Sweeps<double>* all[] = {&portable_sweeps_double, &avx2_sweeps_double, &avx512_sweeps_double};
#else
  static constexpr const Sweeps<double>* all[] = {&portable_sweeps_double};
#endif
  return std::span(all).first(instruction_set_count());
}

}  // namespace pliant
