#include "pliant/solver/global/factorization/triangular_solve.h"

#include "pliant/core/instruction_sets.h"

namespace pliant {
template <>
std::span<const TriangularSolve<float>* const> all_triangular_solves<float>() {
#ifdef PLIANT_HAS_X86_KERNELS
  static constexpr const TriangularSolve<float>* all[] = {
      &portable_triangular_solve_single, &avx2_triangular_solve_single, &avx512_triangular_solve_single};
#else
  static constexpr const TriangularSolve<float>* all[] = {&portable_triangular_solve_single};
#endif
  return std::span(all).first(instruction_set_count());
}

template <>
std::span<const TriangularSolve<double>* const> all_triangular_solves<double>() {
#ifdef PLIANT_HAS_X86_KERNELS
  static constexpr const TriangularSolve<double>* all[] = {
      &portable_triangular_solve_double, &avx2_triangular_solve_double, &avx512_triangular_solve_double};
#else
  static constexpr const TriangularSolve<double>* all[] = {&portable_triangular_solve_double};
#endif
  return std::span(all).first(instruction_set_count());
}

}  // namespace pliant
