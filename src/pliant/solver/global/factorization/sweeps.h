#pragma once
// The two sweeps of a triangular solve, for the instruction set of the processor at hand.
#include <cstddef>
#include <cstdint>
#include <span>

namespace pliant {

/// Rows of a panel stand together in blocks of this many; x has as many lanes a row: three coordinates and a zero.
inline constexpr std::int32_t panel_lanes = 4;

/// One panel of the factor; panel_factor.h draws it.
struct Panel {
  std::int32_t first_column = 0;
  std::int32_t columns = 0;
  std::int32_t row_blocks = 0;  ///< of the rows below the diagonal block
  std::size_t first_row = 0;    ///< in the rows of all panels
  std::size_t first_value = 0;  ///< in the values of all panels
};

/// What a sweep reads, and x, four numbers a row, which it overwrites.
template <class T>
struct SweepData {
  const Panel* panels;
  const std::int32_t* rows;
  const T* values;
  T* x;
};

template <class T>
struct Sweeps {
  using Sweep = void (*)(const SweepData<T>&, std::size_t begin, std::size_t end);

  Sweep forward;   ///< x ← L⁻¹ x for the panels [begin, end), the first one first
  Sweep backward;  ///< x ← L⁻ᵀ x for them, the last one first
  const char* instruction_set;
};

/// All sweeps that this processor can run, the fastest last. Always the same ones on the same machine.
template <class T>
std::span<const Sweeps<T>* const> all_sweeps();

template <class T>
const Sweeps<T>& fastest_sweeps() {
  return *all_sweeps<T>().back();
}

extern const Sweeps<float> portable_sweeps_single;
extern const Sweeps<double> portable_sweeps_double;
// Defined where the compiler has the instruction set.
extern const Sweeps<float> avx2_sweeps_single;
extern const Sweeps<double> avx2_sweeps_double;
extern const Sweeps<float> avx512_sweeps_single;
extern const Sweeps<double> avx512_sweeps_double;

}  // namespace pliant
