#include "pliant/solver/factorization/sweeps.h"

namespace pliant {
namespace {

/// How many of the instruction sets portable, AVX2 and AVX-512 there are.
std::size_t count_instruction_sets() {
#ifdef PLIANT_HAS_X86_SWEEPS
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                          __builtin_cpu_supports("avx512vl");
  return 1 + static_cast<std::size_t>(has_avx2) + static_cast<std::size_t>(has_avx512);
#else
  return 1;
#endif
}

template <class T>
std::span<const Sweeps<T>* const> first_of(std::span<const Sweeps<T>* const> all) {
  static const std::size_t count = count_instruction_sets();
  return all.first(count);
}

}  // namespace

template <>
std::span<const Sweeps<float>* const> all_sweeps<float>() {
#ifdef PLIANT_HAS_X86_SWEEPS
  static constexpr const Sweeps<float>* all[] = {&portable_sweeps_single, &avx2_sweeps_single, &avx512_sweeps_single};
#else
  static constexpr const Sweeps<float>* all[] = {&portable_sweeps_single};
#endif
  return first_of<float>(all);
}

template <>
std::span<const Sweeps<double>* const> all_sweeps<double>() {
#ifdef PLIANT_HAS_X86_SWEEPS
  static constexpr const Sweeps<double>* all[] = {&portable_sweeps_double, &avx2_sweeps_double, &avx512_sweeps_double};
#else
  static constexpr const Sweeps<double>* all[] = {&portable_sweeps_double};
#endif
  return first_of<double>(all);
}

}  // namespace pliant
