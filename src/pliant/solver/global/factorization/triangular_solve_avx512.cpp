// Compiled with AVX-512 F, DQ and VL (see the folder's list in CMakeLists.txt); run only where they exist.
#include <immintrin.h>

#include "pliant/solver/global/factorization/panel_values_kernel.h"
#include "pliant/solver/global/factorization/triangular_solve_flush_mode.h"
#include "pliant/solver/global/factorization/triangular_solve_kernel.h"

namespace pliant {
namespace {

/// The lanes of the first `rows` rows, of four.
inline unsigned lane_mask(std::int32_t rows) {
  return rows >= 4 ? 0xFFFFU : (1U << static_cast<unsigned>(4 * rows)) - 1;
}

/// Four rows a register.
struct SingleLanes {
  using Scalar = float;
  using Block = __m512;
  using Sum = __m512;
  using Spread = __m512;
  using Mode = FlushMode;
  static constexpr int row_blocks_at_once = 4;
  static constexpr int columns_at_once = 8;

  static Block zero() { return _mm512_setzero_ps(); }
  static Sum zero_sum() { return _mm512_setzero_ps(); }
  static __m512 spread(const float* x) { return _mm512_broadcast_f32x4(_mm_loadu_ps(x)); }
  static __m512 expand(const float* value) {
    const __m512i order = _mm512_set_epi32(3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0);
    return _mm512_permutexvar_ps(order, _mm512_castps128_ps512(_mm_loadu_ps(value)));
  }
  static Block load(const float* x, std::int32_t rows) {
    return _mm512_maskz_loadu_ps(static_cast<__mmask16>(lane_mask(rows)), x);
  }
  /// Without masks: a load would wait until a masked store has reached the cache.
  static void store(float* x, Block block, std::int32_t rows) {
    if (rows >= 4) {
      _mm512_storeu_ps(x, block);
    } else if (rows == 1) {
      _mm_storeu_ps(x, _mm512_castps512_ps128(block));
    } else {
      _mm256_storeu_ps(x, _mm512_castps512_ps256(block));
      if (rows == 3) _mm_storeu_ps(x + 8, _mm512_extractf32x4_ps(block, 2));
    }
  }
  static __m128 row_at(const float* x, std::int32_t row) {
    return _mm_loadu_ps(x + 4 * static_cast<std::ptrdiff_t>(row));
  }
  static Block gather(const float* x, const std::int32_t* row) {
    const __m256 low = _mm256_insertf128_ps(_mm256_castps128_ps256(row_at(x, row[0])), row_at(x, row[1]), 1);
    const __m256 high = _mm256_insertf128_ps(_mm256_castps128_ps256(row_at(x, row[2])), row_at(x, row[3]), 1);
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
  }
  static void subtract_row(float* x, std::int32_t row, __m128 value) {
    _mm_storeu_ps(x + 4 * static_cast<std::ptrdiff_t>(row), _mm_sub_ps(row_at(x, row), value));
  }
  static void scatter_subtract(float* x, const std::int32_t* row, Block block) {
    subtract_row(x, row[0], _mm512_castps512_ps128(block));
    subtract_row(x, row[1], _mm512_extractf32x4_ps(block, 1));
    subtract_row(x, row[2], _mm512_extractf32x4_ps(block, 2));
    subtract_row(x, row[3], _mm512_extractf32x4_ps(block, 3));
  }
  static void add_product(Block& sum, const float* value, __m512 x) { sum = _mm512_fmadd_ps(expand(value), x, sum); }
  static void add_dot(Sum& sum, const float* value, Block x) { sum = _mm512_fmadd_ps(expand(value), x, sum); }
  /// Row c of the result is the sum of the four rows of sum[c].
  static Block reduce(const Sum* sum) {
    const __m512 first =
        _mm512_add_ps(_mm512_shuffle_f32x4(sum[0], sum[1], 0x44), _mm512_shuffle_f32x4(sum[0], sum[1], 0xEE));
    const __m512 second =
        _mm512_add_ps(_mm512_shuffle_f32x4(sum[2], sum[3], 0x44), _mm512_shuffle_f32x4(sum[2], sum[3], 0xEE));
    return _mm512_add_ps(_mm512_shuffle_f32x4(first, second, 0x88), _mm512_shuffle_f32x4(first, second, 0xDD));
  }
  static Block difference(Block a, Block b) { return _mm512_sub_ps(a, b); }
  static void subtract_sum(float* x, Sum sum) {
    const __m256 half = _mm256_add_ps(_mm512_castps512_ps256(sum), _mm512_extractf32x8_ps(sum, 1));
    subtract_row(x, 0, _mm_add_ps(_mm256_castps256_ps128(half), _mm256_extractf128_ps(half, 1)));
  }
};

/// Two rows a register.
struct DoubleLanes {
  using Scalar = double;
  struct Block {
    __m512d low, high;
  };
  using Sum = Block;
  using Spread = __m512d;
  using Mode = FlushMode;
  static constexpr int row_blocks_at_once = 2;
  static constexpr int columns_at_once = 4;

  static Block zero() { return {_mm512_setzero_pd(), _mm512_setzero_pd()}; }
  static Sum zero_sum() { return zero(); }
  static __m512d spread(const double* x) { return _mm512_broadcast_f64x4(_mm256_loadu_pd(x)); }
  static __m512d expand(const double* value) {
    const __m512i order = _mm512_set_epi64(1, 1, 1, 1, 0, 0, 0, 0);
    return _mm512_permutexvar_pd(order, _mm512_castpd128_pd512(_mm_loadu_pd(value)));
  }
  static Block load(const double* x, std::int32_t rows) {
    const unsigned mask = lane_mask(rows);
    return {_mm512_maskz_loadu_pd(static_cast<__mmask8>(mask), x),
            _mm512_maskz_loadu_pd(static_cast<__mmask8>(mask >> 8U), x + 8)};
  }
  static void store(double* x, const Block& block, std::int32_t rows) {
    const unsigned mask = lane_mask(rows);
    _mm512_mask_storeu_pd(x, static_cast<__mmask8>(mask), block.low);
    _mm512_mask_storeu_pd(x + 8, static_cast<__mmask8>(mask >> 8U), block.high);
  }
  static __m256d row_at(const double* x, std::int32_t row) {
    return _mm256_loadu_pd(x + 4 * static_cast<std::ptrdiff_t>(row));
  }
  static __m512d pair(__m256d a, __m256d b) { return _mm512_insertf64x4(_mm512_castpd256_pd512(a), b, 1); }
  static Block gather(const double* x, const std::int32_t* row) {
    return {pair(row_at(x, row[0]), row_at(x, row[1])), pair(row_at(x, row[2]), row_at(x, row[3]))};
  }
  static void subtract_row(double* x, std::int32_t row, __m256d value) {
    _mm256_storeu_pd(x + 4 * static_cast<std::ptrdiff_t>(row), _mm256_sub_pd(row_at(x, row), value));
  }
  static void scatter_subtract(double* x, const std::int32_t* row, const Block& block) {
    subtract_row(x, row[0], _mm512_castpd512_pd256(block.low));
    subtract_row(x, row[1], _mm512_extractf64x4_pd(block.low, 1));
    subtract_row(x, row[2], _mm512_castpd512_pd256(block.high));
    subtract_row(x, row[3], _mm512_extractf64x4_pd(block.high, 1));
  }
  static void add_product(Block& sum, const double* value, __m512d x) {
    sum.low = _mm512_fmadd_pd(expand(value), x, sum.low);
    sum.high = _mm512_fmadd_pd(expand(value + 2), x, sum.high);
  }
  static void add_dot(Sum& sum, const double* value, const Block& x) {
    sum.low = _mm512_fmadd_pd(expand(value), x.low, sum.low);
    sum.high = _mm512_fmadd_pd(expand(value + 2), x.high, sum.high);
  }
  static __m512d reduce_two(const Sum& a, const Sum& b) {
    const __m512d of_a = _mm512_add_pd(a.low, a.high);
    const __m512d of_b = _mm512_add_pd(b.low, b.high);
    return _mm512_add_pd(_mm512_shuffle_f64x2(of_a, of_b, 0x44), _mm512_shuffle_f64x2(of_a, of_b, 0xEE));
  }
  static Block reduce(const Sum* sum) { return {reduce_two(sum[0], sum[1]), reduce_two(sum[2], sum[3])}; }
  static Block difference(const Block& a, const Block& b) {
    return {_mm512_sub_pd(a.low, b.low), _mm512_sub_pd(a.high, b.high)};
  }
  static void subtract_sum(double* x, const Sum& sum) {
    const __m512d half = _mm512_add_pd(sum.low, sum.high);
    subtract_row(x, 0, _mm256_add_pd(_mm512_castpd512_pd256(half), _mm512_extractf64x4_pd(half, 1)));
  }
};

}  // namespace

const TriangularSolve<float> avx512_triangular_solve_single = {
    Kernel<SingleLanes>::forward, Kernel<SingleLanes>::backward, PanelValues<8, float>::write, "AVX-512"};
const TriangularSolve<double> avx512_triangular_solve_double = {
    Kernel<DoubleLanes>::forward, Kernel<DoubleLanes>::backward, PanelValues<8, double>::write, "AVX-512"};

}  // namespace pliant
