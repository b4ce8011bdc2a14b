#pragma once
// What the builders of triangles and tetrahedra share: z = F, and two limits.
#include "pliant/constraints/batch.h"
#include "pliant/constraints/build.h"
#include "pliant/constraints/strain_rest.h"

namespace pliant {

/// The options that all of them have.
struct ElementOptions {
  std::string_view type;
  const Selection& on;
  const Stencils& stencils;
  const Values& stiffness;
  std::string_view limited;  ///< "stretch" where the limits are min_stretch and max_stretch
  const Values& min;
  const Values& max;
};

/// A batch of the elements chosen, of weight stiffness × area or volume; of a tetrahedron of a lattice that carries a
/// surface, the volume inside. Throws Error(input) on an element without
/// positive measure, min above max, an index out of range, lists of the wrong length.
template <class Projection>
ConstraintSet build_elements(const BodyView& body, const ElementOptions& options) {
  constexpr bool is_triangle = Projection::vertices == 3;
  const auto elements = [&] {
    if constexpr (is_triangle) return to_stencils(body.rest.triangles);
    if constexpr (!is_triangle) return to_stencils(body.rest.tetrahedra);
  };
  const Stencils chosen =
      choose_stencils(options.type, body, options.on, options.stencils, elements, Projection::vertices);
  const Limits limits(options.type, body, options.limited, options.min, options.max, chosen);

  const FilledShares filled(body.rest);
  const StiffnessSplit stiffness(options.type, body, options.stiffness, chosen);
  auto batch = std::make_unique<Batch<Projection>>(stiffness.common());
  for (Index i = 0; i < chosen.size(); ++i) {
    const auto rest = [&] {
      const auto corner = [&](std::size_t j) { return row(body.rest.vertices, chosen[i][j]); };
      if constexpr (is_triangle) return rest_triangle(corner(0), corner(1), corner(2));
      if constexpr (!is_triangle) return rest_tetrahedron(corner(0), corner(1), corner(2), corner(3));
    }();
    check_rest_measure(
        options.type, body, i, rest.measure,
        is_triangle ? "area; leave it out, or fix its vertices" : "volume; swap two of its vertices if it is inverted");
    batch->add(global_stencil(body, chosen[i]), rest.reduction, stiffness.of(i) * filled.of(chosen[i]) * rest.measure,
               limits[i]);
  }
  return one_batch(std::move(batch));
}

}  // namespace pliant
