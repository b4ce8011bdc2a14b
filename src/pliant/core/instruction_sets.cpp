#include "pliant/core/instruction_sets.h"

namespace pliant {
namespace {

std::size_t count() {
#ifdef PLIANT_HAS_X86_KERNELS
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                          __builtin_cpu_supports("avx512vl");
  return 1 + static_cast<std::size_t>(has_avx2) + static_cast<std::size_t>(has_avx512);
#else
  return 1;
#endif
}

}  // namespace

std::size_t instruction_set_count() {
  static const std::size_t found = count();
  return found;
}

}  // namespace pliant
