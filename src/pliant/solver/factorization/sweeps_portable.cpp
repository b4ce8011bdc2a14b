#include "pliant/solver/factorization/sweeps_kernel.h"

namespace pliant {

const Sweeps portable_sweeps = {forward, backward, "portable"};

}  // namespace pliant
