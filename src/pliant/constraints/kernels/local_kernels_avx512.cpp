// Compiled with its instruction set (see CMakeLists.txt of the library); run only where that exists.
#include "pliant/constraints/kernels/kernels.h"

namespace pliant {

const LocalKernels avx512_kernels = kernels_of<8>("AVX-512");

}  // namespace pliant
