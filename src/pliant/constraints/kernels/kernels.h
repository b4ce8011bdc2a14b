#pragma once
// The kernels of local_kernels.h, for any number of lanes; compiled as lanes.h says.
#include "pliant/constraints/kernels/collect_kernel.h"
#include "pliant/constraints/kernels/hyperelastic_kernels.h"
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
  using Elastics = HyperelasticKernels<width>;
  using Collects = CollectKernel<width>;
  return {.edge_spring = Lengths::edge_spring,
          .edge_strain = Lengths::template strain<2>,
          .fibre_strain = Lengths::template strain<3>,
          .taut_fibre = Lengths::taut_fibre,
          .triangle_strain = Strains::triangle_strain,
          .tetrahedron_strain = Strains::tetrahedron_strain,
          .triangle_area = Products::triangle_area,
          .tetrahedron_volume = Products::tetrahedron_volume,
          .triangle_neo_hookean = Elastics::template neo_hookean<3>,
          .tetrahedron_neo_hookean = Elastics::template neo_hookean<4>,
          .triangle_stvk = Elastics::template st_venant_kirchhoff<3>,
          .tetrahedron_stvk = Elastics::template st_venant_kirchhoff<4>,
          .flat_curvature = Lengths::template curvature<0>,
          .absolute_curvature = Lengths::template curvature<4>,
          .signed_curvature = Lengths::template curvature<8>,
          .linear_forces = LinearKernel<width>::run,
          .collect_ones = Collects::ones,
          .collect_signs = Collects::signs,
          .collect_any = Collects::any,
          .gather = Collects::gather,
          .instruction_set = instruction_set};
}

}  // namespace
}  // namespace pliant
