// Compiled with its instruction set (see CMakeLists.txt of the library); run only where that exists.
#include "pliant/constraints/kernels/kernels.h"

namespace pliant {

const LocalKernels avx2_kernels = kernels_of<4>("AVX2");

}  // namespace pliant
