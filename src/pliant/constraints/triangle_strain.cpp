#include "pliant/constraints/triangle_strain.h"

#include "pliant/constraints/element_batch.h"
#include "pliant/constraints/strain_projection.h"

namespace pliant {

void TriangleStrainProjection::project(const Real* field, const Real* z, Real* p) {
  using Gradient = ThreeRows<2>;
  const Eigen::Map<const Gradient> F(z);  // row a of z is column a of F
  const SmallSvd<2> decomposition = svd(F);
  Eigen::Map<Gradient> projected(p);
  projected = recompose(decomposition, clamped(decomposition.sigma, field[0], field[1]));
  keep_within_rounding(z, p, 6);
}

ConstraintSet build(const BodyView& body, const TriangleStrain& options) {
  return build_elements<TriangleStrainProjection>(
      body, {{TriangleStrain::info.name, options.on, options.stencils, options.stiffness},
             "stretch",
             options.min_stretch,
             options.max_stretch});
}

}  // namespace pliant
