// Compiled for every processor.
#include "pliant/solver/acceleration/remembered_lanes.h"

namespace pliant {

const RememberedKernels portable_remembered_kernels = remembered_kernels_of<2>("portable");

}  // namespace pliant
