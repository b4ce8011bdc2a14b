#include "pliant/constraints/tetrahedron_volume.h"

#include "pliant/constraints/element_batch.h"
#include "pliant/constraints/product_projection.h"
#include "pliant/constraints/strain_projection.h"

namespace pliant {

void TetrahedronVolumeProjection::project(const Real* field, const Real* z, Real* p) {
  const Eigen::Map<const Mat3> F(z);  // row a of z is column a of F
  const SmallSvd<3> decomposition = signed_svd(F);
  Eigen::Map<Mat3> projected(p);
  projected = recompose(decomposition, with_product_between(decomposition.sigma, field[0], field[1]));
  keep_within_rounding(z, p, 9);
}

ConstraintSet build(const BodyView& body, const TetrahedronVolume& options) {
  return build_elements<TetrahedronVolumeProjection>(
      body, {{TetrahedronVolume::info.name, options.on, options.stencils, options.stiffness},
             "volume",
             options.min_volume,
             options.max_volume});
}

}  // namespace pliant
