#include "pliant/constraints/kernels/kernels.h"

namespace pliant {

const LocalKernels portable_kernels = kernels_of<2>("portable");

}  // namespace pliant
