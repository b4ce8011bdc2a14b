#if defined(__x86_64__)
#include "pliant/solver/global/factorization/triangular_solve_flush_mode.h"
#endif
#include "pliant/solver/global/factorization/panel_values_kernel.h"
#include "pliant/solver/global/factorization/triangular_solve_generic_lanes.h"

namespace pliant {
namespace {

template <class T>
struct PortableLanes : GenericLanes<T> {
#if defined(__x86_64__)
  using Mode = FlushMode;  // every such processor has it
#endif
};

using Single = Kernel<PortableLanes<float>>;
using Double = Kernel<PortableLanes<double>>;

}  // namespace

const TriangularSolve<float> portable_triangular_solve_single = {Single::forward, Single::backward,
                                                                 PanelValues<2, float>::write, "portable"};
const TriangularSolve<double> portable_triangular_solve_double = {Double::forward, Double::backward,
                                                                  PanelValues<2, double>::write, "portable"};

}  // namespace pliant
