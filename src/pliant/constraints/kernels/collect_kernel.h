#pragma once
// What each vertex gets from the slots of a chunk, one vertex after the other, in the order of its entries. Compiled as
// lanes.h says. Nothing is fused, so the bits are the same on all processors.
#include "pliant/constraints/kernels/lanes.h"
#include "pliant/constraints/kernels/local_kernels.h"

namespace pliant {
namespace {

/// A vector of three numbers. With four lanes it is read with the number after it, whose sum nobody looks at.
template <int width>
struct CollectKernel {
  static void ones(const CollectedVertices& run) { sum_up(run, One{}); }
  static void signs(const CollectedVertices& run) { sum_up(run, Sign{}); }
  static void any(const CollectedVertices& run) { sum_up(run, Factor{run.coefficients}); }

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
    if constexpr (lanes == 2) parts.second[0] = from[2];
    return parts;
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

  template <class Times>
  static void sum_up(const CollectedVertices& run, Times times) {
    std::size_t entry = 0;
    double* to = run.sums;
    for (std::size_t vertex = 0; vertex < run.count; ++vertex, to += 3) {
      const std::size_t end = run.ends[vertex];
      Parts sum;
      for (; entry < end; ++entry) {
        const std::size_t code = run.entries[entry];
        const Parts parts = load(run.slots + 3 * (code / 2));
        sum.first += times(parts.first, code, entry);
        if constexpr (lanes == 2) sum.second += times(parts.second, code, entry);
      }
      store(sum, to);
    }
  }
};

}  // namespace
}  // namespace pliant
