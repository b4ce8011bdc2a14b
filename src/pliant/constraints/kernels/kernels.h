#pragma once
// The kernels of local_kernels.h, for any number of lanes; compiled as lanes.h says.
#include "pliant/constraints/kernels/length_kernels.h"
#include "pliant/constraints/kernels/linear_kernel.h"
#include "pliant/constraints/kernels/product_kernels.h"
#include "pliant/constraints/kernels/strain_kernels.h"

namespace pliant {
namespace {

template <int width>
constexpr LocalKernels kernels_of(const char* instruction_set) {
  using Lengths = LengthKernels<width>;
  using Strains = StrainKernels<width>;
  using Products = ProductKernels<width>;
  return {Lengths::edge_spring,           Lengths::template strain<2>,    Lengths::template strain<3>,
          Strains::triangle_strain,       Strains::tetrahedron_strain,    Products::triangle_area,
          Products::tetrahedron_volume,   Lengths::template curvature<0>, Lengths::template curvature<4>,
          Lengths::template curvature<8>, LinearKernel<width>::run,       instruction_set};
}

}  // namespace
}  // namespace pliant
