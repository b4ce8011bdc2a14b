// Compiled with AVX2 and fused multiply-adds (see the folder's list in CMakeLists.txt); run only where they exist.
#include "pliant/solver/factorization/sweeps_kernel.h"

namespace pliant {

const Sweeps avx2_sweeps = {forward, backward, "AVX2"};

}  // namespace pliant
