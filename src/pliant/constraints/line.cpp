#include "pliant/constraints/line.h"

#include "pliant/constraints/build.h"
#include "pliant/core/error.h"

namespace pliant {

ConstraintSet build(const BodyView& body, const Line& options) {
  constexpr std::string_view type = Line::info.name;
  const Stencils chosen = choose_vertices(type, body, options.on, options.stencils);
  check_length(type, "origin", options.origin, chosen.size());
  check_length(type, "direction", options.direction, chosen.size());
  if (options.direction.empty()) fail_input("line: direction is missing; give a vector such as [1, 0, 0]");

  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  auto batch = std::make_unique<Batch<LineProjection>>(stiffness.common());
  const Real one = 1;
  for (Index i = 0; i < chosen.size(); ++i) {
    const Vec3 origin = options.origin.empty() ? row(body.start, chosen[i][0]) : options.origin[i];
    const Vec3 direction = options.direction[i].stableNormalized();
    if (!(direction.squaredNorm() > 0)) {
      fail_input("line: direction " + std::to_string(options.direction.each() ? i : 0) +
                 " is the zero vector; give the line a direction such as [1, 0, 0]");
    }
    const std::array<Real, 6> field = {origin[0], origin[1], origin[2], direction[0], direction[1], direction[2]};
    batch->add(global_stencil(body, chosen[i]), {&one, 1}, stiffness.of(i), field);
  }
  return one_batch(std::move(batch));
}

}  // namespace pliant
