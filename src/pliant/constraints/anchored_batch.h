#pragma once
// What the builders of lines, planes and half-spaces share: a vertex, a point in space and a unit vector.
#include <string>

#include "pliant/constraints/batch.h"
#include "pliant/constraints/build.h"
#include "pliant/core/error.h"

namespace pliant {

/// A batch on the vertices chosen, whose fields are a point (where the vertex starts, unless given) and a unit vector.
/// `name` is that of the vector's option. Throws Error(input) on a zero or missing vector, an index out of range, lists
/// of the wrong length.
template <class Projection, class Options>
ConstraintSet build_anchored(const BodyView& body, const Options& options, std::string_view name,
                             const Points& vectors) {
  constexpr std::string_view type = Options::info.name;
  const Stencils chosen = choose_vertices(type, body, options.on, options.stencils);
  check_length(type, "origin", options.origin, chosen.size());
  check_length(type, name, vectors, chosen.size());
  const std::string place = std::string(type) + ": " + std::string(name);
  if (vectors.empty()) fail_input(place + " is missing; give a vector such as [1, 0, 0]");

  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  auto batch = std::make_unique<Batch<Projection>>(stiffness.common());
  const Real one = 1;
  for (Index i = 0; i < chosen.size(); ++i) {
    const Vec3 origin = options.origin.empty() ? row(body.start, chosen[i][0]) : options.origin[i];
    const Vec3 unit = vectors[i].stableNormalized();
    if (!(unit.squaredNorm() > 0)) {
      fail_input(place + " " + std::to_string(vectors.each() ? i : 0) + " is the zero vector; give a " +
                 std::string(name) + " such as [1, 0, 0]");
    }
    const std::array<Real, 6> field = {origin[0], origin[1], origin[2], unit[0], unit[1], unit[2]};
    batch->add(global_stencil(body, chosen[i]), {&one, 1}, stiffness.of(i), field);
  }
  return one_batch(std::move(batch));
}

}  // namespace pliant
