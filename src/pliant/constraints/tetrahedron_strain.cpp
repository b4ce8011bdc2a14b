#include "pliant/constraints/tetrahedron_strain.h"

#include "pliant/constraints/element_batch.h"
#include "pliant/constraints/strain_projection.h"

namespace pliant {

void TetrahedronStrainProjection::project(const Real* field, const Real* z, Real* p) {
  const Eigen::Map<const Mat3> F(z);  // row a of z is column a of F
  const SmallSvd<3> decomposition = signed_svd(F);
  Eigen::Map<Mat3> projected(p);
  projected = recompose(decomposition, clamped(decomposition.sigma, field[0], field[1]));
  keep_within_rounding(z, p, 9);
}

ConstraintSet build(const BodyView& body, const TetrahedronStrain& options) {
  return build_elements<TetrahedronStrainProjection>(
      body, {{TetrahedronStrain::info.name, options.on, options.stencils, options.stiffness},
             "stretch",
             options.min_stretch,
             options.max_stretch});
}

}  // namespace pliant
