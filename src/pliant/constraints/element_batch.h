#pragma once
// What the builders of triangles and tetrahedra share: z = F, and as a rule two limits.
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
};

/// Those with limits.
struct LimitedOptions : ElementOptions {
  std::string_view limited;  ///< "stretch" where the limits are min_stretch and max_stretch
  const Values& min;
  const Values& max;
};

template <class Projection>
Stencils choose_elements(const BodyView& body, const ElementOptions& options) {
  const auto elements = [&] {
    if constexpr (Projection::vertices == 3) return to_stencils(body.rest.triangles);
    if constexpr (Projection::vertices == 4) return to_stencils(body.rest.tetrahedra);
  };
  return choose_stencils(options.type, body, options.on, options.stencils, elements, Projection::vertices);
}

/// A batch of these elements, of weight stiffness × area or volume × `factor`, with the fields fields_of(i); of a
/// tetrahedron of a lattice that carries a surface, the volume inside. Throws Error(input) on an element without
/// positive measure, an index out of range, lists of the wrong length.
template <class Projection, class FieldsOf>
ConstraintSet build_elements(const BodyView& body, const ElementOptions& options, const Stencils& chosen, Real factor,
                             const FieldsOf& fields_of) {
  constexpr bool is_triangle = Projection::vertices == 3;
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
    batch->add(global_stencil(body, chosen[i]), rest.reduction,
               stiffness.of(i) * filled.of(chosen[i]) * rest.measure * factor, fields_of(i));
  }
  return one_batch(std::move(batch));
}

/// The same of elements with limits. Throws Error(input) on min above max as well.
template <class Projection>
ConstraintSet build_elements(const BodyView& body, const LimitedOptions& options) {
  const Stencils chosen = choose_elements<Projection>(body, options);
  const Limits limits(options.type, body, options.limited, options.min, options.max, chosen);
  return build_elements<Projection>(body, options, chosen, 1, [&](Index i) { return limits[i]; });
}

}  // namespace pliant
