#include "pliant/constraints/plane.h"

#include "pliant/constraints/anchored_batch.h"

namespace pliant {

ConstraintSet build(const BodyView& body, const OnPlane& options) {
  return build_anchored<PlaneProjection>(body, options, "normal", options.normal);
}

ConstraintSet build(const BodyView& body, const InHalfSpace& options) {
  return build_anchored<HalfSpaceProjection>(body, options, "normal", options.normal);
}

}  // namespace pliant
