#include "pliant/constraints/kernels/local_kernels.h"

#include "pliant/core/instruction_sets.h"

namespace pliant {

std::span<const LocalKernels* const> local_kernels() {
#ifdef PLIANT_HAS_X86_KERNELS
  static constexpr const LocalKernels* all[] = {&portable_kernels, &avx2_kernels, &avx512_kernels};
#else
  static constexpr const LocalKernels* all[] = {&portable_kernels};
#endif
  return std::span(all).first(instruction_set_count());
}

const LocalKernels& fastest_kernels() {
  static const LocalKernels& fastest = *local_kernels().back();
  return fastest;
}

}  // namespace pliant
