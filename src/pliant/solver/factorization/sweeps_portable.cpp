#include "pliant/solver/factorization/sweeps_generic_lanes.h"

namespace pliant {

const Sweeps<float> portable_sweeps_single = {Kernel<GenericLanes<float>>::forward,
                                              Kernel<GenericLanes<float>>::backward, "portable"};
const Sweeps<double> portable_sweeps_double = {Kernel<GenericLanes<double>>::forward,
                                               Kernel<GenericLanes<double>>::backward, "portable"};

}  // namespace pliant
