#include "pliant/constraints/fibre_strain.h"

#include <numbers>

#include "pliant/constraints/build.h"
#include "pliant/constraints/strain_rest.h"

namespace pliant {

ConstraintSet build(const BodyView& body, const FibreStrain& options) {
  constexpr std::string_view type = FibreStrain::info.name;
  const Stencils chosen = choose_stencils(
      type, body, options.on, options.stencils, [&] { return to_stencils(body.rest.triangles); }, 3);
  const Limits limits(type, body, "stretch", options.min_stretch, options.max_stretch, chosen);
  const std::vector<Vec2> warp = warp_directions(type, body, chosen, options.direction, options.grain);
  const Eigen::Rotation2D<Real> turn(options.angle * std::numbers::pi / 180);

  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  auto batch = std::make_unique<Batch<FibreStrainProjection>>(stiffness.common());
  for (Index i = 0; i < chosen.size(); ++i) {
    const auto corner = [&](std::size_t j) { return row(body.rest.vertices, chosen[i][j]); };
    const RestElement<3> rest = rest_triangle(corner(0), corner(1), corner(2));
    check_rest_measure(type, body, i, rest.measure, "area; leave it out, or fix its vertices");
    const Vec2 d = turn * warp[static_cast<std::size_t>(i)];
    std::array<Real, 3> along;
    for (std::size_t j = 1; j < 3; ++j) along[j] = d[0] * rest.reduction[j] + d[1] * rest.reduction[3 + j];
    along[0] = -(along[1] + along[2]);
    batch->add(global_stencil(body, chosen[i]), along, stiffness.of(i) * rest.measure, limits[i]);
  }
  return one_batch(std::move(batch));
}

}  // namespace pliant
