#include "pliant/constraints/triangle_area.h"

#include "pliant/constraints/element_batch.h"
#include "pliant/constraints/product_projection.h"
#include "pliant/constraints/strain_projection.h"

namespace pliant {

void TriangleAreaProjection::project(const Real* field, const Real* z, Real* p) {
  using Gradient = ThreeRows<2>;
  const Eigen::Map<const Gradient> F(z);  // row a of z is column a of F
  const SmallSvd<2> decomposition = svd(F);
  Eigen::Map<Gradient> projected(p);
  projected = recompose(decomposition, with_product_between(decomposition.sigma, field[0], field[1]));
  keep_within_rounding(z, p, 6);
}

ConstraintSet build(const BodyView& body, const TriangleArea& options) {
  return build_elements<TriangleAreaProjection>(
      body, {{TriangleArea::info.name, options.on, options.stencils, options.stiffness},
             "area",
             options.min_area,
             options.max_area});
}

}  // namespace pliant
