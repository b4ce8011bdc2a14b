#pragma once
// Included as triangular_solve_kernel.h is, by sources for x86.
#include <immintrin.h>

namespace pliant {
namespace {

/// While it lives, numbers too small to be normal count as zero: they fade out along a substitution, and each operation
/// with one would cost a hundred times as much.
class FlushMode {
 public:
  FlushMode() { _mm_setcsr(before_ | flush_to_zero | denormals_are_zero); }
  ~FlushMode() { _mm_setcsr(before_); }
  FlushMode(const FlushMode&) = delete;
  FlushMode& operator=(const FlushMode&) = delete;

 private:
  static constexpr unsigned flush_to_zero = 0x8000;
  static constexpr unsigned denormals_are_zero = 0x0040;
  unsigned before_ = _mm_getcsr();
};

}  // namespace
}  // namespace pliant
