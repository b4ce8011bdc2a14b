#pragma once
// Products and sums of remembered vectors, for the instruction set of the processor at hand. The bits are the same on
// all of them: nothing is fused, and sums are taken in the same order.
#include <cstddef>
#include <span>

namespace pliant {

/// q ← q + d with d = factor x + Σ (factors[2 i] vectors[2 i] + factors[2 i + 1] vectors[2 i + 1]); all lists of
/// numbers have the same length.
struct RememberedMove {
  double factor = 0;
  const double* x = nullptr;
  const float* const* vectors = nullptr;
  const double* factors = nullptr;
  std::size_t pairs = 0;
  double* q = nullptr;
  double* before = nullptr;  ///< q as it was
  float* move = nullptr;     ///< d
};

struct RememberedKernels {
  /// sums[i] ← vectors[i]ᵀ c of so many vectors, each in eight sums side by side.
  void (*products)(const float* const* vectors, std::size_t many, const double* c, std::size_t count, double* sums);
  double (*product)(const double* a, const double* c, std::size_t count);
  void (*move)(const RememberedMove& move, std::size_t count);
  const char* instruction_set;
};

/// All that this processor can run, the fastest last.
std::span<const RememberedKernels* const> remembered_kernels();
const RememberedKernels& fastest_remembered_kernels();

extern const RememberedKernels portable_remembered_kernels;
extern const RememberedKernels avx2_remembered_kernels;  // defined where the compiler has the instruction set
extern const RememberedKernels avx512_remembered_kernels;

}  // namespace pliant
