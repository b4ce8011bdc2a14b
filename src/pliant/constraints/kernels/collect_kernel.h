#pragma once
// What each vertex gets from the slots of a chunk, in the order of its entries, and then from its chunks. Compiled as
// lanes.h says. Nothing is fused, so the bits are the same on all processors.
#include "pliant/constraints/kernels/local_kernels.h"
#include "pliant/core/lanes.h"

namespace pliant {
namespace {

/// Vectors of three numbers. With four lanes most are read with the number after them, whose sum nobody looks at.
template <int width>
struct CollectKernel {
  static void ones(const CollectedVertices& run) { sum_up(run, One{}); }
  static void signs(const CollectedVertices& run) { sum_up(run, Sign{}); }
  static void any(const CollectedVertices& run) { sum_up(run, Factor{run.coefficients}); }

  static GatheredSums gather(const GatheredVertices& run) {
    GatheredSums sums{};  // without a constructor, which the linker might share
    for (std::size_t i = run.begin; i < run.end; ++i) {
      Parts force;
      if (!run.is_pinned[i]) {
        for (std::size_t place = run.offsets[i]; place < run.offsets[i + 1]; ++place) {
          const Parts partial = load(run.sums + 3 * static_cast<std::size_t>(run.places[place]));
          force.first += partial.first;
          force.second += partial.second;
        }
        const Parts from = load_three(run.q + 3 * i), to = load_three(run.s + 3 * i);
        const Parts way{to.first - from.first, to.second - from.second};
        const double weight = run.weights[i];
        sums.inertia += weight / 2 * squared(way);
        force.first += weight * way.first;
        force.second += weight * way.second;
        const double residual = squared(force);
        if (residual > sums.squared_residual || residual != residual) sums.squared_residual = residual;
      }
      store(force, run.r + 3 * i);
    }
    return sums;
  }

 private:
  static constexpr int lanes = width == 2 ? 2 : 4;
  using Number = typename Lanes<lanes>::Number;
  using Bits = typename Lanes<lanes>::Mask;

  static constexpr long long first_bit = static_cast<long long>(1ULL << 63);
  alignas(32) static constexpr long long masks[2][4] = {{}, {first_bit, first_bit, first_bit, first_bit}};

  struct Parts {  // x and y, then z; or x, y and z, then nothing
    Number first{}, second{};
  };
  static Parts load(const double* from) {
    Parts parts;
    __builtin_memcpy(&parts.first, from, sizeof parts.first);
    if constexpr (lanes == 2) parts.second = Number{from[2]};  // set by itself it would go through memory
    return parts;
  }
  /// The same, without the number after it.
  static Parts load_three(const double* from) {
#ifdef __AVX__
    if constexpr (lanes == 4) return {_mm256_maskload_pd(from, _mm256_setr_epi64x(-1, -1, -1, 0)), Number{}};
#else
    static_assert(lanes == 2);
#endif
    return load(from);
  }
  static double squared(const Parts& parts) {
    const Number squares = parts.first * parts.first;
    const double z = lanes == 2 ? parts.second[0] * parts.second[0] : squares[2 % lanes];
    return squares[0] + squares[1] + z;
  }
  static void store(const Parts& parts, double* to) {
    __builtin_memcpy(to, &parts.first, 2 * sizeof(double));
    to[2] = lanes == 2 ? parts.second[0] : parts.first[2 % lanes];
  }

  struct One {
    Number operator()(Number part, std::size_t, std::size_t) const { return part; }
  };
  struct Sign {
    Number operator()(Number part, std::size_t code, std::size_t) const {
      Bits mask;
      __builtin_memcpy(&mask, masks[code % 2], sizeof mask);
      return reinterpret_cast<Number>(reinterpret_cast<Bits>(part) ^ mask);
    }
  };
  struct Factor {
    const double* coefficients;
    Number operator()(Number part, std::size_t, std::size_t entry) const { return coefficients[entry] * part; }
  };

  /// Where slot ⌊code / 2⌋ begins: 12 bytes times the code without its last bit, in an address times 3 and times 4.
  static const double* slot(const double* slots, std::size_t code) {
    constexpr std::size_t half_a_slot = 3 * sizeof(double) / 2;
    const char* const bytes = reinterpret_cast<const char*>(slots) + (code & ~std::size_t{1}) * half_a_slot;
    return reinterpret_cast<const double*>(bytes);
  }

  template <class Times>
  static void sum_up(const CollectedVertices& run, Times times) {
    std::size_t entry = 0;
    double* to = run.sums;
    for (std::size_t vertex = 0; vertex < run.count; ++vertex, to += 3) {
      const std::size_t end = run.ends[vertex];
      Parts sum;
      for (; entry < end; ++entry) {
        const std::size_t code = run.entries[entry];
        const Parts parts = load(slot(run.slots, code));
        sum.first += times(parts.first, code, entry);
        if constexpr (lanes == 2) sum.second += times(parts.second, code, entry);
      }
      store(sum, to);
    }
  }
};

}  // namespace
}  // namespace pliant
