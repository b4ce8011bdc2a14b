#pragma once
// Which of the instruction sets that parts of the library are compiled for the processor at hand has.
#include <cstddef>

namespace pliant {

/// Of portable, AVX2 with FMA, and AVX-512 (F, DQ, VL), the first so many. Always the same on the same machine.
std::size_t instruction_set_count();

}  // namespace pliant
