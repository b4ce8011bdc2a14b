#include "pliant/constraints/tetrahedron_strain.h"

#include "pliant/constraints/build.h"
#include "pliant/constraints/strain_projection.h"
#include "pliant/constraints/strain_rest.h"

namespace pliant {

void TetrahedronStrainProjection::project(const Real* field, const Real* z, Real* p) {
  const Eigen::Map<const Mat3> F(z);  // row a of z is column a of F
  const SmallSvd<3> decomposition = signed_svd(F);
  Eigen::Map<Mat3> projected(p);
  projected = recompose(decomposition, clamped(decomposition.sigma, field[0], field[1]));
  keep_within_rounding(z, p, 9);
}

ConstraintSet build(const BodyView& body, const TetrahedronStrain& options) {
  constexpr std::string_view type = TetrahedronStrain::info.name;
  const Stencils chosen = choose_stencils(
      type, body, options.on, options.stencils, [&] { return to_stencils(body.rest.tetrahedra); }, 4);
  const StretchLimits limits(type, body, options.min_stretch, options.max_stretch, chosen);

  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  auto batch = std::make_unique<Batch<TetrahedronStrainProjection>>(stiffness.common());
  for (Index i = 0; i < chosen.size(); ++i) {
    const auto corner = [&](std::size_t j) { return row(body.rest.vertices, chosen[i][j]); };
    const RestElement<4> rest = rest_tetrahedron(corner(0), corner(1), corner(2), corner(3));
    check_rest_measure(type, body, i, rest.measure, "volume; swap two of its vertices if it is inverted");
    batch->add(global_stencil(body, chosen[i]), rest.reduction, stiffness.of(i) * rest.measure, limits[i]);
  }
  return one_batch(std::move(batch));
}

}  // namespace pliant
