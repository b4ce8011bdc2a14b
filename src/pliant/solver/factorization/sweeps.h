#pragma once
// The two sweeps of a triangular solve, for the instruction set of the processor at hand.
#include <cstddef>
#include <cstdint>

namespace pliant {

/// One panel of the factor; supernodal_factor.h draws it.
struct Supernode {
  std::int32_t first_column;
  std::int32_t columns;
  std::int32_t rows_below;
  std::size_t first_row;    // in the rows of all panels
  std::size_t first_value;  // in the values of all panels
};

/// What a sweep reads, and x, four doubles a row and aligned to 32 bytes, which it overwrites.
struct SweepData {
  const Supernode* supernodes;
  std::size_t supernode_count;
  const std::int32_t* rows;
  const double* values;
  double* x;
};

struct Sweeps {
  void (*forward)(const SweepData&);   ///< x ← L⁻¹ x
  void (*backward)(const SweepData&);  ///< x ← L⁻ᵀ x
  const char* instruction_set;
};

/// The sweeps for this processor: always the same ones on the same machine.
const Sweeps& sweeps();

extern const Sweeps portable_sweeps;
extern const Sweeps avx2_sweeps;  // defined where the compiler has the instruction set

}  // namespace pliant
