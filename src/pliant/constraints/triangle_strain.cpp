#include "pliant/constraints/triangle_strain.h"

#include "pliant/constraints/build.h"
#include "pliant/constraints/strain_projection.h"
#include "pliant/constraints/strain_rest.h"

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
  constexpr std::string_view type = TriangleStrain::info.name;
  const Stencils chosen = choose_stencils(
      type, body, options.on, options.stencils, [&] { return to_stencils(body.rest.triangles); }, 3);
  const StretchLimits limits(type, body, options.min_stretch, options.max_stretch, chosen);

  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  auto batch = std::make_unique<Batch<TriangleStrainProjection>>(stiffness.common());
  for (Index i = 0; i < chosen.size(); ++i) {
    const auto corner = [&](std::size_t j) { return row(body.rest.vertices, chosen[i][j]); };
    const RestElement<3> rest = rest_triangle(corner(0), corner(1), corner(2));
    check_rest_measure(type, body, i, rest.measure, "area; leave it out, or fix its vertices");
    batch->add(global_stencil(body, chosen[i]), rest.reduction, stiffness.of(i) * rest.measure, limits[i]);
  }
  return one_batch(std::move(batch));
}

}  // namespace pliant
