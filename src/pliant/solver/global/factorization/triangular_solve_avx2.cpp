// Compiled with AVX2 and fused multiply-adds (see the folder's list in CMakeLists.txt); run only where they exist.
#include <immintrin.h>

#include "pliant/solver/global/factorization/panel_values_kernel.h"
#include "pliant/solver/global/factorization/triangular_solve_flush_mode.h"
#include "pliant/solver/global/factorization/triangular_solve_generic_lanes.h"

namespace pliant {
namespace {

/// Two rows a register.
struct SingleLanes {
  using Scalar = float;
  struct Block {
    __m256 low, high;
  };
  using Sum = Block;
  using Spread = __m256;
  using Mode = FlushMode;
  static constexpr int row_blocks_at_once = 2;
  static constexpr int columns_at_once = 4;

  static Block zero() { return {_mm256_setzero_ps(), _mm256_setzero_ps()}; }
  static Sum zero_sum() { return zero(); }
  static __m256 spread(const float* x) { return _mm256_broadcast_ps(reinterpret_cast<const __m128*>(x)); }
  static __m256 pair(__m128 a, __m128 b) { return _mm256_insertf128_ps(_mm256_castps128_ps256(a), b, 1); }
  /// value[0] in the lower half's lanes, value[1] in the upper's.
  static __m256 expand(const float* value) {
    const __m256 both = _mm256_castpd_ps(_mm256_broadcast_sd(reinterpret_cast<const double*>(value)));
    return _mm256_permutevar_ps(both, _mm256_set_epi32(1, 1, 1, 1, 0, 0, 0, 0));
  }
  static Block load(const float* x, std::int32_t rows) {
    if (rows >= 4) return {_mm256_loadu_ps(x), _mm256_loadu_ps(x + 8)};
    const __m128 none = _mm_setzero_ps();
    const __m128 second = rows > 1 ? _mm_loadu_ps(x + 4) : none;
    const __m128 third = rows > 2 ? _mm_loadu_ps(x + 8) : none;
    return {pair(_mm_loadu_ps(x), second), pair(third, none)};
  }
  static void store(float* x, const Block& block, std::int32_t rows) {
    if (rows >= 4) {
      _mm256_storeu_ps(x, block.low);
      _mm256_storeu_ps(x + 8, block.high);
      return;
    }
    _mm_storeu_ps(x, _mm256_castps256_ps128(block.low));
    if (rows > 1) _mm_storeu_ps(x + 4, _mm256_extractf128_ps(block.low, 1));
    if (rows > 2) _mm_storeu_ps(x + 8, _mm256_castps256_ps128(block.high));
  }
  static __m128 row_at(const float* x, std::int32_t row) {
    return _mm_loadu_ps(x + 4 * static_cast<std::ptrdiff_t>(row));
  }
  static Block gather(const float* x, const std::int32_t* row) {
    return {pair(row_at(x, row[0]), row_at(x, row[1])), pair(row_at(x, row[2]), row_at(x, row[3]))};
  }
  static void subtract_row(float* x, std::int32_t row, __m128 value) {
    _mm_storeu_ps(x + 4 * static_cast<std::ptrdiff_t>(row), _mm_sub_ps(row_at(x, row), value));
  }
  static void scatter_subtract(float* x, const std::int32_t* row, const Block& block) {
    subtract_row(x, row[0], _mm256_castps256_ps128(block.low));
    subtract_row(x, row[1], _mm256_extractf128_ps(block.low, 1));
    subtract_row(x, row[2], _mm256_castps256_ps128(block.high));
    subtract_row(x, row[3], _mm256_extractf128_ps(block.high, 1));
  }
  static void add_product(Block& sum, const float* value, __m256 x) {
    sum.low = _mm256_fmadd_ps(expand(value), x, sum.low);
    sum.high = _mm256_fmadd_ps(expand(value + 2), x, sum.high);
  }
  static void add_dot(Sum& sum, const float* value, const Block& x) {
    sum.low = _mm256_fmadd_ps(expand(value), x.low, sum.low);
    sum.high = _mm256_fmadd_ps(expand(value + 2), x.high, sum.high);
  }
  static __m256 reduce_two(const Sum& a, const Sum& b) {
    const __m256 of_a = _mm256_add_ps(a.low, a.high);
    const __m256 of_b = _mm256_add_ps(b.low, b.high);
    return _mm256_add_ps(_mm256_permute2f128_ps(of_a, of_b, 0x20), _mm256_permute2f128_ps(of_a, of_b, 0x31));
  }
  static Block reduce(const Sum* sum) { return {reduce_two(sum[0], sum[1]), reduce_two(sum[2], sum[3])}; }
  static Block difference(const Block& a, const Block& b) {
    return {_mm256_sub_ps(a.low, b.low), _mm256_sub_ps(a.high, b.high)};
  }
  static void subtract_sum(float* x, const Sum& sum) {
    const __m256 half = _mm256_add_ps(sum.low, sum.high);
    subtract_row(x, 0, _mm_add_ps(_mm256_castps256_ps128(half), _mm256_extractf128_ps(half, 1)));
  }
};

struct DoubleLanes : GenericLanes<double> {
  using Mode = FlushMode;
};

}  // namespace

const TriangularSolve<float> avx2_triangular_solve_single = {
    Kernel<SingleLanes>::forward, Kernel<SingleLanes>::backward, PanelValues<4, float>::write, "AVX2"};
const TriangularSolve<double> avx2_triangular_solve_double = {
    Kernel<DoubleLanes>::forward, Kernel<DoubleLanes>::backward, PanelValues<4, double>::write, "AVX2"};

}  // namespace pliant
