#include "pliant/solver/acceleration/remembered_kernels.h"

#include "pliant/core/instruction_sets.h"

namespace pliant {

std::span<const RememberedKernels* const> remembered_kernels() {
#ifdef PLIANT_HAS_X86_KERNELS
  static constexpr const RememberedKernels* all[] = {&portable_remembered_kernels, &avx2_remembered_kernels,
                                                     &avx512_remembered_kernels};
#else
  static constexpr const RememberedKernels* all[] = {&portable_remembered_kernels};
#endif
  return std::span(all).first(instruction_set_count());
}

const RememberedKernels& fastest_remembered_kernels() {
  static const RememberedKernels& fastest = *remembered_kernels().back();
  return fastest;
}

}  // namespace pliant
