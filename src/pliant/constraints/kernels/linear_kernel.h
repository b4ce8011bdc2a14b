#pragma once
// Forces that are linear in the positions, row after row of a sparse matrix. Compiled as lanes.h says. Nothing is
// fused, so the bits are the same on all processors.
#include "pliant/constraints/kernels/local_kernels.h"
#include "pliant/core/lanes.h"

namespace pliant {
namespace {

/// Points side by side: x, y and z of one; a fourth lane, where there is one, holds zero.
template <int width>
struct LinearKernel {
  static double run(const LinearRows& rows) {
    double energy = 0;
    for (std::size_t row = rows.begin; row < rows.end; ++row) energy += run_row(rows, row);
    return energy * rows.stiffness;
  }

 private:
  static const double* point(const LinearRows& rows, std::int32_t vertex) {
    return rows.positions + 3 * static_cast<std::ptrdiff_t>(vertex);
  }

#ifdef __AVX__
  static __m256d load(const double* from) {
    return _mm256_maskload_pd(from, _mm256_setr_epi64x(-1, -1, -1, 0));
  }
  static double run_row(const LinearRows& rows, std::size_t row) {
    const __m256d center = load(point(rows, rows.vertices[row]));
    __m256d force = _mm256_setzero_pd(), energy = force;
    for (std::uint32_t k = rows.offsets[row]; k < rows.offsets[row + 1]; ++k) {
      const __m256d e = _mm256_sub_pd(load(point(rows, rows.columns[k])), center);
      const __m256d pull = _mm256_mul_pd(_mm256_broadcast_sd(rows.values + k), e);
      force = _mm256_add_pd(force, pull);
      energy = _mm256_add_pd(energy, _mm256_mul_pd(pull, e));
    }
    double f[4], squares[4];
    _mm256_storeu_pd(f, _mm256_mul_pd(force, _mm256_set1_pd(rows.stiffness)));
    _mm256_storeu_pd(squares, energy);
    double* out = rows.forces + 3 * (row - rows.begin);
    for (int axis = 0; axis < 3; ++axis) out[axis] = f[axis];
    return (squares[0] + squares[1] + squares[2]) / 4;
  }
#else
  static double run_row(const LinearRows& rows, std::size_t row) {
    const double* const center = point(rows, rows.vertices[row]);
    double force[3] = {}, energy[3] = {};
    for (std::uint32_t k = rows.offsets[row]; k < rows.offsets[row + 1]; ++k) {
      const double* const other = point(rows, rows.columns[k]);
      for (int axis = 0; axis < 3; ++axis) {
        const double e = other[axis] - center[axis];
        const double pull = rows.values[k] * e;
        force[axis] += pull;
        energy[axis] += pull * e;
      }
    }
    double* out = rows.forces + 3 * (row - rows.begin);
    for (int axis = 0; axis < 3; ++axis) out[axis] = force[axis] * rows.stiffness;
    return (energy[0] + energy[1] + energy[2]) / 4;
  }
#endif
};

}  // namespace
}  // namespace pliant
