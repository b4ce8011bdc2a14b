// Compiled with its instruction set (see CMakeLists.txt of the library); run only where that exists.
#include "pliant/solver/acceleration/remembered_lanes.h"

namespace pliant {

const RememberedKernels avx2_remembered_kernels = remembered_kernels_of<4>("AVX2");

}  // namespace pliant
