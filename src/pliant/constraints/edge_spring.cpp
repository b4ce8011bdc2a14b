#include "pliant/constraints/edge_spring.h"

#include "pliant/constraints/build.h"
#include "pliant/constraints/edge_rest.h"

namespace pliant {

ConstraintSet build(const BodyView& body, const EdgeSpring& options) {
  constexpr std::string_view type = EdgeSpring::info.name;
  const Stencils chosen = choose_stencils(
      type, body, options.on, options.stencils, [&] { return mesh_edges(body); }, 2);
  const std::vector<Real> rest_length = rest_lengths(type, body, chosen, options.rest_length);

  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  const auto batch_of = [&]<class Projection>(std::span<const Real> reduction, Real weight) {
    auto batch = std::make_unique<Batch<Projection>>(stiffness.common(), Projection::vertices, type);
    for (Index i = 0; i < chosen.size(); ++i) {
      const Real length = rest_length[static_cast<std::size_t>(i)];
      batch->add(global_stencil(body, chosen[i]), reduction, weight * stiffness.of(i), {&length, 1});
    }
    return one_batch(std::move(batch));
  };
  if (options.reduction == EdgeReduction::identity) {
    return batch_of.template operator()<EdgeEndsProjection>(std::array<Real, 4>{1, 0, 0, 1}, 2);
  }
  return batch_of.template operator()<EdgeSpringProjection>(std::array<Real, 2>{-1, 1}, 1);
}

}  // namespace pliant
