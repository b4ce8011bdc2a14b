#include "pliant/constraints/slide.h"

#include "pliant/constraints/build.h"
#include "pliant/core/error.h"

namespace pliant {

ConstraintSet build(const BodyView& body, const Slide& options) {
  constexpr std::string_view type = Slide::info.name;
  const Stencils chosen = choose_vertices(type, body, options.on, options.stencils);
  check_length(type, "origin", options.origin, chosen.size());
  check_length(type, "normal", options.normal, chosen.size());
  if (options.normal.empty()) fail_input("slide: normal is missing; give a vector such as [1, 0, 0]");

  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  auto batch = std::make_unique<Batch<SlideProjection>>(stiffness.common());
  const Real one = 1;
  for (Index i = 0; i < chosen.size(); ++i) {
    const Vec3 origin = options.origin.empty() ? row(body.start, chosen[i][0]) : options.origin[i];
    const Vec3 normal = options.normal[i].stableNormalized();
    if (!(normal.squaredNorm() > 0)) {
      fail_input("slide: normal " + std::to_string(options.normal.each() ? i : 0) +
                 " is the zero vector; give the plane a normal such as [1, 0, 0]");
    }
    const std::array<Real, 6> field = {origin[0], origin[1], origin[2], normal[0], normal[1], normal[2]};
    batch->add(global_stencil(body, chosen[i]), {&one, 1}, stiffness.of(i), field);
  }
  return one_batch(std::move(batch));
}

}  // namespace pliant
